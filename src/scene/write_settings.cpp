#include <fmt/format.h>

#include <cmath>

#include "scene/settings_io.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

std::string number_text(double value, const std::string& unit) {
  const std::string text = format_exact(value, unit);
  return unit == "1" || unit == "any" ? text : quoted(text);
}

/// A value in TOML, or "" if it is not set.
struct ToToml {
  const Setting& setting;

  std::string operator()(const double* value) const {
    if (is_set(*value)) return number_text(*value, setting.unit);
    return setting.zero_is_unset ? number_text(0, setting.unit) : "";
  }
  std::string operator()(const Triple* value) const {
    if (!is_set((*value)[0])) return "";
    std::string text;
    for (const double component : *value)
      if (is_set(component)) text += (text.empty() ? "" : ", ") + number_text(component, setting.unit);
    return "[" + text + "]";
  }
  std::string operator()(const ColourRange* range) const { return fmt::format("[{}, {}]", range->min, range->max); }
  std::string operator()(const bool* flag) const { return *flag ? "true" : "false"; }
  template <class Integer>
  requires std::integral<Integer> std::string operator()(const Integer* value) const {
    return fmt::format("{}", *value);
  }
  template <class Integer>
  std::string operator()(const std::optional<Integer>* value) const {
    if (*value) return fmt::format("{}", **value);
    return setting.zero_is_unset ? "0" : "";
  }
  std::string operator()(const std::string* text) const { return text->empty() ? "" : quoted(*text); }
  std::string operator()(const std::vector<std::string>* texts) const {
    std::string list;
    for (const std::string& text : *texts) list += (list.empty() ? "" : ", ") + quoted(text);
    return "[" + list + "]";
  }
  std::string operator()(const std::vector<double>* values) const {
    std::string list;
    for (const double value : *values) list += (list.empty() ? "" : ", ") + number_text(value, setting.unit);
    return "[" + list + "]";
  }
  std::string operator()(const FrameTimes* times) const {
    if (times->dense_early) return quoted(std::string(dense_early_word));
    return times->list.empty() ? "" : (*this)(&times->list);
  }
  std::string operator()(const Choice& choice) const {
    const std::string word = choice.get();
    if (word.empty()) return "";
    return word == "true" || word == "false" ? word : quoted(word);
  }
};

std::string toml_of(const Setting& setting) { return std::visit(ToToml{setting}, setting.target); }

/// "bodies[1]" is written [[bodies]], and "bodies[1].profile" [bodies.profile]: it belongs to the body above it.
std::string header(const std::string& section) {
  const std::string name = without_numbers(section);
  return section.ends_with(']') ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

/// What may be written: unit, range or words.
struct Kind {
  const Setting& setting;

  std::string with_limits(const std::string& what) const {
    const std::string limits = to_text(setting.limits, setting.unit);
    return limits.empty() ? what : what + ", " + limits;
  }
  std::string operator()(const double*) const { return with_limits(expected_quantity(setting.unit)); }
  std::string operator()(const Triple*) const { return "x, y, z, each " + expected_quantity(setting.unit); }
  std::string operator()(const ColourRange*) const { return "[min, max], with units or in SI"; }
  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const std::string*) const { return "a text"; }
  std::string operator()(const std::vector<std::string>*) const { return "a list of texts"; }
  std::string operator()(const std::vector<double>*) const {
    return with_limits("a list, each " + expected_quantity(setting.unit));
  }
  std::string operator()(const FrameTimes*) const {
    return fmt::format("\"{}\", or a list, each {}", dense_early_word, expected_quantity(setting.unit));
  }
  std::string operator()(const Choice& choice) const { return fmt::format("{}", fmt::join(choice.words, " | ")); }
  template <class Integer>
  requires std::integral<Integer> std::string operator()(const Integer*) const { return with_limits("a whole number"); }
  template <class Integer>
  std::string operator()(const std::optional<Integer>*) const {
    return with_limits("a whole number");
  }
};

/// "bodies[1]" is called bodies, and insitu.ranges belongs to insitu.
bool belongs_to(const std::string& section, std::string_view wanted) {
  return wanted.empty() ||
         (section.starts_with(wanted) &&
          (section.size() == wanted.size() || section[wanted.size()] == '.' || section[wanted.size()] == '['));
}

template <class Line>
std::string by_section(const Describer& description, std::string_view wanted, std::string_view before_doc,
                       Line&& line) {
  std::string text;
  for (const Describer::Section& section : description.sections()) {
    if (!belongs_to(section.name, wanted)) continue;
    text += fmt::format("\n{}  {}{}\n", header(section.name), before_doc, section.doc);
    for (const Setting& setting : description.settings())
      if (setting.section == section.name) text += line(setting);
  }
  return text;
}

}  // namespace

std::string write_toml(const Describer& description) {
  return by_section(description, "", "# ", [](const Setting& setting) {
    const std::string value = toml_of(setting);
    return value.empty() ? fmt::format("# {}: not set; {}\n", setting.key, setting.doc)
                         : fmt::format("{} = {}  # {}\n", setting.key, value, setting.doc);
  });
}

std::string write_reference(const Describer& description, std::string_view section) {
  return by_section(description, section, "", [](const Setting& setting) {
    const std::string value = toml_of(setting);
    const std::string initial = setting.required ? "required" : value.empty() ? "optional" : "default " + value;
    return fmt::format("  {:<24}{}\n{:26}{}; {}\n", setting.key, setting.doc, "",
                       std::visit(Kind{setting}, setting.target), initial);
  });
}

}  // namespace ejecta
