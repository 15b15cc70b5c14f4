#pragma once
/// How numbers are shown to people: a prefix that suits the magnitude, round tick values, short labels.
#include <array>
#include <string>
#include <vector>

namespace ejecta {

struct Prefix {
  double factor;
  const char* symbol;
};
/// Those that are shown, largest first: here, in the plots by gnuplot and in the pipelines.
inline constexpr std::array<Prefix, 8> prefixes{
    {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}}};

/// value in SI / `si` = value in `label`.
struct DisplayUnit {
  double si = 1;
  std::string label;
};

/// A prefixed unit in which values up to `magnitude` are best read: (2e8, "Pa") -> {1e6, "MPa"}. Units that carry their
/// own prefix (kg...), powers and "1" stay as they are; "1" has an empty label.
DisplayUnit display_unit(double magnitude, const std::string& unit);

/// Values of the form {1, 2, 5} 10^k spaced evenly within [min, max], about `count` of them.
std::vector<double> round_ticks(double min, double max, int count);

/// The shortest text that shows `value` to about four digits.
std::string short_number(double value);

/// "12.5 µs": a time with a prefix that suits `end`, so that it does not change during a movie.
std::string time_text(double time, double end);

}  // namespace ejecta
