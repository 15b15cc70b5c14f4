#pragma once
/// How cells vary within, several at a time, and where they hold a shock.
#include "grid/gas_lanes.hpp"
#include "grid/grid_settings.hpp"

namespace ejecta::grid_detail {

/// What is nearest to 0 of three values of one sign, else 0.
[[gnu::always_inline]] inline V nearest_to_zero(V a, V b, V c) {
  return simd::max(V{}, simd::min(simd::min(a, b), c)) + simd::min(V{}, simd::max(simd::max(a, b), c));
}

/// Half the slope of a cell from the differences to both neighbours: monotonised central [van Leer 1977] or the
/// smaller of both.
template <SlopeLimiter limiter>
[[gnu::always_inline]] inline V half_slope(V back, V ahead) {
  if constexpr (limiter == SlopeLimiter::none) return V{};
  if constexpr (limiter == SlopeLimiter::minmod) return 0.5 * nearest_to_zero(back, ahead, ahead);
  return nearest_to_zero(back, ahead, 0.25 * (back + ahead));
}

/// 1 in a strong shock along an axis, of pressures and velocities one cell behind and one ahead; else 0.
[[gnu::always_inline]] inline V strong_shock(V p_1, V p1, V u_1, V u1) {
  constexpr double strong = 1.0 / 3;
  const auto shock =
      (simd::magnitude(V(p1 - p_1)) > strong * simd::min(simd::magnitude(p1), simd::magnitude(p_1))) & (u_1 > u1);
  return shock ? V{} + 1 : V{};
}

/// 1 in smooth flow, 0 inside a strong shock that is steep [Colella & Woodward 1984, A.1; constants of Colella 1990],
/// of pressures from two cells behind to two ahead.
[[gnu::always_inline]] inline V flatness(V strong, V p_2, V p_1, V p1, V p2) {
  constexpr double from = 0.75, to = 0.85, tiny = 1e-200;
  const V jump = simd::magnitude(V(p1 - p_1)), wide = simd::magnitude(V(p2 - p_2));
  // z = jump/wide; 1 - clamp((z - from)/(to - from))
  const V steep = (jump - from * wide) * simd::reciprocal(V((to - from) * wide + tiny));
  return 1 - strong * simd::max(simd::min(steep, V{} + 1), V{});
}

}  // namespace ejecta::grid_detail
