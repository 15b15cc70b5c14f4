#include <gtest/gtest.h>

#include <random>

#include "material/strength.hpp"

namespace ejecta {
namespace {

constexpr SteinbergGuinan steel_304{.yield_stress = 0.34e9,
                                    .yield_limit = 2.5e9,
                                    .hardening = 43,
                                    .hardening_exponent = 0.35,
                                    .stiffening = 0.0226e-9,
                                    .softening = 4.55e-4};
constexpr SteinbergGuinan copper{
    .yield_stress = 0.12e9, .yield_limit = 0.64e9, .hardening = 36, .hardening_exponent = 0.45};
constexpr JohnsonCook steel_4340{792e6, 510e6, 0.26, 0.014, 1.03, 1};

/// Numbers worked out by another program from the published formulas.
TEST(SteinbergGuinan, ReproducesReferenceValues) {
  const double factor = steel_304.shear_factor(20e9, 1.1, {400, 2500});
  EXPECT_NEAR(factor, 1.2556264566570863, 1e-14);
  EXPECT_NEAR(steel_304.yield({.plastic_strain = 0.2, .shear_factor = factor}), 942180923.000212, 1e-4);
  EXPECT_NEAR(copper.yield({.plastic_strain = 0.1}), 238463695.67619312, 1e-5);
  EXPECT_NEAR(copper.yield({.plastic_strain = 0.5}), 451461132.28635573, 1e-5);
  EXPECT_EQ(copper.yield({.plastic_strain = 5}), 0.64e9);
  EXPECT_EQ(copper.yield({}), 0.12e9);
  SteinbergGuinan worked = copper;
  worked.initial_strain = 0.1;
  EXPECT_EQ(worked.yield({}), copper.yield({.plastic_strain = 0.1}));
  EXPECT_EQ(steel_304.intact_fraction(0.25), 0.75);
}

TEST(SteinbergGuinan, MeltsAndNeverStiffensBelowNothing) {
  EXPECT_EQ(steel_304.shear_factor(0, 1, {}), 1);
  EXPECT_EQ(steel_304.shear_factor(50e9, 1.2, {2080, 2080}), 0);
  EXPECT_EQ(steel_304.shear_factor(50e9, 1.2, {1e9, 2080}), 0);
  EXPECT_EQ(steel_304.shear_factor(-80e9, 0.6, {}), 0.01);
  EXPECT_NEAR(steel_304.shear_factor(0, 1, {1900, 2080}), (1 - 4.55e-4 * 1900) * std::exp(-1.9 / 180), 1e-14);
  EXPECT_GT(steel_304.shear_factor(0, 1, {-200, 2080}), 1) << "colder than at rest: stiffer";
}

TEST(JohnsonCook, ReproducesReferenceValues) {
  EXPECT_NEAR(steel_4340.yield({.plastic_strain = 0.1, .strain_rate = 5e3, .warmth = {300, 1493}}), 970308110.8763659,
              1e-5);
  EXPECT_EQ(steel_4340.yield({}), 792e6);
  EXPECT_EQ(steel_4340.yield({.strain_rate = 0.5}), 792e6) << "the logarithm never weakens";
  EXPECT_EQ(steel_4340.yield({.warmth = {-100, 1493}}), 792e6);
  EXPECT_EQ(steel_4340.yield({.plastic_strain = 1, .strain_rate = 1e6, .warmth = {1493, 1493}}), 0);
  EXPECT_EQ(steel_4340.yield({.warmth = {2000, 1493}}), 0);
}

TEST(MetalStrength, SlopesAgreeWithDifferences) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0.01, 1);
  const auto check = [&](const auto& model) {
    for (int k = 0; k < 10000; ++k) {
      const StrengthState s{.plastic_strain = uniform(random),
                            .strain_rate = 1e6 * uniform(random),
                            .shear_factor = uniform(random),
                            .warmth = {1000 * uniform(random), 1500}};
      StrengthState more = s, less = s, faster = s, slower = s;
      more.plastic_strain *= 1 + 1e-6, less.plastic_strain *= 1 - 1e-6;
      faster.strain_rate *= 1 + 1e-5, slower.strain_rate *= 1 - 1e-5;
      const YieldPoint p = model.evaluate(s);
      ASSERT_NEAR(p.by_strain * s.plastic_strain, (model.yield(more) - model.yield(less)) / 2e-6, 1e-6 * p.stress);
      ASSERT_NEAR(p.by_rate * s.strain_rate, (model.yield(faster) - model.yield(slower)) / 2e-5, 1e-6 * p.stress);
    }
  };
  check(SteinbergGuinan{.yield_stress = 1e8, .yield_limit = 1e12, .hardening = 43, .hardening_exponent = 0.35});
  check(steel_4340);
}

