#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "schemes/kernels.hpp"

namespace ejecta {

/// Share of a kernel's weight that lies beyond a plane at a distance of u smoothing lengths: 1/2 at u = 0, 0 from the
/// support on. A particle half a spacing below the surface of its body sees this much of whatever touches it there.
class HalfSpace {
 public:
  template <class K>
  HalfSpace(K, int dim) : per_u_(intervals / K::support) {
    for (int k = 0; k <= intervals; ++k) {
      // With the distance q = u + (support - u) t^2 from the particle the sum has no singular end; by Simpson's rule.
      constexpr int parts = 64;
      const double u = k / per_u_, width = K::support - u;
      double sum = 0;
      for (int n = 0; n <= parts; ++n) {
        const double t = static_cast<double>(n) / parts, q = u + width * t * t;
        const double shell =
            dim == 2 ? 2 * q * std::acos(q > 0 ? std::min(1.0, u / q) : 1.0) : 2 * std::numbers::pi * q * (q - u);
        const double weight = n == 0 || n == parts ? 1 : n % 2 == 1 ? 4 : 2;
        sum += weight * K::value(q) * shell * 2 * t * width;
      }
      const double norm = dim == 2 ? K::template norm<2> : K::template norm<3>;
      share_[static_cast<std::size_t>(k)] = norm * sum / (3 * parts);
    }
  }
  double operator()(double u) const {
    const double place = std::min(u * per_u_, static_cast<double>(intervals));
    const auto k = std::min<std::size_t>(static_cast<std::size_t>(place), intervals - 1);
    return share_[k] + (place - static_cast<double>(k)) * (share_[k + 1] - share_[k]);
  }

 private:
  static constexpr int intervals = 64;
  double per_u_;
  std::array<double, intervals + 1> share_;
};

}  // namespace ejecta
