#pragma once
/// Support axis of a scheme: how the smoothing of two particles makes the kernel gradient of their pair.
#include "schemes/kernels.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta {

/// Isotropic smoothing length h (SPH). Lanes i against one partner j; the gradient is the mean of those with h_i and
/// h_j.
template <class V, int Dim, class K>
struct IsotropicSupport {
  using S = kernel_detail::Scalar<V>;
  V h, h_reciprocal, slope_norm;  ///< of the lanes i

  struct Pair {
    V slope;   ///< grad_i W_ij = slope (x_j - x_i); 0 exactly where neither reaches the other
    V moment;  ///< |dW/deta| at eta_i = r/h_i
  };

  /// r2 = |x_j - x_i|^2; `j` is the record of the partner with layout R.
  template <class R>
  Pair pair(V r2, const S* j) const {
    // A particle is its own partner too: the guard keeps r = 0 finite, and dx = 0 makes all its terms vanish.
    constexpr S guard = sizeof(S) == sizeof(float) ? S(1e-30) : S(1e-200);
    const V r_reciprocal = simd::reciprocal_sqrt(V(r2 + guard));
    const V r = r2 * r_reciprocal;
    const V q_i = r * h_reciprocal, q_j = r * j[R::h_reciprocal];
    const V slope_i = K::slope_over_q(q_i, V(h * r_reciprocal));
    const V slope_j = K::slope_over_q(q_j, V(j[R::h] * r_reciprocal));
    // Each product is rounded before the sum, so that the pair seen from j gives the same number.
    const V slope = S(-0.5) * (simd::rounded(V(slope_i * slope_norm)) + simd::rounded(V(slope_j * j[R::slope_norm])));
    return {slope, -q_i * slope_i};
  }
  template <class R>
  V mean_h(const S* j) const {
    return S(0.5) * (h + j[R::h]);
  }
};

}  // namespace ejecta
