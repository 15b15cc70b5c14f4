#include "schemes/support_size.hpp"

#include <algorithm>
#include <cmath>

#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

/// sum over the cubic lattice of spacing 1/n_h in eta, self excluded, of |dW/deta|.
template <class K>
double lattice_sum(int dim, double nodes_per_h) {
  const int reach = static_cast<int>(K::support * nodes_per_h);
  // Lattice points come in shells of equal squared distance; only the positive octant is walked.
  double sum = 0;
  for (int i = 0; i <= reach; ++i)
    for (int j = 0; j <= reach; ++j)
      for (int k = 0; k <= (dim == 3 ? reach : 0); ++k) {
        if (i + j + k == 0) continue;
        const double eta = std::sqrt(static_cast<double>(i * i + j * j + k * k)) / nodes_per_h;
        if (eta >= K::support) continue;
        const int copies = (i > 0 ? 2 : 1) * (j > 0 ? 2 : 1) * (k > 0 ? 2 : 1);
        sum -= copies * eta * K::slope_over_q(eta, 1 / eta);
      }
  return sum;
}

}  // namespace

SupportSize::SupportSize(Kernel kernel, int dim, double nodes_per_h) : dim_(dim), target_(nodes_per_h) {
  with_kernel(kernel, [&](auto k) {
    for (double n = first_; n <= last_ + 0.5 * step_; n += step_)
      psi0_.push_back(std::pow(lattice_sum<decltype(k)>(dim_, n), 1.0 / dim_));
  });
  for (std::size_t k = 1; k < psi0_.size(); ++k) psi0_[k] = std::max(psi0_[k], psi0_[k - 1]);
  constexpr std::size_t entries = 16384;
  per_psi0_ = entries / psi0_.back();
  for (std::size_t k = 0; k <= entries; ++k) {
    const double psi0 = static_cast<double>(k) / per_psi0_;
    const auto above = std::upper_bound(psi0_.begin(), psi0_.end(), psi0);
    if (above == psi0_.begin()) {
      nodes_.push_back(first_);
    } else if (above == psi0_.end()) {
      nodes_.push_back(last_);
    } else {
      const auto below = static_cast<double>(above - psi0_.begin() - 1);
      nodes_.push_back(first_ + step_ * (below + (psi0 - above[-1]) / (above[0] - above[-1])));
    }
  }
}

double SupportSize::psi0(double nodes_per_h) const {
  const double place = std::clamp((nodes_per_h - first_) / step_, 0.0, static_cast<double>(psi0_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(place), psi0_.size() - 2);
  return psi0_[k] + (place - static_cast<double>(k)) * (psi0_[k + 1] - psi0_[k]);
}

}  // namespace ejecta
