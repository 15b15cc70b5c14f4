#pragma once
/// One line per setting says its key, member, unit, range and meaning. From that one line follow reading, checking, the
/// echo in resolved.toml and the reference printed by `ejecta describe`.
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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
  std::function<std::string()> get;  ///< empty: nothing is set
  std::function<void(std::size_t)> set;
};

/// Where a setting lives.
using Target = std::variant<double*, Triple*, ColourRange*, bool*, int*, std::int64_t*, std::uint64_t*,
                            std::optional<int>*, std::optional<std::int64_t>*, std::string*, std::vector<std::string>*,
                            std::vector<double>*, FrameTimes*, Choice>;

struct Setting {
  std::string section;  ///< "numerics", "bodies[1]"; empty at the top of a file
  std::string key;
  Target target;
  std::string unit;  ///< SI; numbers only
  Limits limits;
  std::string doc;
  bool required = false;
  bool zero_is_unset = false;  ///< a 0 in the file means: not set
  std::string path() const { return section.empty() ? key : section + "." + key; }
};

/// Collects the settings of one file in the order of the reference. Its lists and maps hold what is there already, for
/// the echo; or what a document holds, to be read; or one thing each, for the reference.
class Describer {
 public:
  Describer() = default;
  explicit Describer(const Document& document) : document_(&document) {}  ///< which must outlive it
  static Describer of_all_there_may_be();

  /// What follows belongs to [name], within the section or thing around it. `doc` is one sentence.
  void section(const std::string& name, std::string doc);
  /// What describe() adds belongs to [name], with its sections, lists and maps.
  template <class Describe>
  void section(const std::string& name, std::string doc, Describe&& describe) {
    const Place outer = place_;
    section(name, std::move(doc));
    place_.around = place_.section;
    describe();
    place_ = outer;
  }

  /// [[name]]: a list of things, described one by one with describe(thing); `needed`: at least one.
  template <class T, class Describe>
  void list(const std::string& name, std::vector<T>& things, bool needed, const std::string& doc, Describe&& describe) {
    things.resize(length_of_list(name, needed, things.size()));
    for (std::size_t k = 0; k < things.size(); ++k) section(element_path(name, k), doc, [&] { describe(things[k]); });
  }

  /// [name]: a map of things, described one by one with describe(key, thing). In the reference the key is `any_key`.
  template <class T, class Describe>
  void map(const std::string& name, std::map<std::string, T>& things, const std::string& any_key, std::string doc,
           Describe&& describe) {
    for (const std::string& key : keys_of_map(name, any_key)) things.try_emplace(key);
    section(name, std::move(doc), [&] {
      for (auto& [key, thing] : things) describe(key, thing);
    });
  }

  /// Where the document says what belongs to this section, such as "inputs/x.toml:14"; left alone without a document.
  void origin(std::string& text) const;

  Setting& number(std::string key, double& value, std::string unit, Limits limits, std::string doc);
  Setting& triple(std::string key, Triple& value, std::string unit, std::string doc);
  Setting& range(std::string key, ColourRange& value, std::string doc);
  Setting& flag(std::string key, bool& value, std::string doc);
  /// A whole number: int, std::int64_t or a std::optional of either.
  template <class Integer>
  Setting& integer(const std::string& key, Integer& value, Limits limits, const std::string& doc) {
    return add(key, &value, "1", limits, doc);
  }
  Setting& integer(std::string key, std::uint64_t& value, std::string doc);
  Setting& text(std::string key, std::string& value, std::string doc);
  Setting& numbers(std::string key, std::vector<double>& values, std::string unit, Limits limits, std::string doc);
  Setting& texts(std::string key, std::vector<std::string>& values, std::string doc);
  Setting& frame_times(std::string key, FrameTimes& value, std::string doc);
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
  struct List {
    std::string path;
    bool needed;
  };
  const std::vector<Setting>& settings() const { return settings_; }
  const std::vector<Section>& sections() const { return sections_; }
  const std::vector<List>& lists() const { return lists_; }

 private:
  struct Place {
    std::string around;   ///< path of the section or thing in whose describe() we are
    std::string section;  ///< path of the section that settings are added to
  };
  std::string path_of(const std::string& name) const;
  std::size_t length_of_list(const std::string& name, bool needed, std::size_t present);
  std::vector<std::string> keys_of_map(const std::string& name, const std::string& any_key) const;
  Setting& add(std::string key, Target target, std::string unit, Limits limits, std::string doc);

  std::vector<Setting> settings_;
  std::vector<Section> sections_;
  std::vector<List> lists_;
  Place place_;
  const Document* document_ = nullptr;
  bool all_there_may_be_ = false;
};

}  // namespace ejecta
