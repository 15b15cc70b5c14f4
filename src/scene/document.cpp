#include "scene/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "base/errors.hpp"

namespace ejecta {

std::string element_path(const std::string& list, std::size_t k) { return fmt::format("{}[{}]", list, k); }

namespace {

/// Nothing for what settings never hold: dates and times.
bool read_literal(const toml::node& node, Literal& literal) {
  if (const auto* flag = node.as_boolean()) return literal.value = flag->get(), true;
  if (const auto* integer = node.as_integer()) return literal.value = integer->get(), true;
  if (const auto* number = node.as_floating_point()) return literal.value = number->get(), true;
  if (const auto* text = node.as_string()) return literal.value = text->get(), true;
  if (const toml::table* table = node.as_table()) {
    LiteralTable entries;
    for (const auto& [entry, inner] : *table)
      if (!read_literal(inner, entries.emplace_back(LiteralEntry{std::string(entry.str()), {}}).value)) return false;
    literal.value = std::move(entries);
    return true;
  }
  const toml::array* array = node.as_array();
  if (!array) return false;
  LiteralList list(array->size());
  for (std::size_t k = 0; k < list.size(); ++k)
    if (!read_literal(*array->get(k), list[k])) return false;
  literal.value = std::move(list);
  return true;
}

/// What settings never need, and the recursions of the parser and of flatten() could not bear without limit.
constexpr int most_dots = 100, deepest_table = 32;

void refuse_endless_keys(const std::string& text, const std::string& name) {
  int line = 1, dots = 0;
  bool comment = false, blank = true;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
      comment = false;
      blank = true;
      continue;
    }
    if (blank && c == '#') comment = true;
    blank = blank && (c == ' ' || c == '\t');
    if (c == '.' && !comment && ++dots > most_dots)
      throw InputError(fmt::format("{}:{}: expected at most {} dots in a line", name, line, most_dots));
  }
}

void flatten(const toml::table& table, const std::string& path, Document& document, std::vector<std::string>& problems,
             int depth = 0) {
  if (depth > deepest_table) {
    problems.push_back(fmt::format("{}: {}: expected at most {} tables inside each other", document.file,
                                   path.substr(0, 40), deepest_table));
    return;
  }
  const auto origin_of = [&](const toml::node& node) {
    const int line = static_cast<int>(node.source().begin.line);
    return Origin{fmt::format("{}:{}", document.file, line), line};
  };
  for (const auto& [key, node] : table) {
    const std::string here = path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
    const Origin origin = origin_of(node);
    if (const toml::table* inner = node.as_table()) {
      document.tables[here] = origin;
      flatten(*inner, here, document, problems, depth + 1);
    } else if (const toml::array* array = node.as_array(); array && !array->empty() && array->is_array_of_tables()) {
      for (std::size_t k = 0; k < array->size(); ++k) {
        const std::string element = element_path(here, k);
        document.tables[element] = origin_of(*array->get(k));
        flatten(*array->get(k)->as_table(), element, document, problems, depth + 1);
      }
    } else {
      Literal literal;
      if (read_literal(node, literal))
        document.items[here] = {literal, origin};
      else
        problems.push_back(fmt::format("{}: {}: expected a text, number, true, false or a list of them, got a date",
                                       origin.text, here));
    }
  }
}

std::optional<std::string> name_of_element(const Document& document, const std::string& element) {
  const auto name = document.items.find(element + ".name");
  const auto* text = name == document.items.end() ? nullptr : std::get_if<std::string>(&name->second.literal.value);
  return text ? std::optional(*text) : std::nullopt;
}

/// "bodies.projectile.velocity" -> "bodies[1].velocity"; other paths stay. Throws if a list holds no such thing.
std::string with_numbers(const Document& document, std::string path) {
  for (std::size_t end = path.find_first_of(".["); end != std::string::npos; end = path.find_first_of(".[", end + 1)) {
    const std::string list = path.substr(0, end);
    const std::size_t count = document.count(list), dot = path.find('.', end + 1);
    if (count == 0) continue;
    const std::string asked = path.substr(0, dot);
    std::string found, known;
    for (std::size_t k = 0; k < count; ++k) {
      const std::string element = element_path(list, k);
      const std::optional<std::string> name = name_of_element(document, element);
      if (asked == element || (name && asked == list + "." + *name)) found = element;
      known += fmt::format("{}{}", known.empty() ? "" : ", ", name ? fmt::format("\"{}\"", *name) : element);
    }
    if (found.empty() || dot == std::string::npos)
      throw InputError(fmt::format("--set {}: expected one of the {} {}", path, list, known));
    path = found + path.substr(dot);
    end = found.size() - 1;
  }
  return path;
}

Literal parse_literal(const std::string& text) {
  refuse_endless_keys(text, "--set");
  try {
    const toml::table table = toml::parse("value = " + text);
    Literal literal;
    if (table.size() == 1 && read_literal(*table.get("value"), literal)) return literal;
  } catch (const toml::parse_error&) {
    // Not a TOML value: a bare word or quantity such as 20us, taken as text.
  }
  return {text};
}

}  // namespace

