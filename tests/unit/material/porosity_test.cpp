#include "material/porosity.hpp"

#include <gtest/gtest.h>

#include <random>

#include "material/distension_solver.hpp"
#include "material/material.hpp"

namespace ejecta {
namespace {

constexpr Tillotson matrix{2327, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5};
const CrushCurve quadratic = CrushCurve::quadratic(3, 1e6, 2.13e8);
const CrushCurve two_power = CrushCurve::two_power(3, 4.64, 1.90, 1e6, 6.8e7, 2.13e8, 12, 3);

double solve(const CrushCurve& curve, double rho, double e, double alpha_old) {
  return solve_distension(curve, matrix, rho, e, alpha_old, {DistensionSolver::safe_newton, 1e-13}).alpha;
}

TEST(CrushCurve, PumiceOfBulkDensity700) {
  const CrushCurve pumice = CrushCurve::two_power(3.3243, 4.64, 1.90, 1e6, 6.8e7, 2.13e8, 12, 3);
  const double points[][2] = {{1e6, 3.324}, {2e6, 3.027},   {5e6, 2.379}, {1e7, 1.814},  {2e7, 1.466},
                              {4e7, 1.312}, {6.8e7, 1.184}, {1e8, 1.087}, {1.5e8, 1.015}};
  for (const auto& [pressure, alpha] : points) EXPECT_NEAR(pumice.alpha(pressure), alpha, 6e-4) << pressure;
}

TEST(CrushCurve, EndsSlopesAndContinuity) {
  for (const CrushCurve& curve : {quadratic, two_power}) {
    EXPECT_EQ(curve.alpha(-1e9), 3);
    EXPECT_EQ(curve.alpha(1e6), 3);
    EXPECT_NEAR(curve.alpha(1e6 + 1e-3), 3, 1e-9);
    EXPECT_EQ(curve.alpha(2.13e8), 1);
    EXPECT_NEAR(curve.alpha(2.13e8 - 1), 1, 1e-9);
    EXPECT_EQ(curve.alpha(1e12), 1);
    EXPECT_EQ(curve.dalpha_dP(1e6), 0);
    EXPECT_EQ(curve.dalpha_dP(2.13e8), 0);
    double before = 3;
    for (double p = 1.1e6; p < 2.12e8; p += 0.1e6) {
      const double by_difference = (curve.alpha(p + 100) - curve.alpha(p - 100)) / 200;
      ASSERT_NEAR(curve.dalpha_dP(p), by_difference, 1e-5 * std::abs(by_difference) + 1e-14) << p;
      ASSERT_LE(curve.alpha(p), before);
      before = curve.alpha(p);
    }
  }
  EXPECT_NEAR(quadratic.dalpha_dP(1e6 + 1e-3), -2 * 2 / (2.13e8 - 1e6), 1e-15);
}

TEST(CrushCurve, MeetsAStraightLine) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const CrushCurve& curve : {quadratic, two_power})
    for (int k = 0; k < 20000; ++k) {
      // A line through a known point of the curve, given at some other of its points.
      const double p = 1e6 + uniform(random) * (2.13e8 - 1e6), slope = std::pow(10, 6 + 5 * uniform(random));
      const double alpha = 1 + 2 * uniform(random), target = curve.alpha(p);
      const double met = curve.meet(alpha, p + slope * (alpha - target), slope);
      ASSERT_NEAR(met, target, 1e-3) << p << ' ' << slope << ' ' << alpha;
    }
  EXPECT_EQ(quadratic.meet(2, 1e12, 1e3), 1);
  EXPECT_EQ(quadratic.meet(2, -1e12, 1e3), 3);
  EXPECT_NEAR(quadratic.meet(2, 5e7, 0), quadratic.alpha(5e7), 1e-12);  // pressure independent of alpha
}

struct Root {
  double rho, e, alpha_old, alpha_quadratic, pressure_quadratic, alpha_two_power, pressure_two_power;
};

