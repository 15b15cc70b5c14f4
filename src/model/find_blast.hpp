#pragma once
/// The front of a blast along rays from its centre.
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "base/types.hpp"
#include "model/quantity.hpp"
#include "model/shock_front.hpp"

namespace ejecta {

/// Directions spread evenly over the circle, or the sphere by the golden angle.
template <int Dim>
std::vector<Vec<Dim>> directions() {
  std::vector<Vec<Dim>> list;
  constexpr int count = Dim == 2 ? 180 : 400;
  for (int k = 0; k < count; ++k) {
    if constexpr (Dim == 2) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / count;
      list.push_back({std::cos(angle), std::sin(angle)});
    } else {
      const double z = 1 - 2 * (k + 0.5) / count, r = std::sqrt(1 - z * z);
      const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * k;
      list.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  }
  return list;
}

/// Asks pressure(x) [Pa] every half `spacing` up to `farthest` [m], or to where it has no answer: there a face ends the
/// ray, and a front next to it is none. `around`: pressure of the surroundings [Pa]. Leaves peak_density at 0.
template <int Dim, class Pressure>
std::optional<BlastFront> find_blast(const Vec<Dim>& centre, double spacing, double farthest, double around,
                                     Pressure&& pressure) {
  const auto all = directions<Dim>();
  std::vector<std::optional<ShockFront>> fronts(all.size());
  parallel_blocks(all.size(), 1, [&](std::size_t k, std::size_t) {
    std::vector<double> radius, values;
    for (double r = 0.5 * spacing; r < farthest; r += 0.5 * spacing) {
      const std::optional<double> found = pressure(Vec<Dim>(centre + r * all[k]));
      if (!found) break;
      radius.push_back(r);
      values.push_back(*found);
    }
    if (radius.empty()) return;
    fronts[k] = find_shock_front(radius, values, around);
    if (fronts[k] && fronts[k]->radius > radius.back() - 2 * spacing) fronts[k].reset();
  });
  BlastFront blast{};
  int found = 0;
  double squares = 0;
  for (const auto& front : fronts) {
    if (!front) continue;
    blast.radius += front->radius;
    squares += front->radius * front->radius;
    blast.peak_pressure += front->peak_pressure;
    ++found;
  }
  if (found == 0) return std::nullopt;
  blast.radius /= found;
  blast.peak_pressure /= found;
  blast.spread = std::sqrt(std::max(0.0, squares / found - blast.radius * blast.radius));
  return blast;
}

/// The front for history and summary; zero before there is a shock.
inline Quantities quantities_of(const std::optional<BlastFront>& blast) {
  const BlastFront now = blast.value_or(BlastFront{});
  return {{"shock radius", "m", now.radius, "mean over directions; 0 before there is a shock", true},
          {"shock radius spread", "m", now.spread, "root mean square over directions"},
          {"shock pressure", "Pa", now.peak_pressure, "largest behind the shock, mean over directions", true}};
}

}  // namespace ejecta
