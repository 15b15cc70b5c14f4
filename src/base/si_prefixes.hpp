#pragma once
/// The SI prefixes with which quantities are read and shown: in scenes, messages, plots, pipelines and the monitor
/// page.
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "base/json.hpp"

namespace ejecta {

struct SiPrefix {
  int ten;  ///< power of it
  std::string_view symbol;
  std::string_view typed = symbol;  ///< on a plain keyboard

  double factor() const { return std::pow(10.0, ten); }
};

/// Largest first, in steps of a thousand.
inline constexpr std::array si_prefixes{
    SiPrefix{12, "T"}, SiPrefix{9, "G"},       SiPrefix{6, "M"},  SiPrefix{3, "k"},   SiPrefix{0, ""},
    SiPrefix{-3, "m"}, SiPrefix{-6, "µ", "u"}, SiPrefix{-9, "n"}, SiPrefix{-12, "p"}, SiPrefix{-15, "f"}};

/// [1000,"k"]
inline std::string to_json(const SiPrefix& prefix) {
  return '[' + to_json(prefix.factor()) + ',' + to_json(prefix.symbol) + ']';
}

}  // namespace ejecta
