#include "schemes/half_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ejecta {
namespace {

/// Weight beyond x = u by the midpoint rule over a grid.
template <class K, int Dim>
double by_grid(double u) {
  constexpr int n = Dim == 2 ? 2000 : 200;
  const double step = 2 * K::support / n;
  const auto mid = [&](int k) { return -K::support + (k + 0.5) * step; };
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = u + (K::support - u) * (i + 0.5) / n;
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < (Dim == 2 ? 1 : n); ++k)
        sum += K::value(std::sqrt(x * x + mid(j) * mid(j) + (Dim == 2 ? 0 : mid(k) * mid(k))));
  }
  return K::template norm<Dim> * sum * (K::support - u) / n * std::pow(step, Dim - 1);
}

template <class K>
void expect_share(double tolerance) {
  for (const int dim : {2, 3}) {
    const HalfSpace share(K{}, dim);
    EXPECT_NEAR(share(0), 0.5, 1e-5) << dim << "D";
    EXPECT_EQ(share(K::support), 0) << dim << "D";
    EXPECT_EQ(share(2 * K::support), 0) << dim << "D";
    for (const double u : {0.1, 1.0 / 3, 0.77, 1.3})
      EXPECT_NEAR(share(u), dim == 2 ? (by_grid<K, 2>(u)) : (by_grid<K, 3>(u)), tolerance) << dim << "D, u = " << u;
  }
}

TEST(HalfSpace, IsTheWeightBeyondAPlane) {
  // Between the 64 nodes the share is linear.
  expect_share<WendlandC2>(2e-4);
  expect_share<WendlandC4>(2e-4);
  expect_share<CubicSpline>(2e-4);
  expect_share<QuinticSpline>(4e-4);
}

}  // namespace
}  // namespace ejecta
