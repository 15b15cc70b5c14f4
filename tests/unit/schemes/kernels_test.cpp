#include "schemes/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ejecta {
namespace {

template <class K>
class KernelTest : public testing::Test {};
using Kernels = testing::Types<CubicSpline, QuinticSpline, WendlandC2, WendlandC4, Gaussian>;
TYPED_TEST_SUITE(KernelTest, Kernels);

/// Composite Simpson rule between the integer knots of the splines.
template <class F>
double integral(double end, F&& f) {
  constexpr int intervals = 2000;  // per unit of q
  const int n = static_cast<int>(end) * intervals;
  const double step = end / n;
  double sum = f(0.0) + f(std::nextafter(end, 0));  // a Gaussian is cut off
  for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(k * step);
  return sum * step / 3;
}

template <class K>
double slope(double q) {
  return q * K::slope_over_q(q, 1 / q);
}

TYPED_TEST(KernelTest, IsNormalised) {
  using K = TypeParam;
  const double pi = std::numbers::pi;
  const double area = integral(K::support, [&](double q) { return 2 * pi * q * K::value(q); });
  const double volume = integral(K::support, [&](double q) { return 4 * pi * q * q * K::value(q); });
  EXPECT_NEAR(K::template norm<2> * area, 1, 1e-11);
  EXPECT_NEAR(K::template norm<3> * volume, 1, 1e-11);
}

TYPED_TEST(KernelTest, SlopeIsTheDerivativeOfTheValue) {
  using K = TypeParam;
  for (double q = 0.0137; q < K::support; q += 0.0311) {
    constexpr double step = 1e-4;
    const double difference =
        (-K::value(q + 2 * step) + 8 * K::value(q + step) - 8 * K::value(q - step) + K::value(q - 2 * step)) /
        (12 * step);
    EXPECT_NEAR(slope<K>(q), difference, 1e-9 * K::value(0.0)) << "q = " << q;
    EXPECT_LT(slope<K>(q), 0) << "q = " << q;
  }
}

TYPED_TEST(KernelTest, IsExactlyZeroAtAndBeyondTheSupport) {
  using K = TypeParam;
  for (const double q : {K::support, K::support * (1 + 1e-15), 1.5 * K::support, 1e10}) {
    EXPECT_EQ(K::value(q), 0) << "q = " << q;
    EXPECT_EQ(slope<K>(q), 0) << "q = " << q;
  }
  EXPECT_GT(K::value(0.999 * K::support), 0);
}

TYPED_TEST(KernelTest, LanesAgreeWithNumbers) {
  using K = TypeParam;
  for (double q0 = 0; q0 < 1.2 * K::support; q0 += 0.1) {
    simd::Doubles q{};
    simd::Floats qf{};
    for (int k = 0; k < simd::lanes<double>; ++k) q[k] = q0 + 0.0125 * (k + 0.5);
    for (int k = 0; k < simd::lanes<float>; ++k) qf[k] = static_cast<float>(q0 + 0.00625 * (k + 0.5));
    const simd::Doubles value = K::value(q), rate = K::slope_over_q(q, 1.0 / q);
    const simd::Floats value_f = K::value(qf), rate_f = K::slope_over_q(qf, 1.0f / qf);
    const double scale = K::value(0.0);
    // A Gaussian is squared five times, and its rounding with it.
    const double single = (std::is_same_v<K, Gaussian> ? 2 : 1) * scale;
    for (int k = 0; k < simd::lanes<double>; ++k) {
      EXPECT_NEAR(value[k], K::value(q[k]), 1e-15 * scale);
      EXPECT_NEAR(rate[k], K::slope_over_q(q[k], 1 / q[k]), 1e-14 * scale / q[k]);
    }
    for (int k = 0; k < simd::lanes<float>; ++k) {
      const double exact_q = static_cast<double>(qf[k]);
      EXPECT_NEAR(value_f[k], K::value(exact_q), 2e-6 * single);
      EXPECT_NEAR(rate_f[k], K::slope_over_q(exact_q, 1 / exact_q), 5e-6 * single / exact_q);
    }
  }
}

/// exp(-q^2) to 3e-14 of itself, and its moments cut off at q = 3: of the whole plane and space they would be 1 and
/// 3/2.
TEST(Kernel, TheGaussianIsOne) {
  for (double q = 0; q < 3; q += 0.01)
    ASSERT_NEAR(Gaussian::value(q), std::exp(-q * q), 4e-14 * std::exp(-q * q)) << "q = " << q;
  const double pi = std::numbers::pi, e9 = std::exp(-9), erf3 = std::erf(3);
  const double in_plane = integral(3, [&](double q) { return 2 * pi * q * q * q * Gaussian::value(q); });
  const double in_space = integral(3, [&](double q) { return 4 * pi * q * q * q * q * Gaussian::value(q); });
  EXPECT_NEAR(Gaussian::norm<2> * in_plane, (1 - 10 * e9) / (1 - e9), 1e-11);
  EXPECT_NEAR(Gaussian::norm<3> * in_space, (1.5 * std::sqrt(pi) * erf3 - 63 * e9) / (std::sqrt(pi) * erf3 - 6 * e9),
              1e-11);
  EXPECT_NEAR(Gaussian::norm<2>, 1 / pi, 2e-4 / pi);
}

TEST(Kernel, NamesLeadToTheRightStruct) {
  EXPECT_EQ(with_kernel(Kernel::cubic_spline, [](auto k) { return decltype(k)::value(0.0); }), 1);
  EXPECT_EQ(with_kernel(Kernel::quintic_spline, [](auto k) { return decltype(k)::value(0.0); }), 66);
  EXPECT_EQ(with_kernel(Kernel::wendland_c2, [](auto k) { return decltype(k)::value(1.0); }), 3.0 / 16);
  EXPECT_DOUBLE_EQ(with_kernel(Kernel::wendland_c4, [](auto k) { return decltype(k)::value(1.0); }), 83.0 / 768);
  EXPECT_NEAR(with_kernel(Kernel::gaussian, [](auto k) { return decltype(k)::value(1.0); }), std::exp(-1), 1e-14);
  EXPECT_EQ(kernel_support(Kernel::quintic_spline), 3);
  EXPECT_EQ(kernel_support(Kernel::gaussian), 3);
  EXPECT_EQ(kernel_support(Kernel::wendland_c2), 2);
}

}  // namespace
}  // namespace ejecta
