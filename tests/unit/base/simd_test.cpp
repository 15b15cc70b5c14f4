#include "base/simd.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace ejecta {
namespace {

using simd::Double8;
using simd::Float16;

/// Positive numbers spread evenly over decades.
template <class V, class T>
V log_uniform(std::mt19937_64& random, double lowest_power, double highest_power) {
  std::uniform_real_distribution<double> power(lowest_power, highest_power);
  V v{};
  for (int k = 0; k < simd::lanes<T>; ++k) v[k] = static_cast<T>(std::pow(10, power(random)));
  return v;
}

/// Largest relative error of f(V) against exact(double) over many random arguments, in units of the precision of T.
template <class V, class T, class F, class G>
double worst_error(double lowest_power, double highest_power, F&& f, G&& exact) {
  std::mt19937_64 random(11);
  double worst = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const V a = log_uniform<V, T>(random, lowest_power, highest_power), y = f(a);
    for (int k = 0; k < simd::lanes<T>; ++k) {
      const double truth = exact(static_cast<double>(a[k]));
      worst = std::max(worst, std::abs(static_cast<double>(y[k]) - truth) / truth);
    }
  }
  return worst / static_cast<double>(std::numeric_limits<T>::epsilon());
}

constexpr double few_units = 3;  // in the last place
double inverse(double a) { return 1 / a; }
double inverse_root(double a) { return 1 / std::sqrt(a); }

TEST(Simd, ReciprocalIsGoodToAFewUnitsInTheLastPlace) {
  EXPECT_LT((worst_error<Double8, double>(
                -100, 100, [](Double8 a) { return simd::reciprocal(a); }, inverse)),
            few_units);
  EXPECT_LT((worst_error<Float16, float>(
                -30, 30, [](Float16 a) { return simd::reciprocal(a); }, inverse)),
            few_units);
}

TEST(Simd, ReciprocalRootIsGoodToAFewUnitsInTheLastPlace) {
  // The pair loop hands in squared distances with a guard of 1e-200 (1e-30 in single precision).
  EXPECT_LT((worst_error<Double8, double>(
                -200, 200, [](Double8 a) { return simd::reciprocal_sqrt(a); }, inverse_root)),
            few_units);
  EXPECT_LT((worst_error<Float16, float>(
                -30, 30, [](Float16 a) { return simd::reciprocal_sqrt(a); }, inverse_root)),
            few_units);
}

TEST(Simd, MinAndMaxWorkLaneByLane) {
  const Double8 a{1, -2, 3, -4, 5, -6, 7, -8}, b = -a;
  const Float16 x{1, -2, 3, -4, 5, -6, 7, -8, 9, -10, 11, -12, 13, -14, 15, -16}, y = -x;
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(simd::max(a, b)[k], k + 1);
    EXPECT_EQ(simd::min(a, b)[k], -k - 1);
  }
  for (int k = 0; k < 16; ++k) {
    EXPECT_EQ(simd::max(x, y)[k], k + 1);
    EXPECT_EQ(simd::min(x, y)[k], -k - 1);
  }
}

TEST(Simd, AnyLessSeesEveryLane) {
  const Double8 zero{};
  EXPECT_FALSE(simd::any_less(zero, zero));
  for (int k = 0; k < 8; ++k) {
    Double8 a = zero;
    a[k] = -1;
    EXPECT_TRUE(simd::any_less(a, zero)) << k;
    EXPECT_FALSE(simd::any_less(zero, a)) << k;
    a[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(simd::any_less(a, zero)) << k;
  }
}

TEST(Simd, WideSumAddsInDoublePrecision) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  simd::WideSum<float> sum;
  simd::WideSum<double> sum_of_doubles;
  double expected[16] = {};
  for (int n = 0; n < 1000; ++n) {
    Float16 value{};
    Double8 first{};
    const float weight = uniform(random);
    for (int k = 0; k < 16; ++k) {
      value[k] = uniform(random);
      if (k < 8) first[k] = static_cast<double>(value[k]);
      expected[k] += static_cast<double>(weight) * static_cast<double>(value[k]);
    }
    sum.add(static_cast<double>(weight), value);
    sum_of_doubles.add(static_cast<double>(weight), first);
  }
  for (int k = 0; k < 16; ++k) EXPECT_NEAR(sum.lane(k), expected[k], 1e-13) << k;
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(sum_of_doubles.lane(k), expected[k], 1e-13) << k;
}

TEST(Simd, RoundedProductsMakeSumsCommute) {
  // Without it the compiler may fuse one of the two products into the sum, and a different one in each expression.
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    const auto next = [&] { return log_uniform<Double8, double>(random, -2, 2); };
    const Double8 a = next(), b = next(), c = next(), d = next();
    const Double8 one = simd::rounded(Double8(a * b)) + simd::rounded(Double8(c * d));
    const Double8 other = simd::rounded(Double8(c * d)) + simd::rounded(Double8(a * b));
    for (int k = 0; k < 8; ++k) ASSERT_EQ(one[k], other[k]);
  }
}

}  // namespace
}  // namespace ejecta
