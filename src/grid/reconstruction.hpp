#pragma once
/// How cells vary within, several at a time, and where they hold a shock.
#include "grid/gas_lanes.hpp"
#include "grid/grid_settings.hpp"

namespace ejecta::grid_detail {

/// Slope of a cell from the differences to both neighbours.
template <SlopeLimiter limiter>
[[gnu::always_inline]] inline V slope(V back, V ahead) {
  if constexpr (limiter == SlopeLimiter::none) return V{};
  const V sizes = simd::min(simd::magnitude(back), simd::magnitude(ahead));
  const V mean = 0.5 * (back + ahead);
  // Monotonised central [van Leer 1977], or the smaller of both.
  const V size = limiter == SlopeLimiter::minmod ? sizes : simd::min(V(2 * sizes), simd::magnitude(mean));
  const V signed_size = mean < 0 ? V(-size) : size;
  return back * ahead > 0 ? signed_size : V{};
}

/// `flat` is 1 in smooth flow, 0 inside a strong shock along an axis that is steep [Colella & Woodward 1984, A.1; constants
/// of Colella 1990]; `strong` is 1 in a strong shock, steep or not, else 0.
struct Shock {
  V flat, strong;
};
/// Of pressures two cells behind to two ahead, and velocities along the axis one behind and one ahead.
[[gnu::always_inline]] inline Shock shock_of(V p_2, V p_1, V p1, V p2, V u_1, V u1) {
  constexpr double strong = 1.0 / 3, from = 0.75, to = 0.85, tiny = 1e-200;
  const V jump = simd::magnitude(V(p1 - p_1)), wide = simd::magnitude(V(p2 - p_2));
  // z = jump/wide; 1 - clamp((z - from)/(to - from))
  const V steep = (jump - from * wide) * simd::reciprocal(V((to - from) * wide + tiny));
  const V flat = 1 - simd::max(simd::min(steep, V{} + 1), V{});
  const auto shock = (jump > strong * simd::min(simd::magnitude(p1), simd::magnitude(p_1))) & (u_1 > u1);
  return {shock ? flat : V{} + 1, shock ? V{} + 1 : V{}};
}

}  // namespace ejecta::grid_detail
