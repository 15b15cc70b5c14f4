#pragma once
/// Choice of the smoothing length from the zeroth moment of the neighbours: seed 001 (Owen 2010), eqs (1)-(4).
#include <vector>

#include "scene/scene.hpp"

namespace ejecta {

/// Psi0 = (sum_j |dW/deta|(eta_j))^(1/Dim) (eq. 1) as a function of n_h, the particles per smoothing length, by exact
/// sums over the cubic lattice. The sum leaves out the particle itself and the kernel's normalisation.
class SupportSize {
 public:
  SupportSize(Kernel kernel, int dim, double nodes_per_h);

  /// Effective n_h of a particle whose sum over neighbours is `neighbour_sum`. With no neighbours: half the target.
  double effective_nodes_per_h(double neighbour_sum) const;

  /// Factor to apply to h so that n_h moves to its target: 1 - a + a s with s = target/effective in [1/4, 4], and
  /// a = 0.4 (1 + s^2) for s < 1, 0.4 (1 + s^-3) otherwise (eqs 2-3).
  double growth(double neighbour_sum) const;

  /// Psi0 on the table at n_h.
  double psi0(double nodes_per_h) const;

 private:
  static constexpr double first_ = 0.25, last_ = 8, step_ = 0.01;
  int dim_;
  double target_;
  std::vector<double> psi0_;  ///< at n_h = first_ + k step_, never decreasing
};

}  // namespace ejecta
