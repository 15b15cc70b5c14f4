#pragma once
/// Smoothing kernels, written once over a value type V (double or a vector of lanes). q = r/h >= 0. They are given
/// without normalisation: W(r, h) = norm<Dim> / h^Dim value(q). Beyond the support everything is exactly zero.
/// `slope_over_q` is W'(q)/q <= 0; the reciprocal of q is handed in because its callers have it at hand.
/// The pair loop takes a shorter form in a = max(0, 1 - q/support): -W'(q) = reduced_scale reduced_slope(a), times q
/// unless reduced_over_r.
#include <numbers>

#include "base/simd.hpp"
#include "scene/choices.hpp"

namespace ejecta {

namespace kernel_detail {
/// max(a, 0) for a number or lane by lane.
template <class V>
inline V positive(V a) {
  return simd::max(a, V{});
}
/// A constant as a number of the same precision as the lanes of V: literals would widen float lanes.
template <class V>
struct ScalarOf {
  using type = V;
};
template <>
struct ScalarOf<simd::Doubles> {
  using type = double;
};
template <>
struct ScalarOf<simd::Floats> {
  using type = float;
};
template <class V>
using Scalar = typename ScalarOf<V>::type;

/// exp(-x) for x from 0 to 9, to 3e-14 of itself: Taylor's series of x/32 about its middle, squared five times.
template <class V>
V decay(V x) {
  using S = Scalar<V>;
  constexpr double at_the_middle = 0.8688150562628432;  // exp(-9/64)
  constexpr double coefficients[] = {1. / 362880, 1. / 40320, 1. / 5040, 1. / 720, 1. / 120,
                                     1. / 24,     1. / 6,     0.5,       1,        1};
  const V t = S(9. / 64) - S(1. / 32) * x;
  V sum{};
  for (const double c : coefficients) sum = sum * t + S(c);
  sum *= S(at_the_middle);
  for (int k = 0; k < 5; ++k) sum *= sum;
  return sum;
}
}  // namespace kernel_detail

/// Cubic B-spline M4 [Monaghan 2005].
struct CubicSpline {
  static constexpr double support = 2;
  template <int Dim>
  static constexpr double norm = Dim == 2 ? 10 / (7 * std::numbers::pi) : 1 / std::numbers::pi;
  template <class V>
  static V value(V q) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(2) - q), b = kernel_detail::positive(S(1) - q);
    return S(0.25) * a * a * a - b * b * b;
  }
  template <class V>
  static V slope_over_q(V q, V q_reciprocal) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(2) - q), b = kernel_detail::positive(S(1) - q);
    return (S(3) * b * b - S(0.75) * a * a) * q_reciprocal;
  }
  static constexpr bool reduced_over_r = true;
  static constexpr double reduced_scale = 3;
  template <class V>
  static V reduced_slope(V a) {
    using S = kernel_detail::Scalar<V>;
    const V b = kernel_detail::positive(V(a + a - S(1)));
    return a * a - b * b;
  }
};

/// Quintic B-spline M6 [Monaghan 2005].
struct QuinticSpline {
  static constexpr double support = 3;
  template <int Dim>
  static constexpr double norm = Dim == 2 ? 7 / (478 * std::numbers::pi) : 1 / (120 * std::numbers::pi);
  template <class V>
  static V value(V q) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(3) - q), b = kernel_detail::positive(S(2) - q),
            c = kernel_detail::positive(S(1) - q);
    return a * a * a * a * a - S(6) * (b * b * b * b * b) + S(15) * (c * c * c * c * c);
  }
  template <class V>
  static V slope_over_q(V q, V q_reciprocal) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(3) - q), b = kernel_detail::positive(S(2) - q),
            c = kernel_detail::positive(S(1) - q);
    return (S(30) * (b * b * b * b) - S(5) * (a * a * a * a) - S(75) * (c * c * c * c)) * q_reciprocal;
  }
  static constexpr bool reduced_over_r = true;
  static constexpr double reduced_scale = 5;
  template <class V>
  static V reduced_slope(V s) {
    using S = kernel_detail::Scalar<V>;
    V a = S(3) * s, b = kernel_detail::positive(V(a - S(1))), c = kernel_detail::positive(V(a - S(2)));
    a *= a;
    b *= b;
    c *= c;
    return a * a - S(6) * (b * b) + S(15) * (c * c);
  }
};

