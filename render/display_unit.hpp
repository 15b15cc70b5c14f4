#pragma once
/// How numbers are shown to people: a prefix that suits the magnitude, round tick values, short labels.
#include <string>
#include <vector>

namespace ejecta {

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
