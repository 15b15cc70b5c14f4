#include "base/simd.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace ejecta {
namespace {

using simd::Doubles;
using simd::Floats;

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
  EXPECT_LT((worst_error<Doubles, double>(
                -100, 100, [](Doubles a) { return simd::reciprocal(a); }, inverse)),
            few_units);
  EXPECT_LT((worst_error<Floats, float>(
                -30, 30, [](Floats a) { return simd::reciprocal(a); }, inverse)),
            few_units);
}

TEST(Simd, ReciprocalRootIsGoodToAFewUnitsInTheLastPlace) {
  // The pair loop hands in squared distances with a guard of 1e-200 (1e-30 in single precision).
  EXPECT_LT((worst_error<Doubles, double>(
                -200, 200, [](Doubles a) { return simd::reciprocal_sqrt(a); }, inverse_root)),
            few_units);
  EXPECT_LT((worst_error<Floats, float>(
                -30, 30, [](Floats a) { return simd::reciprocal_sqrt(a); }, inverse_root)),
            few_units);
}

TEST(Simd, RootIsGoodToAFewUnitsInTheLastPlace) {
  const auto root = [](double a) { return std::sqrt(a); };
  EXPECT_LT((worst_error<Doubles, double>(
                -200, 200, [](Doubles a) { return simd::square_root(a); }, root)),
            few_units);
  EXPECT_LT((worst_error<Floats, float>(
                -30, 30, [](Floats a) { return simd::square_root(a); }, root)),
            few_units);
  EXPECT_EQ(simd::square_root(Doubles{})[0], 0);
  EXPECT_EQ(simd::square_root(Floats{})[0], 0);
}

template <class V, int lanes>
void expect_min_and_max() {
  V a{};
  for (int k = 0; k < lanes; ++k) a[k] = k % 2 ? -k - 1 : k + 1;
  const V b = -a;
  for (int k = 0; k < lanes; ++k) {
    EXPECT_EQ(simd::max(a, b)[k], k + 1);
    EXPECT_EQ(simd::min(a, b)[k], -k - 1);
    EXPECT_EQ(simd::magnitude(a)[k], k + 1);
    EXPECT_EQ(simd::fused(a, b, V{} + 1)[k], 1 - (k + 1) * (k + 1));
  }
}

TEST(Simd, OperationsWorkLaneByLane) {
  expect_min_and_max<Doubles, simd::lanes<double>>();
  expect_min_and_max<Floats, simd::lanes<float>>();
}

TEST(Simd, ANumberFillsAllLanesAndKeepsItsSign) {
  for (const double value : {3.5, 0.0, -0.0}) {
    const Doubles all = simd::all<Doubles>(value);
    for (int k = 0; k < simd::lanes<double>; ++k) {
      EXPECT_EQ(all[k], value);
      EXPECT_EQ(std::signbit(all[k]), std::signbit(value));
    }
  }
}

TEST(Simd, AnyLessSeesEveryLane) {
  const Doubles zero{};
  EXPECT_FALSE(simd::any_less(zero, zero));
  for (int k = 0; k < simd::lanes<double>; ++k) {
    Doubles a = zero;
    a[k] = -1;
    EXPECT_TRUE(simd::any_less(a, zero)) << k;
    EXPECT_FALSE(simd::any_less(zero, a)) << k;
    a[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(simd::any_less(a, zero)) << k;
    a[k] = -1;
    EXPECT_EQ(simd::lanes_less(a, zero), 1u << k);
  }
}

TEST(Simd, WideSumAddsInDoublePrecision) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  simd::WideSum<float> sum;
  simd::WideSum<double> sum_of_doubles;
  double expected[simd::lanes<float>] = {};
  for (int n = 0; n < 1000; ++n) {
    Floats value{};
    Doubles first{};
    const float weight = uniform(random);
    for (int k = 0; k < simd::lanes<float>; ++k) {
      value[k] = uniform(random);
      if (k < simd::lanes<double>) first[k] = static_cast<double>(value[k]);
      expected[k] += static_cast<double>(weight) * static_cast<double>(value[k]);
    }
    sum.add(static_cast<double>(weight), value);
    sum_of_doubles.add(static_cast<double>(weight), first);
  }
  for (int k = 0; k < simd::lanes<float>; ++k) EXPECT_NEAR(sum.lane(k), expected[k], 1e-13) << k;
  for (int k = 0; k < simd::lanes<double>; ++k) EXPECT_NEAR(sum_of_doubles.lane(k), expected[k], 1e-13) << k;
}

TEST(Simd, RoundedProductsMakeSumsCommute) {
  // Without it the compiler may fuse one of the two products into the sum, and a different one in each expression.
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    const auto next = [&] { return log_uniform<Doubles, double>(random, -2, 2); };
    const Doubles a = next(), b = next(), c = next(), d = next();
    const Doubles one = simd::rounded(Doubles(a * b)) + simd::rounded(Doubles(c * d));
    const Doubles other = simd::rounded(Doubles(c * d)) + simd::rounded(Doubles(a * b));
    for (int k = 0; k < simd::lanes<double>; ++k) ASSERT_EQ(one[k], other[k]);
  }
}

}  // namespace
}  // namespace ejecta
