#pragma once
/// JSON text of single values.
#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace ejecta {

/// Quoted and escaped, for Python too, whose strings have the same escapes; UTF-8 passes through.
inline std::string to_json(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      quoted += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

/// Shortest text that reads back as the same number; null if it is not finite, which JSON cannot express.
inline std::string to_json(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

inline std::string to_json(std::integral auto value) { return fmt::format("{}", value); }

/// [1,2,3]: of what to_json knows, or of JSON texts made by `text(value)`.
template <class Values, class Text>
std::string json_list(const Values& values, Text text) {
  std::string list = "[";
  for (const auto& value : values) {
    if (list.size() > 1) list += ',';
    list += text(value);
  }
  return list + ']';
}
template <class Values>
std::string json_list(const Values& values) {
  return json_list(values, [](const auto& value) { return to_json(value); });
}

/// null if there is no value.
template <class T>
std::string to_json(const std::optional<T>& value) {
  return value ? to_json(*value) : "null";
}

}  // namespace ejecta
