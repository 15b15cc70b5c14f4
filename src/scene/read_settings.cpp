#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "scene/settings_io.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

[[noreturn]] void refuse(std::string_view expected, const Literal& got) {
  throw InputError(fmt::format("expected {}, got {}", expected, to_text(got)));
}

std::string with_limits(const std::string& what, const Limits& limits, std::string_view unit) {
  const std::string text = to_text(limits, unit);
  return text.empty() ? what : what + ", " + text;
}

bool inside(double value, const Limits& limits) {
  return std::isfinite(value) && (limits.open_min ? value > limits.min : value >= limits.min) && value <= limits.max;
}

double number_of(const Literal& literal, const std::string& unit) {
  const auto* integer = std::get_if<std::int64_t>(&literal.value);
  const auto* real = std::get_if<double>(&literal.value);
  if (integer || real) {
    const double value = integer ? static_cast<double>(*integer) : *real;
    if (unit != "1" && unit != "any" && value != 0)
      throw InputError(
          fmt::format("expected {}, got {} (the unit is missing)", expected_quantity(unit), to_text(literal)));
    return value + 0.0;  // no negative zero: echoed as -0, it would come back as the whole number 0
  }
  if (const auto* text = std::get_if<std::string>(&literal.value)) return parse_quantity(*text, unit) + 0.0;
  refuse(expected_quantity(unit), literal);
}

/// [0, 0, "5 km/s"], or the same as one text for the command line: "0 0 5 km/s".
LiteralList vector_of(const Literal& literal, std::string_view expected) {
  if (const auto* list = std::get_if<LiteralList>(&literal.value)) {
    if (list->size() < 2 || list->size() > 3) refuse(expected, literal);
    return *list;
  }
  const auto* text = std::get_if<std::string>(&literal.value);
  if (!text) refuse(expected, literal);
  std::vector<std::string> numbers;
  std::string_view rest = *text;
  constexpr std::string_view digits = "+-.0123456789eE", separators = " ,()";
  while (numbers.size() < 3) {
    rest.remove_prefix(std::min(rest.find_first_not_of(separators), rest.size()));
    const std::size_t length = std::min(rest.find_first_not_of(digits), rest.size());
    if (length == 0) break;
    numbers.emplace_back(rest.substr(0, length));
    rest.remove_prefix(length);
  }
  if (numbers.size() < 2) refuse(expected, literal);
  rest.remove_prefix(std::min(rest.find_first_not_of(separators), rest.size()));
  LiteralList list;
  for (const std::string& number : numbers) list.push_back({number + " " + std::string(rest)});
  return list;
}

/// Writes a literal into the target of a setting; throws InputError with what was expected and got.
struct Assign {
  const Setting& setting;
  const Literal& literal;