std::string to_text(const Literal& literal) {
  struct Visitor {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return '"' + text + '"'; }
    std::string operator()(const LiteralList& list) const {
      std::string text;
      for (const Literal& element : list) text += (text.empty() ? "" : ", ") + to_text(element);
      return "[" + text + "]";
    }
    std::string operator()(const LiteralTable& table) const {
      std::string text;
      for (const LiteralEntry& entry : table)
        text += (text.empty() ? "" : ", ") + entry.key + " = " + to_text(entry.value);
      return "{" + text + "}";
    }
  };
  return std::visit(Visitor{}, literal.value);
}

Origin Document::origin(const std::string& path) const {
  if (const auto item = items.find(path); item != items.end()) return item->second.origin;
  if (const auto table = tables.find(path); table != tables.end()) return table->second;
  for (std::size_t dot = path.rfind('.'); dot != std::string::npos && dot > 0; dot = path.rfind('.', dot - 1))
    if (const auto table = tables.find(path.substr(0, dot)); table != tables.end()) return table->second;
  return {file, 0};
}

bool Document::holds(const std::string& name) const { return tables.contains(name) || !children(name).empty(); }

std::size_t Document::count(const std::string& name) const {
  std::size_t n = 0;
  while (tables.contains(element_path(name, n))) ++n;
  return n;
}

std::vector<std::string> Document::children(const std::string& path) const {
  std::set<std::string> names;
  const std::string prefix = path + ".";
  const auto collect = [&](const auto& map) {
    for (const auto& [key, unused] : map)
      if (key.starts_with(prefix))
        names.insert(key.substr(prefix.size(), key.find('.', prefix.size()) - prefix.size()));
  };
  collect(items);
  collect(tables);
  return {names.begin(), names.end()};
}

Document Document::below(const std::string& path) const {
  Document part;
  part.file = file;
  const std::string prefix = path + ".";
  for (const auto& [key, item] : items)
    if (key.starts_with(prefix)) part.items[key.substr(prefix.size())] = item;
  for (const auto& [key, origin] : tables)
    if (key.starts_with(prefix)) part.tables[key.substr(prefix.size())] = origin;
  return part;
}

std::string without_numbers(const std::string& path) {
  std::string text;
  bool number = false;
  for (const char c : path) {
    number = number || c == '[';
    if (!number) text += c;
    number = number && c != ']';
  }
  return text;
}

std::string with_names(const Document& document, const std::string& path) {
  std::string text;
  for (std::size_t start = 0; start < path.size();) {
    const std::size_t open = path.find('[', start), close = path.find(']', start);
    text += path.substr(start, open - start);
    if (open == std::string::npos) break;
    const std::optional<std::string> name = name_of_element(document, path.substr(0, close + 1));
    text += name ? "." + *name : path.substr(open, close + 1 - open);
    start = close + 1;
  }
  return text;
}

void expand_short_list(Document& document, const std::string& path, const std::string& key) {
  const auto item = document.items.find(path);
  const auto* written = item == document.items.end() ? nullptr : std::get_if<LiteralList>(&item->second.literal.value);
  if (!written || !std::ranges::all_of(*written, [](const Literal& element) {
        return std::holds_alternative<std::string>(element.value) ||
               std::holds_alternative<LiteralTable>(element.value);
      }))
    return;
  const LiteralList list = *written;
  const Origin origin = item->second.origin;
  document.items.erase(item);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string element = element_path(path, k);
    document.tables[element] = origin;
    if (const auto* table = std::get_if<LiteralTable>(&list[k].value))
      for (const LiteralEntry& entry : *table) document.items[element + "." + entry.key] = {entry.value, origin};
    else
      document.items[element + "." + key] = {list[k], origin};
  }
}

Document parse_document(const std::string& text, const std::string& name) {
  Document document;
  document.file = name;
  std::vector<std::string> problems;
  refuse_endless_keys(text, name);
  try {
    flatten(toml::parse(text), "", document, problems);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line, error.description()));
  }
  if (!problems.empty()) throw InputError(problems);
  return document;
}

Document read_document(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InputError(fmt::format("{}: no such file", path));
  std::ifstream file(path);
  std::stringstream text;
  if (!std::filesystem::is_regular_file(path) || !(text << file.rdbuf()))
    throw InputError(fmt::format("{}: cannot be read", path));
  return parse_document(text.str(), path);
}

void apply_override(Document& document, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == assignment.size())
    throw InputError(fmt::format("--set {}: expected key=value such as time.end=20us", assignment));
  const std::string key = assignment.substr(0, equals);
  const std::string path = with_numbers(document, key);
  const auto element_of_list = [&](const auto& entry) { return entry.first.starts_with(path + "["); };
  std::erase_if(document.items, element_of_list);  // a list given anew replaces the one in the file
  std::erase_if(document.tables, element_of_list);
  document.items[path] = {parse_literal(assignment.substr(equals + 1)),
                          {"--set " + key, std::numeric_limits<int>::max()}};
}

}  // namespace ejecta
