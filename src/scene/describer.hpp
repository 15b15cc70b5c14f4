#pragma once
/// One line per setting says its key, member, unit, range and meaning. From that one line follow reading, checking, the
/// echo in resolved.toml and the reference printed by `ejecta describe`.
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/scene.hpp"

namespace ejecta {

/// The numbers a setting may take.
struct Limits {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;  ///< min itself is excluded
};
inline constexpr Limits any_number{};
inline constexpr Limits positive{.min = 0, .open_min = true};
inline constexpr Limits non_negative{.min = 0};
constexpr Limits at_least(double min) { return {.min = min}; }
constexpr Limits between(double min, double max) { return {.min = min, .max = max}; }

/// "> 0", ">= 2", "from 0 to 1"; empty without limits. `si_unit` is appended to the numbers unless they are zero.
std::string to_text(const Limits& limits, std::string_view si_unit);

/// One of a fixed list of words, behind an enumeration or a string.
struct Choice {
  std::vector<std::string> words;
  std::function<std::string()> get;
  std::function<void(std::size_t)> set;
};

/// Where a setting lives.
using Target = std::variant<double*, Triple*, ColourRange*, bool*, int*, std::int64_t*, std::uint64_t*, std::string*,
                            std::vector<std::string>*, Choice>;

struct Setting {
  std::string section;  ///< "numerics", "bodies[1]"; empty at the top of a file
  std::string key;
  Target target;
  std::string unit;  ///< SI; numbers only
  Limits limits;
  std::string doc;
  bool required = false;
  std::string path() const { return section.empty() ? key : section + "." + key; }
};

/// Collects the settings of one file in the order of the reference.
class Describer {
 public:
  /// What follows belongs to [name]. `doc` is one sentence.
  void section(std::string name, std::string doc);

  Setting& number(std::string key, double& value, std::string unit, Limits limits, std::string doc);
  Setting& triple(std::string key, Triple& value, std::string unit, std::string doc);
  Setting& range(std::string key, ColourRange& value, std::string doc);
  Setting& flag(std::string key, bool& value, std::string doc);
  Setting& integer(std::string key, int& value, Limits limits, std::string doc);
  Setting& integer(std::string key, std::int64_t& value, Limits limits, std::string doc);
  Setting& integer(std::string key, std::uint64_t& value, std::string doc);
  Setting& text(std::string key, std::string& value, std::string doc);
  Setting& texts(std::string key, std::vector<std::string>& values, std::string doc);
  /// A word on which the rest of the description depends: it has been read before, and is only echoed and documented.
  Setting& chosen(std::string key, std::string word, std::vector<std::string> words, std::string doc);

  /// An enumeration whose words, in its order, are given by enum_names(value).
  template <class Enum>
  Setting& choice(std::string key, Enum& value, std::string doc) {
    const auto names = enum_names(value);
    Choice choice{{names.begin(), names.end()},
                  [&value] { return std::string(enum_names(value)[static_cast<std::size_t>(value)]); },
                  [&value](std::size_t k) { value = static_cast<Enum>(k); }};
    return add(std::move(key), std::move(choice), "", any_number, std::move(doc));
  }

  struct Section {
    std::string name, doc;
  };
  const std::vector<Setting>& settings() const { return settings_; }
  const std::vector<Section>& sections() const { return sections_; }

 private:
  Setting& add(std::string key, Target target, std::string unit, Limits limits, std::string doc);

  std::vector<Setting> settings_;
  std::vector<Section> sections_;
};

}  // namespace ejecta
