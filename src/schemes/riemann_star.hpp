#pragma once
/// What comes of two gases that meet: pressure and velocity between the waves, for numbers or several at a time.
/// Whatever is made of both sides is the same number when they are swapped and the direction is turned.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/simd.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

/// A gas that meets another; `gamma` = rho c^2/P, the adiabatic index of an ideal gas.
template <class V>
struct MeetingGas {
  V density, pressure, gamma;
};

template <class V>
struct StarState {
  V pressure;      ///< p*, at least 0
  V faster_left;   ///< u_left - u*, how the left gas is compressed
  V faster_right;  ///< u* - u_right
};

namespace riemann_detail {

/// Below it nothing is a density or a pressure.
template <class V>
constexpr kernel_detail::Scalar<V> guard = sizeof(kernel_detail::Scalar<V>) == sizeof(float) ? 1e-30f : 1e-200;

/// Between waves that carry the masses a, b per time: p = p_l + a (u_l - u*) = p_r + b (u* - u_r).
template <class V>
[[gnu::always_inline]] inline StarState<V> between_waves(V a, V b, const MeetingGas<V>& l, const MeetingGas<V>& r,
                                                         V apart) {
  const V share = simd::reciprocal(V(a + b + guard<V>)), more = r.pressure - l.pressure;
  const V left = simd::rounded(V(b * l.pressure)), right = simd::rounded(V(a * r.pressure)),
          both = simd::rounded(V(a * b));
  const V of_left = simd::rounded(V(b * apart)), of_right = simd::rounded(V(a * apart));
  const V p = ((left + right) - simd::rounded(V(both * apart))) * share;
  return {simd::max(p, V{}), (more - of_left) * share, (-more - of_right) * share};
}

/// To eight digits, which is more than the approximate solution has: its chain of roots is what a pair waits for.
template <class V>
[[gnu::always_inline]] inline V root(V a) {
  return simd::square_root(a);
}
#ifdef __AVX512F__
template <>
[[gnu::always_inline]] inline simd::Doubles root(simd::Doubles a) {
  const simd::Doubles from = a + 1e-300, y = (simd::Doubles)_mm512_maskz_rsqrt14_pd(simd::all_doubles, (__m512d)from);
  return a * (y * (1.5 - 0.5 * from * y * y));
}
#endif

/// (rho c)^2
template <class V>
[[gnu::always_inline]] inline V impedance2(const MeetingGas<V>& gas) {
  return simd::rounded(V(gas.gamma * gas.density * gas.pressure));
}

/// Mass per time through a wave behind which the gas is slower by u: a + (a^2 + (rho c)^2)^(1/2), a = rho u (gamma +
/// 1)/4, exact of a shock (u > 0) of an ideal gas [Toro 2009, sect. 3.1.3], right to first order in u of a rarefaction,
/// and positive: where gas parts much faster than it can follow, which leaves nothing in between, the sum would be what
/// rounding leaves of its root, so it goes no further than a = -8 rho c.
template <class V>
[[gnu::always_inline]] inline V mass_through(const MeetingGas<V>& gas, V impedance, V impedance2, V u) {
  using T = kernel_detail::Scalar<V>;
  const V a = T(0.25) * (gas.gamma + T(1)) * (gas.density * u);
  const V through = a > T(-8) * impedance ? V(a + root(simd::fused(a, a, impedance2))) : V(T(1. / 16) * impedance);
  return simd::rounded(through);
}

}  // namespace riemann_detail

/// In one go: waves of sound first, then with the mass that passes through them at the velocity so found. `apart` is
/// u_right - u_left. Of Toro's five problems p* is within a quarter but for that of a near vacuum.
template <class V>
[[gnu::always_inline]] inline StarState<V> approximate_star(const MeetingGas<V>& l, const MeetingGas<V>& r, V apart) {
  using namespace riemann_detail;
  const V zl2 = impedance2(l), zr2 = impedance2(r);
  const V zl = simd::rounded(root(zl2)), zr = simd::rounded(root(zr2));
  const StarState<V> sound = between_waves(zl, zr, l, r, apart);
  return between_waves(mass_through(l, zl, zl2, sound.faster_left), mass_through(r, zr, zr2, sound.faster_right), l, r,
                       apart);
}

namespace riemann_detail {

/// The velocity by which a gas is slowed down behind a wave of pressure p, and its derivative: a shock or a rarefaction
/// [Toro 2009, eqs 4.6, 4.7 and 4.37].
struct Behind {
  double slower, per_pressure;
};
/// Never inlined: both sides must round alike.
[[gnu::noinline]] inline Behind behind_wave(double p, double density, double pressure, double gamma) {
  if (p > pressure) {
    const double A = 2 / ((gamma + 1) * density), B = (gamma - 1) / (gamma + 1) * pressure, q = std::sqrt(A / (p + B));
    return {(p - pressure) * q, q * (1 - 0.5 * (p - pressure) / (p + B))};
  }
  const double c = std::sqrt(gamma * pressure / density), power = 0.5 * (gamma - 1) / gamma;
  const double ratio = std::pow(p / pressure, power);
  return {2 * c / (gamma - 1) * (ratio - 1), c / (gamma * p) * ratio};
}

}  // namespace riemann_detail

/// To round-off, by Newton's method [Toro 2009, sect. 4.3]; every lane goes on until it is there itself, whatever the
/// others do. Out of line: its calls would drive the sums of the loop around it out of the registers.
template <class V>
[[gnu::noinline, gnu::cold]] StarState<V> exact_star(const MeetingGas<V>& l, const MeetingGas<V>& r, V apart) {
  using namespace riemann_detail;
  StarState<V> star = approximate_star(l, r, apart);
  constexpr int lanes = sizeof(V) / sizeof(kernel_detail::Scalar<V>), most_steps = 30;
  for (int k = 0; k < lanes; ++k) {
    const auto of = [k](const V& v) { return simd::lane(v, k); };
    const double rl = of(l.density), pl = of(l.pressure), gl = of(l.gamma), rr = of(r.density), pr = of(r.pressure),
                 gr = of(r.gamma), apart_k = of(apart);
    if (!(pl > 0 && pr > 0)) continue;  // without pressure there is nothing but the shocks of the above
    const double least = 1e-12 * std::min(pl, pr);
    double p = std::max(least, of(star.pressure));
    Behind left{}, right{};
    for (int step = 0; step < most_steps; ++step) {
      left = behind_wave(p, rl, pl, gl);
      right = behind_wave(p, rr, pr, gr);
      const double change = (left.slower + right.slower + apart_k) / (left.per_pressure + right.per_pressure);
      const double next = std::max(p - change, std::max(0.1 * p, least));
      const bool there = std::abs(next - p) <= 1e-13 * p;
      p = next;
      if (there) break;
    }
    left = behind_wave(p, rl, pl, gl);
    right = behind_wave(p, rr, pr, gr);
    const double rest = 0.5 * (left.slower + right.slower + apart_k);  // of either, so that both agree on u*
    simd::set_lane(star.pressure, k, p > least ? p : 0);
    simd::set_lane(star.faster_left, k, left.slower - rest);
    simd::set_lane(star.faster_right, k, right.slower - rest);
  }
  return star;
}

}  // namespace ejecta
