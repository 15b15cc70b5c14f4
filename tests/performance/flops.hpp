#pragma once
/// Floating-point operations counted in the source: additions, subtractions, multiplications and divisions are one
/// each, comparisons and signs none. Reciprocals and roots count as the Newton steps that make them (base/simd.hpp).
/// What the caller holds in registers for a whole loop is not counted.
#include "scene/scene.hpp"

namespace ejecta::flops {

/// What a pair pass does.
struct PairWork {
  int dim;
  Kernel kernel;
  bool mixed, stress, gradient, correction;
};

constexpr int reciprocal(bool mixed) { return mixed ? 3 : 6; }
constexpr int reciprocal_sqrt(bool mixed) { return mixed ? 5 : 9; }

constexpr int kernel_slope(Kernel kernel) {
  switch (kernel) {
    case Kernel::cubic_spline:
      return 8;
    case Kernel::quintic_spline:
      return 18;
    case Kernel::wendland_c2:
      return 5;
    case Kernel::wendland_c4:
      break;
  }
  return 10;
}
constexpr int kernel_value(Kernel kernel) {
  switch (kernel) {
    case Kernel::cubic_spline:
    case Kernel::wendland_c2:
      return 8;
    case Kernel::quintic_spline:
      return 19;
    case Kernel::wendland_c4:
      break;
  }
  return 13;
}
/// The splines divide by q, the Wendland kernels do not.
constexpr bool needs_reciprocal_of_q(Kernel kernel) {
  return kernel == Kernel::cubic_spline || kernel == Kernel::quintic_spline;
}

/// x_j - x_i and r^2; positions of mixed precision are sums of two numbers.
constexpr int separation(const PairWork& w) { return w.dim * (w.mixed ? 3 : 1) + 2 * w.dim - 1; }

/// PairPass::rates (schemes/pair_pass_impl.hpp, schemes/support.hpp): one lane and one candidate, to see whether it is
/// within reach.
constexpr int pair_reach(const PairWork& w) {
  return separation(w) + 1 + reciprocal_sqrt(w.mixed) + 3 + 2 * kernel_slope(w.kernel) +
         (needs_reciprocal_of_q(w.kernel) ? 2 : 0) + 4 + 1 + 1;
}
/// The same: one lane and one partner within reach of any lane, for what passes between them.
constexpr int pair_exchange(const PairWork& w) {
  const int stresses = w.stress ? w.dim * (w.dim + 1) / 2 : 1;
  const int approach_and_work = w.dim + w.dim + 2 * (2 * w.dim - 1);
  const int viscosity = 2 + 4 + reciprocal(w.mixed) + 2 + 4 + 4 + 2;
  const int force = stresses + (w.stress ? w.dim * (1 + 2 * w.dim - 1) : 1 + w.dim);
  const int sums = 2 * w.dim + 3;
  const int gradient = w.gradient ? w.dim + 2 * w.dim * w.dim : 2;
  const int correction = w.correction ? w.dim * (w.dim + 1) : 0;
  return approach_and_work + viscosity + force + sums + gradient + correction;
}

/// One lane and one candidate of PairPass::density.
constexpr int pair_density(const PairWork& w) {
  const int reciprocal_of_q = needs_reciprocal_of_q(w.kernel) ? 1 + reciprocal(w.mixed) : 0;
  return separation(w) + 1 + reciprocal_sqrt(w.mixed) + 2 + kernel_value(w.kernel) + 2 + kernel_slope(w.kernel) + 2 +
         reciprocal_of_q;
}

/// One evaluation of the residual of the distension: the condensed branch of Tillotson's equation (33), the pressure of
/// the body with its derivatives (9), one power law of the crush curve (8).
inline constexpr int distension_residual = 50;

/// One particle at one pixel of a slice image of n fields (render/sampling.cpp): distance 8, tabulated kernel 6.
constexpr int slice_pixel(int fields) { return 8 + 6 + 2 * fields + 1; }

}  // namespace ejecta::flops