  void operator()(double* target) const {
    const double value = number_of(literal, setting.unit);
    if (!inside(value, setting.limits))
      refuse(with_limits(expected_quantity(setting.unit), setting.limits, setting.unit), literal);
    *target = value == 0 && setting.zero_is_unset ? unset : value;
  }
  void operator()(Triple* target) const {
    const std::string expected = "two or three components, each " + expected_quantity(setting.unit);
    const LiteralList list = vector_of(literal, expected);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const double value = number_of(list[k], setting.unit);
      if (!std::isfinite(value)) refuse(expected, literal);
      (*target)[k] = value;
    }
  }
  void operator()(ColourRange* target) const {
    const auto* list = std::get_if<LiteralList>(&literal.value);
    constexpr std::string_view expected = "a smallest and a larger value such as [0, 1] or [\"-1 MPa\", \"1 GPa\"]";
    if (!list || list->size() != 2) refuse(expected, literal);
    const double min = number_of((*list)[0], setting.unit), max = number_of((*list)[1], setting.unit);
    if (!(min < max) || !std::isfinite(max - min)) refuse(expected, literal);
    *target = {min, max};
  }
  void operator()(bool* target) const {
    if (const bool* flag = std::get_if<bool>(&literal.value))
      *target = *flag;
    else
      refuse("true or false", literal);
  }
  template <class Integer>
  requires std::integral<Integer>
  void operator()(Integer* target) const {
    const auto* integer = std::get_if<std::int64_t>(&literal.value);
    if (!integer || !inside(static_cast<double>(*integer), setting.limits) || !std::in_range<Integer>(*integer))
      refuse(with_limits("a whole number", setting.limits, "1"), literal);
    *target = static_cast<Integer>(*integer);
  }
  template <class Integer>
  void operator()(std::optional<Integer>* target) const {
    Integer value{};
    (*this)(&value);
    *target = value == 0 && setting.zero_is_unset ? std::nullopt : std::optional(value);
  }
  void operator()(std::string* target) const {
    const auto* text = std::get_if<std::string>(&literal.value);
    if (!text) refuse("a text in quotes", literal);
    *target = *text;
  }
  void operator()(std::vector<std::string>* target) const {
    const auto* list = std::get_if<LiteralList>(&literal.value);
    if (!list) refuse("a list of texts such as [\"a\", \"b\"]", literal);
    std::vector<std::string> texts;
    for (const Literal& element : *list) {
      const auto* text = std::get_if<std::string>(&element.value);
      if (!text) refuse("a list of texts such as [\"a\", \"b\"]", literal);
      texts.push_back(*text);
    }
    *target = std::move(texts);
  }
  void operator()(std::vector<double>* target) const {
    const std::string expected =
        "a list, each " + with_limits(expected_quantity(setting.unit), setting.limits, setting.unit);
    const auto* list = std::get_if<LiteralList>(&literal.value);
    if (!list) refuse(expected, literal);
    std::vector<double> values;
    for (const Literal& element : *list) {
      values.push_back(number_of(element, setting.unit));
      if (!inside(values.back(), setting.limits)) refuse(expected, literal);
    }
    *target = std::move(values);
  }
  void operator()(FrameTimes* target) const {
    FrameTimes times;
    const auto* text = std::get_if<std::string>(&literal.value);
    times.dense_early = text && *text == dense_early_word;
    if (text && !times.dense_early)
      refuse(fmt::format("\"{}\" or a list of times such as [\"1 us\", \"5 us\"]", dense_early_word), literal);
    if (!text) (*this)(&times.list);
    *target = std::move(times);
  }
  void operator()(const Choice& choice) const {
    const auto* text = std::get_if<std::string>(&literal.value);
    const std::string flag = std::holds_alternative<bool>(literal.value) ? to_text(literal) : "";  // true, false, auto
    if (!flag.empty()) text = &flag;
    const auto found = text ? std::find(choice.words.begin(), choice.words.end(), *text) : choice.words.end();
    if (found != choice.words.end()) return choice.set(static_cast<std::size_t>(found - choice.words.begin()));
    const std::string hint = text ? nearest_word(*text, choice.words) : "";
    throw InputError(fmt::format("expected one of {}, got {}{}", fmt::join(choice.words, ", "), to_text(literal),
                                 hint.empty() ? "" : ", did you mean " + hint + "?"));
  }
};