TEST(SolveDistension, ReproducesReferenceRoots) {
  const Root roots[] = {{775.70545, 0, 3, 3, 4.4502225e5, 3, 4.4502225e5},
                        {2327 * 1.001 / 3, 0, 3, 2.997386023616, 1.138586e6, 2.997342636477, 1.0096133e6},
                        {2327 * 1.01 / 3, 1e3, 3, 2.970626056714, 2.5625776e6, 2.970145695691, 1.1088626e6},
                        {1000, 2e4, 3, 2.327063162499, 4.0310211e7, 2.319726928922, 4.136610e6},
                        {1500, 1e5, 3, 1.533625273984, 1.0349371e8, 1.525548890050, 1.3891155e7},
                        {2000, 1e5, 3, 1.151067872509, 1.5473511e8, 1.146850807935, 7.1560428e7},
                        {2327, 1e5, 3, 1, 4.6532834e8, 1, 4.6532834e8},
                        {2500, 1e6, 3, 1, 7.1259169e9, 1, 7.1259169e9},
                        {1163.5, 0, 2, 2, 0, 2, 0},
                        {1100, 0, 2, 2, -6.8883452e8, 2, -6.8883452e8},
                        {700, 0, 3, 3, -7.8350612e8, 3, -7.8350612e8}};
  for (const auto method : {DistensionSolver::safe_newton, DistensionSolver::bisection})
    for (const Root& r : roots) {
      const auto check = [&](const CrushCurve& curve, double alpha, double pressure) {
        const DistensionResult s = solve_distension(curve, matrix, r.rho, r.e, r.alpha_old, {method, 1e-13});
        EXPECT_TRUE(s.converged);
        EXPECT_NEAR(s.alpha, alpha, 1.1e-12) << r.rho;
        EXPECT_NEAR(bulk_pressure(s.solid, s.alpha), pressure, 6e-8 * std::abs(pressure) + 0.02) << r.rho;
      };
      check(quadratic, r.alpha_quadratic, r.pressure_quadratic);
      check(two_power, r.alpha_two_power, r.pressure_two_power);
    }
}

/// Compress, unload into tension, reload, compress on: alpha only falls, is constant to the last bit below the curve,
/// and meets the curve again where it left it.
TEST(SolveDistension, IsIrreversible) {
  for (const CrushCurve& curve : {quadratic, two_power})
    for (const auto method : {DistensionSolver::safe_newton, DistensionSolver::bisection}) {
      double alpha = 3, left_at = 0;
      const auto go = [&](double from, double to, auto&& check) {
        for (int k = 0; k <= 400; ++k) {
          const double rho = from + (to - from) * k / 400;
          const DistensionResult s = solve_distension(curve, matrix, rho, 1e4, alpha, {method, 1e-12});
          ASSERT_LE(s.alpha, alpha);
          ASSERT_GE(s.alpha, 1);
          alpha = s.alpha;
          check(rho, bulk_pressure(s.solid, s.alpha));
        }
      };
      go(700, 1200, [&](double, double p) {
        ASSERT_NEAR(alpha, curve.alpha(p), 1e-6);
        left_at = p;
      });
      const double crushed = alpha;
      EXPECT_LT(crushed, 2.5);
      go(1200, 900, [&](double, double) { ASSERT_EQ(alpha, crushed); });
      go(900, 1200, [&](double, double p) {
        ASSERT_NEAR(alpha, crushed, 1e-12);
        ASSERT_LE(p, left_at * (1 + 1e-9));
      });
      go(1200, 2600, [&](double, double p) { ASSERT_NEAR(alpha, curve.alpha(p), 1e-6); });
      EXPECT_EQ(alpha <= 1 + 1e-12, true);
    }
}

TEST(DistensionRate, IsTheDerivativeOfTheSolution) {
  for (const CrushCurve& curve : {quadratic, two_power})
    for (double rho = 800; rho < 2100; rho += 50) {
      const double e = 2e4, alpha = solve(curve, rho, e, 3), h = 1e-4;
      const EosPoint solid = matrix.evaluate(alpha * rho, e);
      const double density_rate = 2, energy_rate = 300;
      const double by_difference = (solve(curve, rho + h * density_rate, e + h * energy_rate, 3) -
                                    solve(curve, rho - h * density_rate, e - h * energy_rate, 3)) /
                                   (2 * h);
      const double rate = distension_rate(curve, solid, rho, alpha, density_rate, energy_rate);
      EXPECT_NEAR(rate, by_difference, 1e-4 * std::abs(by_difference)) << rho;
      EXPECT_EQ(distension_rate(curve, solid, rho, alpha, -density_rate, -energy_rate), 0);  // no rebound

      const double pressure = bulk_pressure(solid, alpha), de = h * pressure / (rho * rho);
      const double along_adiabat = (solve(curve, rho + h, e + de, 3) - solve(curve, rho - h, e - de, 3)) / (2 * h);
      EXPECT_NEAR(stress_factor(curve, solid, rho, alpha), std::max(0.0, 1 + along_adiabat * rho / alpha), 1e-4) << rho;

      // Below the curve, i.e. after unloading, nothing is crushed and the solid sees all of the strain.
      const EosPoint unloaded = matrix.evaluate(0.99 * alpha * rho, e);
      EXPECT_EQ(distension_rate(curve, unloaded, 0.99 * rho, alpha, density_rate, energy_rate), 0);
      EXPECT_EQ(stress_factor(curve, unloaded, 0.99 * rho, alpha), 1);
    }
}

