#pragma once
/// Floating-point operations counted in the source: additions, subtractions, multiplications and divisions are one
/// each, comparisons and signs none. Reciprocals of single precision count as the Newton steps that make them
/// (base/simd.hpp), those of double precision and roots as one. What the caller holds in registers for a whole loop is
/// not counted.
#include "scene/scene.hpp"

namespace ejecta::flops {

/// What a pair pass does.
struct PairWork {
  int dim;
  Kernel kernel;
  bool mixed, stress, gradient, correction;
};

constexpr int reciprocal(bool mixed) { return mixed ? 3 : 1; }

constexpr int kernel_slope(Kernel kernel) {
  switch (kernel) {
    case Kernel::cubic_spline:
      return 8;
    case Kernel::quintic_spline:
      return 18;
    case Kernel::wendland_c2:
      return 5;
    case Kernel::gaussian:
      return 30;
    case Kernel::wendland_c4:
      break;
  }
  return 10;
}
/// Of the shorter form that the pair loop takes.
constexpr int reduced_slope(Kernel kernel) {
  switch (kernel) {
    case Kernel::cubic_spline:
      return 5;
    case Kernel::quintic_spline:
      return 13;
    case Kernel::wendland_c2:
      return 2;
    case Kernel::gaussian:
      return 31;
    case Kernel::wendland_c4:
      break;
  }
  return 6;
}
constexpr int kernel_value(Kernel kernel) {
  switch (kernel) {
    case Kernel::cubic_spline:
    case Kernel::wendland_c2:
      return 8;
    case Kernel::quintic_spline:
      return 19;
    case Kernel::gaussian:
      return 29;
    case Kernel::wendland_c4:
      break;
  }
  return 13;
}
/// The splines divide by q, the others do not.
constexpr bool needs_reciprocal_of_q(Kernel kernel) {
  return kernel == Kernel::cubic_spline || kernel == Kernel::quintic_spline;
}

/// x_j - x_i and r^2; positions of mixed precision are sums of two numbers.
constexpr int separation(const PairWork& w) { return w.dim * (w.mixed ? 3 : 1) + 2 * w.dim - 1; }

/// PairPass::rates (schemes/pair_rates.hpp, schemes/support.hpp): one lane and one candidate, to see whether it is
/// within reach; once for the moments too, where gradients are corrected.
constexpr int pair_reach(const PairWork& w) {
  const int distances = 1 + 4, slopes = 2 * reduced_slope(w.kernel) + 3;
  const int over_r = needs_reciprocal_of_q(w.kernel) ? 2 : 0, moment = needs_reciprocal_of_q(w.kernel) ? 1 : 3;
  return (w.correction ? 2 : 1) * (separation(w) + distances + slopes + over_r + moment);
}
/// The same: one lane and one partner within reach of any lane, for what passes between them. Partners are about as
/// dense as their neighbours, and all of them close; in single precision the shares of their weights are applied all
/// the same.
constexpr int pair_exchange(const PairWork& w) {
  const int dim = w.dim, dot = 2 * dim - 1;
  const int differences = dim + dot, gradients = 1 + dim + 2 * dim * dim;
  const int viscosity = 1 + 5 + 3 + 9;
  const int moment = w.correction ? 1 + 3 * dim + dim * (dim + 1) : 0;
  if (w.stress && !w.mixed) {
    const int stresses = dim + 2 * dim * dim, push = 2 + 2 * dim + 2;
    return differences + gradients + stresses + viscosity + push + moment;
  }
  const int shares = w.mixed ? 2 + 3 + 3 + 2 : 0, stresses = w.stress ? dim * dim : 1;
  const int contraction = stresses + (w.stress ? dim * dot + 2 * dim : 2 * dim);
  const int force = (w.mixed ? 2 * contraction + 2 * stresses : contraction) + dim;
  const int work = w.mixed ? 3 * dim + dot + 2 : dot + 2;
  return shares + differences + dim + viscosity + force + work + 2 * dim + (w.gradient ? gradients : 1 + dot + 2) +
         moment;
}

/// One lane and one candidate of PairPass::density.
constexpr int pair_density(const PairWork& w) {
  const int reciprocal_of_q = needs_reciprocal_of_q(w.kernel) ? 1 + reciprocal(w.mixed) : 0;
  return separation(w) + 1 + 1 + 2 + kernel_value(w.kernel) + 2 + kernel_slope(w.kernel) + 2 + reciprocal_of_q;
}

/// One evaluation of the residual of the distension: the condensed branch of Tillotson's equation (33), the pressure of
/// the body with its derivatives (9), one power law of the crush curve (8).
inline constexpr int distension_residual = 50;

/// One particle at one pixel of a slice image of n fields (render/sampling.cpp): distance 8, tabulated kernel 6.
constexpr int slice_pixel(int fields) { return 8 + 6 + 2 * fields + 1; }

}  // namespace ejecta::flops
