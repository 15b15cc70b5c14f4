#pragma once
#include <cmath>
#include <random>

namespace ejecta {

/// A random number between the two, uniform in its logarithm.
class LogUniform {
 public:
  double operator()(double low, double high) { return low * std::pow(high / low, uniform_(random_)); }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

}  // namespace ejecta
