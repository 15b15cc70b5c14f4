#pragma once
/// Choice of the smoothing length from the zeroth moment of the neighbours [Owen 2010, eqs 1-4].
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/cube_root.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Psi0 = (sum_j |dW/deta|(eta_j))^(1/Dim) (eq. 1) as a function of n_h, the particles per smoothing length, by exact
/// sums over the cubic lattice. The sum leaves out the particle itself and the kernel's normalisation.
class SupportSize {
 public:
  SupportSize(Kernel kernel, int dim, double nodes_per_h);

  /// Effective n_h of a particle whose sum over neighbours is `zeroth_moment`. With no neighbours: half the target.
  double effective_nodes_per_h(double zeroth_moment) const {
    if (!(zeroth_moment > 0)) return 0.5 * target_;
    const double psi0 = dim_ == 2 ? std::sqrt(zeroth_moment) : cube_root(zeroth_moment);
    const double place = psi0 * per_psi0_;
    const auto k = static_cast<std::size_t>(place);
    if (k + 1 >= nodes_.size()) return nodes_.back() * place / static_cast<double>(nodes_.size() - 1);
    return nodes_[k] + (place - static_cast<double>(k)) * (nodes_[k + 1] - nodes_[k]);
  }

  /// Factor to apply to h so that n_h moves to its target: 1 - a + a s with s = target/effective in [1/4, 4], and
  /// a = 0.4 (1 + s^2) for s < 1, 0.4 (1 + s^-3) otherwise (eqs 2-3).
  double growth(double zeroth_moment) const {
    const double s = std::clamp(target_ / effective_nodes_per_h(zeroth_moment), 0.25, 4.0);
    const double a = s < 1 ? 0.4 * (1 + s * s) : 0.4 * (1 + 1 / (s * s * s));
    return 1 - a + a * s;
  }

  /// Psi0 on the table at n_h.
  double psi0(double nodes_per_h) const;

 private:
  static constexpr double first_ = 0.25, last_ = 8, step_ = 0.01;
  int dim_;
  double target_;
  std::vector<double> psi0_;   ///< at n_h = first_ + k step_, never decreasing
  std::vector<double> nodes_;  ///< the inverse: n_h at psi0 = k / per_psi0_, for a look-up without a search
  double per_psi0_;
};

}  // namespace ejecta