TEST(DistensionRate, StaysBoundedWhereTheDenominatorVanishes) {
  // A made-up solid whose pressure falls steeply with density: the unguarded denominator is negative.
  const EosPoint unstable{2 * 5e7, -1e8, 1000};
  const double rate = distension_rate(quadratic, unstable, 1000, quadratic.alpha(5e7), -1, 0);
  EXPECT_TRUE(std::isfinite(rate));
  EXPECT_LE(rate, 0);
  const double f = stress_factor(quadratic, unstable, 1000, quadratic.alpha(5e7));
  EXPECT_TRUE(f >= 0 && f <= 1);
}

/// Integrates the published rate d(D^(1/3)) = 1/3 (u + delta)^(-2/3)/[(1 + delta)^(1/3) - delta^(1/3)] du numerically.
TEST(PoreDamage, IntegratesItsRate) {
  const double alpha0 = 3, delta = 0.01;
  double crack = 0;
  const int steps = 200000;
  for (int k = 0; k < steps; ++k) {
    const double u = (k + 0.5) / steps;
    crack += std::pow(u + delta, -2.0 / 3) / 3 / (std::cbrt(1 + delta) - std::cbrt(delta)) / steps;
    if ((k + 1) % 20000 == 0) {
      const double alpha = alpha0 - (alpha0 - 1) * (k + 1) / steps;
      EXPECT_NEAR(pore_damage(alpha, alpha0), crack * crack * crack, 1e-8) << alpha;
    }
  }
  EXPECT_EQ(pore_damage(3, 3), 0);
  EXPECT_DOUBLE_EQ(pore_damage(1, 3), 1);
  EXPECT_EQ(pore_damage(1, 1), 0);
}

TEST(PorousSoundSpeed, InterpolatesUpToTheSolid) {
  const Porosity aluminium{CrushCurve::quadratic(1.275, 8e7, 7e8), 4110};
  EXPECT_DOUBLE_EQ(porous_sound_speed(aluminium, 5350, 1.275), 4110);
  EXPECT_DOUBLE_EQ(porous_sound_speed(aluminium, 5350, 1), 5350);
  EXPECT_DOUBLE_EQ(porous_sound_speed(aluminium, 5350, 1.1375), 4730);
  EXPECT_DOUBLE_EQ(porous_sound_speed(aluminium, 3000, 1.2), 3000);
  EXPECT_DOUBLE_EQ(porous_sound_speed({CrushCurve::quadratic(1.275, 8e7, 7e8)}, 5350, 1.2), 5350);
  EXPECT_DOUBLE_EQ(porous_sound_speed({CrushCurve::quadratic(1, 8e7, 7e8), 4110}, 5350, 1), 5350);
}

TEST(Material, BulkDensityAndSolidity) {
  Material gas;
  gas.eos = IdealGas{1.4, 1.2};
  EXPECT_EQ(gas.bulk_density(), 1.2);
  EXPECT_FALSE(gas.solid());
  EXPECT_EQ(melt_factor(1e9, gas.melt_energy), 1);
  Material pumice;
  pumice.eos = matrix;
  pumice.elastic = Elastic{22.7e9, 26.7e9};
  pumice.porosity = Porosity{quadratic};
  EXPECT_DOUBLE_EQ(pumice.bulk_density(), 2327.0 / 3);
  EXPECT_TRUE(pumice.solid());
}

}  // namespace
}  // namespace ejecta