std::string last_key(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// The described path a misspelt one was meant to be: the nearest spelling, or the same key in another section.
std::string suggestion(const std::string& path, const std::vector<std::string>& known) {
  if (const std::string near = nearest_word(path, known); !near.empty()) return near;
  for (const std::string& candidate : known)
    if (last_key(candidate) == last_key(path)) return candidate;
  return "";
}

/// Whether a path belongs to what is written as something else than a list.
bool in_place_of_a_list(const Describer& description, const std::string& path) {
  return std::ranges::any_of(description.lists(), [&](const Describer::List& list) {
    return path == list.path || path.starts_with(list.path + ".");
  });
}

void check_lists(const Describer& description, const Document& document, Problems& problems) {
  for (const auto& [path, needed] : description.lists()) {
    const bool written_otherwise = document.tables.contains(path) || document.items.contains(path);
    if (written_otherwise || (needed && document.count(path) == 0))
      problems.add(document.origin(path), path,
                   fmt::format("expected {}, each written under [[{}]]", needed ? "at least one" : "any number of them",
                               without_numbers(path)));
  }
}

void refuse_unknown(const Describer& description, const Document& document, Problems& problems) {
  std::vector<std::string> keys, sections;
  for (const Setting& setting : description.settings()) keys.push_back(setting.path());
  // Every section and every table around one is known: [insitu] for [insitu.ranges].
  for (const Describer::Section& section : description.sections())
    for (std::size_t dot = section.name.find('.');; dot = section.name.find('.', dot + 1)) {
      sections.push_back(section.name.substr(0, dot));
      if (dot == std::string::npos) break;
    }
  const auto known = [](const std::vector<std::string>& list, const std::string& path) {
    return std::find(list.begin(), list.end(), path) != list.end();
  };
  const auto hint = [](const std::string& text) { return text.empty() ? "" : ", did you mean " + text + "?"; };
  // The outermost unknown table around a path, or "" if all are known.
  const auto unknown_table = [&](const std::string& path) -> std::string {
    for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1))
      if (!known(sections, path.substr(0, dot))) return path.substr(0, dot);
    return "";
  };
  const auto refuse_table = [&](const std::string& table, const Origin& origin) {
    if (problems.has(table)) return;
    if (known(keys, table)) return problems.add(origin, table, "expected a value, got a section");
    problems.add(origin, table, "unknown section" + hint(nearest_word(table, sections)));
  };
  for (const auto& [path, origin] : document.tables) {
    const std::string table = unknown_table(path + ".");
    if (!table.empty() && !in_place_of_a_list(description, path)) refuse_table(table, document.tables.at(path));
  }
  for (const auto& [path, item] : document.items) {
    if (known(keys, path) || in_place_of_a_list(description, path)) continue;
    if (const std::string table = unknown_table(path); !table.empty())
      refuse_table(table, item.origin);
    else if (known(sections, path))
      problems.add(item.origin, path, fmt::format("expected a section, got {}", to_text(item.literal)));
    else
      problems.add(item.origin, path, "unknown key" + hint(suggestion(path, keys)));
  }
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  // Optimal string alignment distance, row by row.
  const auto distance = [](std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
      for (std::size_t j = 0; j <= b.size(); ++j) {
        if (i == 0 || j == 0) {
          d[i][j] = i + j;
          continue;
        }
        d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    return d[a.size()][b.size()];
  };
  std::string best;
  const std::string key = last_key(std::string(word));
  std::size_t least = key.size() < 3 ? 0 : std::max<std::size_t>(1, key.size() / 3) + 1;  // short words resemble all
  for (const std::string& candidate : candidates) {
    if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) >= least) continue;
    if (const std::size_t d = distance(word, candidate); d < least) {
      least = d;
      best = candidate;
    }
  }
  return best;
}

void Problems::add(const Origin& origin, const std::string& path, std::string_view message) {
  const bool on_command_line = origin.text == "--set " + path;
  messages_.emplace_back(origin.line, on_command_line ? fmt::format("{}: {}", origin.text, message)
                                                      : fmt::format("{}: {}: {}", origin.text, path, message));
  paths_.insert(path);
}

void Problems::add(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) messages_.emplace_back(std::numeric_limits<int>::max(), message);
}

void Problems::throw_if_any() const {
  if (messages_.empty()) return;
  auto sorted = messages_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> texts;
  texts.reserve(sorted.size());
  for (auto& [line, text] : sorted) texts.push_back(std::move(text));
  throw InputError(std::move(texts));
}

void read_settings(const Describer& description, const Document& document, Problems& problems) {
  for (const Setting& setting : description.settings()) {
    const auto item = document.items.find(setting.path());
    if (item == document.items.end()) {
      if (setting.required && !document.tables.contains(setting.path()) && !problems.has(setting.path()))
        problems.add(document.origin(setting.path()), setting.path(), "missing: " + setting.doc);
      continue;
    }
    try {
      std::visit(Assign{setting, item->second.literal}, setting.target);
    } catch (const InputError& error) {
      problems.add(item->second.origin, setting.path(), error.what());
    }
  }
  check_lists(description, document, problems);
  refuse_unknown(description, document, problems);
}

}  // namespace ejecta