/// Roots found by another program (Brent's method to round-off).
TEST(Flow, ReproducesReferenceRoots) {
  const StrengthState warm{.plastic_strain = 0.05, .warmth = {100, 1493}};
  EXPECT_NEAR(flow(steel_4340, warm, 2e9, 80e9, 1e-7).plastic_strain, 0.003711591604472386, 1e-13);
  EXPECT_NEAR(flow(copper, {.plastic_strain = 0.01}, 0.5e9, 47.7e9, 1e-7).plastic_strain, 0.002502837982645326, 1e-13);
}

/// Whatever the state: what is left lies on the surface the flow has moved, in few evaluations; no flow inside.
TEST(Flow, EndsOnTheHardenedSurface) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  int most = 0;
  const auto check = [&](const auto& model, const StrengthState& start, double trial, double shear, double dt) {
    const PlasticFlow f = flow(model, start, trial, shear, dt);
    most = std::max(most, f.evaluations);
    StrengthState end = start;
    end.plastic_strain += f.plastic_strain;
    end.strain_rate = dt > 0 ? f.plastic_strain / dt : 0;
    ASSERT_NEAR(f.yield, model.yield(end), 1e-14 * f.yield);
    if (trial <= model.yield(start)) {
      ASSERT_EQ(f.plastic_strain, 0);
    } else {
      ASSERT_GT(f.plastic_strain, 0);
      ASSERT_NEAR(trial - 3 * shear * f.plastic_strain, f.yield, 1e-10 * f.yield);
    }
  };
  for (int k = 0; k < 200000; ++k) {
    const StrengthState start{.plastic_strain = k % 3 ? std::pow(10, -8 + 9 * uniform(random)) : 0,
                              .shear_factor = 0.5 + uniform(random),
                              .warmth = {1600 * uniform(random) - 200, 1493}};
    const double trial = std::pow(10, 7 + 3.5 * uniform(random));
    const double dt = k % 5 ? std::pow(10, -12 + 8 * uniform(random)) : 0;
    check(steel_304, start, trial, 77e9 * start.shear_factor, dt);
    check(copper, start, trial, 47.7e9 * start.shear_factor, dt);
    if (start.warmth.rise < start.warmth.melting) check(steel_4340, start, trial, 80e9, dt);
  }
  EXPECT_LE(most, 20);
}

/// Without a rate in the law the step does not matter, and many small steps add up to a large one.
TEST(Flow, IsIndependentOfTheRateWhereTheLawIs) {
  JohnsonCook slow = steel_4340;
  slow.rate_factor = 0;
  const StrengthState start{.plastic_strain = 0.01};
  const double once = flow(slow, start, 3e9, 80e9, 1e-9).plastic_strain;
  EXPECT_EQ(flow(slow, start, 3e9, 80e9, 1e-3).plastic_strain, once);
  EXPECT_EQ(flow(steel_4340, start, 3e9, 80e9, 1e9).plastic_strain, once) << "slower than the reference rate";
  EXPECT_LT(flow(steel_4340, start, 3e9, 80e9, 1e-9).plastic_strain, once - 1e-4);
  StrengthState state = start;
  double stress = 0;
  for (int k = 0; k < 1000; ++k) {
    stress += 3e6;
    const PlasticFlow f = flow(slow, state, stress, 80e9, 1e-9);
    state.plastic_strain += f.plastic_strain;
    stress = std::min(stress, f.yield);
  }
  EXPECT_NEAR(state.plastic_strain, 0.01 + once, 1e-12);
}

/// The deviator on the surface, and the work it does on the plastic strain tensor: Y d(eps_p).
TEST(RadialReturn, WithHardeningEndsOnTheSurfaceAndDoesItsWork) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0, 2e9);
  for (int k = 0; k < 10000; ++k) {
    Deviator<3> trial;
    for (double& component : trial) component = normal(random);
    StrengthState state{.plastic_strain = 0.02};
    const double dt = 1e-7;
    const RadialReturn r = radial_return<3>(trial, steel_4340, state, 80e9, dt);
    const Mat<3> s = full_tensor<3>(Deviator<3>(r.scale * trial)), plastic = (full_tensor<3>(trial) - s) / 160e9;
    if (r.scale == 1) continue;
    state.plastic_strain += r.plastic_strain;
    state.strain_rate = r.plastic_strain / dt;
    const double q = std::sqrt(1.5) * s.norm();
    ASSERT_NEAR(q, steel_4340.yield(state), 1e-10 * q);
    ASSERT_NEAR(std::sqrt(2.0 / 3) * plastic.norm(), r.plastic_strain, 1e-10 * r.plastic_strain);
    ASSERT_NEAR(s.cwiseProduct(plastic).sum(), q * r.plastic_strain, 1e-10 * q * r.plastic_strain);
  }
  const Deviator<3> some = Deviator<3>::Constant(1e6);
  const RadialReturn molten = radial_return<3>(some, steel_304, {.shear_factor = 0}, 0, 1e-7);
  EXPECT_EQ(molten.scale, 0);
  EXPECT_EQ(molten.plastic_strain, 0);
}

}  // namespace
}  // namespace ejecta
