#pragma once
/// Where the outermost shock of a pressure profile is.
#include <algorithm>
#include <cassert>
#include <optional>
#include <span>

namespace ejecta {

/// The front of a blast as it is now.
struct BlastFront {
  double radius;         ///< of the shock, mean over directions [m]
  double spread;         ///< root mean square deviation from it [m]
  double peak_density;   ///< anywhere [kg/m^3]
  double peak_pressure;  ///< behind the shock, mean over directions [Pa]
};

struct ShockFront {
  double radius;         ///< m
  double peak_pressure;  ///< behind the shock [Pa]
};

/// The shock that is met first when one comes from outside. Its peak is the largest pressure [Pa] met before the
/// pressure has fallen to 0.9 of that again; the pressure may be higher further in. Its radius is the outermost place
/// where the pressure is half way between that of the surroundings and the peak, linear between samples, `r` [m]
/// ascending. Nothing where no pressure is above 1.1 of the surroundings'.
inline std::optional<ShockFront> find_shock_front(std::span<const double> r, std::span<const double> pressure,
                                                  double ambient) {
  assert(r.size() == pressure.size());
  double peak = 1.1 * ambient;
  bool found = false;
  for (std::size_t i = r.size(); i-- > 0 && !(found && pressure[i] <= 0.9 * peak);)
    if (pressure[i] > peak) peak = pressure[i], found = true;
  if (!found) return std::nullopt;
  const double half = 0.5 * (peak + ambient);
  std::size_t i = r.size() - 1;
  while (pressure[i] < half) --i;
  if (i + 1 == r.size()) return ShockFront{r[i], peak};
  const double share = (pressure[i] - half) / (pressure[i] - pressure[i + 1]);
  return ShockFront{r[i] + share * (r[i + 1] - r[i]), peak};
}

}  // namespace ejecta