/// Wendland C2 scaled to support 2h [Dehnen & Aly 2012].
struct WendlandC2 {
  static constexpr double support = 2;
  template <int Dim>
  static constexpr double norm = Dim == 2 ? 7 / (4 * std::numbers::pi) : 21 / (16 * std::numbers::pi);
  template <class V>
  static V value(V q) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(1) - S(0.5) * q);
    return a * a * a * a * (S(1) + S(2) * q);
  }
  template <class V>
  static V slope_over_q(V q, V) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(1) - S(0.5) * q);
    return S(-5) * a * a * a;
  }
  static constexpr bool reduced_over_r = false;
  static constexpr double reduced_scale = 5;
  template <class V>
  static V reduced_slope(V a) {
    return a * a * a;
  }
};

/// Wendland C4 scaled to support 2h [Dehnen & Aly 2012].
struct WendlandC4 {
  static constexpr double support = 2;
  template <int Dim>
  static constexpr double norm = Dim == 2 ? 9 / (4 * std::numbers::pi) : 495 / (256 * std::numbers::pi);
  template <class V>
  static V value(V q) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(1) - S(0.5) * q);
    return a * a * a * a * a * a * (S(1) + S(3) * q + S(35.0 / 12) * q * q);
  }
  template <class V>
  static V slope_over_q(V q, V) {
    using S = kernel_detail::Scalar<V>;
    const V a = kernel_detail::positive(S(1) - S(0.5) * q);
    return S(-14.0 / 3) * (S(1) + S(2.5) * q) * a * a * a * a * a;
  }
  static constexpr bool reduced_over_r = false;
  static constexpr double reduced_scale = 14.0 / 3;
  template <class V>
  static V reduced_slope(V a) {
    using S = kernel_detail::Scalar<V>;
    const V a2 = a * a;
    return a2 * a2 * (S(6) * a - S(5) * a2);
  }
};

/// exp(-q^2) [Gingold & Monaghan 1977], cut off at q = 3 as in PySPH, where it is 1.2e-4 of its peak, and normalised
/// within. Riemann particles alone have it: they divide densities by what the kernel gives on a lattice, and their
/// gradients are exact for linear fields, so that nothing is lost with what is cut off.
struct Gaussian {
  static constexpr double support = 3;
  static constexpr double at_the_cut = 1.2340980408667956e-4, erf_3 = 0.99997790950300142;  ///< exp(-9), erf(3)
  template <int Dim>
  static constexpr double norm = 1 / (std::numbers::pi *
                                      (Dim == 2 ? 1 - at_the_cut : erf_3 / std::numbers::inv_sqrtpi - 6 * at_the_cut));
  template <class V>
  static V value(V q) {
    using S = kernel_detail::Scalar<V>;
    return q < S(support) ? kernel_detail::decay(V(q * q)) : V{};
  }
  template <class V>
  static V slope_over_q(V q, V) {
    using S = kernel_detail::Scalar<V>;
    return S(-2) * value(q);
  }
  static constexpr bool reduced_over_r = false;
  static constexpr double reduced_scale = 2;
  template <class V>
  static V reduced_slope(V a) {
    using S = kernel_detail::Scalar<V>;
    const V q = S(support) - S(support) * a;
    return a > S(0) ? kernel_detail::decay(V(q * q)) : V{};
  }
};

/// Calls f with the kernel struct that the name stands for.
template <class F>
decltype(auto) with_kernel(Kernel kernel, F&& f) {
  switch (kernel) {
    case Kernel::cubic_spline:
      return f(CubicSpline{});
    case Kernel::quintic_spline:
      return f(QuinticSpline{});
    case Kernel::wendland_c2:
      return f(WendlandC2{});
    case Kernel::wendland_c4:
      return f(WendlandC4{});
    case Kernel::gaussian:
      break;
  }
  return f(Gaussian{});
}

/// Support radius of a kernel in units of h.
inline double kernel_support(Kernel kernel) {
  return with_kernel(kernel, [](auto k) { return decltype(k)::support; });
}

}  // namespace ejecta
