#pragma once
/// Kernels by table, for sums over pixels.
#include <cstddef>
#include <vector>

namespace ejecta {

/// A function of s = q^2 on [0, support^2], tabulated so finely that linear interpolation is good to about 1e-6.
class SquareTable {
 public:
  template <class F>
  SquareTable(double support, F&& of_square) : scale_(intervals / (support * support)), values_(intervals + 2, 0.0) {
    for (int k = 0; k < intervals; ++k) values_[static_cast<std::size_t>(k)] = of_square(k / scale_);
  }
  double operator()(double s) const {
    const double place = s * scale_;
    const std::size_t k = static_cast<std::size_t>(place);
    return values_[k] + (place - static_cast<double>(k)) * (values_[k + 1] - values_[k]);
  }

 private:
  static constexpr int intervals = 8192;
  double scale_;
  std::vector<double> values_;
};

}  // namespace ejecta
