/// The distension of a porous body where its equation F(alpha) = 0 is hardest: on the kinks of the crush curve, in
/// states anywhere between vacuum and vapour, and where F has several zeros. tests/unit/material holds the reference
/// roots and the states of an ordinary impact, with times and counts of evaluations.
#include <gtest/gtest.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <optional>
#include <random>

#include "material/distension_solver.hpp"
#include "material/tillotson.hpp"

namespace ejecta {
namespace {

constexpr Tillotson basalt{2327, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5};
constexpr Tillotson nylon{1185, 0.6, 2.0, 10.1e9, 33.8e9, 7e6, 2e6, 2.4e6, 10, 5};
constexpr double tolerance = 1e-12, alpha0 = 3;
const CrushCurve two_power = CrushCurve::two_power(alpha0, 4.64, 1.90, 1e6, 6.8e7, 2.13e8, 12, 3);
const CrushCurve quadratic = CrushCurve::quadratic(alpha0, 1e6, 2.13e8);

struct State {
  double rho, e, alpha_old;
};

DistensionResult solve(const CrushCurve& curve, const Tillotson& eos, const State& s, DistensionSolver method) {
  return solve_distension(curve, eos, s.rho, s.e, s.alpha_old, {method, tolerance});
}

double residual(const CrushCurve& curve, const Tillotson& eos, const State& s, double alpha) {
  return alpha - std::min(curve.alpha(eos.evaluate(alpha * s.rho, s.e).pressure / alpha), s.alpha_old);
}

/// Density at which a body of this distension has this pressure: a compressed state, so there is just one.
double density_at(double pressure, double e, double alpha) {
  double low = 0.5 * basalt.rho0 / alpha, high = 3 * basalt.rho0 / alpha;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (basalt.evaluate(alpha * middle, e).pressure / alpha < pressure ? low : high) = middle;
  }
  return high;
}

/// Half of them anywhere: 0.02 to 4 times the solid density, cold to vapour. Half with the root, the distension so far
/// or the fully crushed end of the bracket exactly on a kink: P_e, P_t, P_s, each hit to the last bit or nearly so.
State random_state(const CrushCurve& curve, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double alpha_old = 1 + (alpha0 - 1) * uniform(random), e = std::pow(10, 2 + 6 * uniform(random));
  if (uniform(random) < 0.5)
    return {basalt.rho0 / alpha_old * std::pow(10, -1.7 + 2.3 * uniform(random)), e, alpha_old};
  const double kinks[] = {curve.elastic_pressure, curve.transition_pressure, curve.solid_pressure};
  const double kink = kinks[static_cast<int>(3 * uniform(random))], cold = 1e3 * uniform(random);
  const double places[] = {1, alpha_old, curve.alpha(kink)};
  return {density_at(kink, cold, places[static_cast<int>(3 * uniform(random))]), cold, alpha_old};
}

/// Whether P grows with alpha all the way from 1 to alpha_old, at 32 places. Then F grows too: there is one zero.
bool has_one_zero(const Tillotson& eos, const State& s) {
  for (int k = 0; k <= 32; ++k) {
    const double alpha = 1 + (s.alpha_old - 1) * k / 32;
    const EosPoint solid = eos.evaluate(alpha * s.rho, s.e);
    if (s.rho * solid.dP_drho < solid.pressure / alpha) return false;
  }
  return true;
}

std::optional<double> toms748(const CrushCurve& curve, const State& s) {
  const auto f = [&](double alpha) { return residual(curve, basalt, s, alpha); };
  if (f(s.alpha_old) <= 0) return s.alpha_old;
  if (f(1) >= 0) return 1;
  std::uintmax_t limit = 300;
  const auto bracket =
      boost::math::tools::toms748_solve(f, 1.0, s.alpha_old, boost::math::tools::eps_tolerance<double>(52), limit);
  return 0.5 * (bracket.first + bracket.second);
}

/// Ordinary Newton steps jump to and fro over the kinks. The step that meets the curve itself does not, and its bracket
/// holds whatever happens: F(1) <= 0 <= F(alpha_old) for every state there is, since 1 <= curve <= alpha0. One zero is
/// found by all methods as the same number; Newton without a bracket may fail, but then says so.
void check_million(const CrushCurve& curve) {
  std::mt19937_64 random(2024);
  int unique = 0, most = 0, plain_failures = 0;
  for (int k = 0; k < 1000000; ++k) {
    const State s = random_state(curve, random);
    ASSERT_LE(residual(curve, basalt, s, 1), 0) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
    ASSERT_GE(residual(curve, basalt, s, s.alpha_old), 0) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
    const DistensionResult newton = solve(curve, basalt, s, DistensionSolver::safe_newton);
    ASSERT_TRUE(newton.converged);
    ASSERT_TRUE(newton.alpha >= 1 && newton.alpha <= s.alpha_old) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
    if (!has_one_zero(basalt, s)) continue;
    ++unique;
    most = std::max(most, newton.evaluations);
    const DistensionResult halving = solve(curve, basalt, s, DistensionSolver::bisection);
    ASSERT_NEAR(newton.alpha, halving.alpha, 2 * tolerance) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
    if (k % 10 == 0) {
      ASSERT_NEAR(newton.alpha, toms748(curve, s).value(), 2 * tolerance) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
      const DistensionResult plain = solve(curve, basalt, s, DistensionSolver::newton);
      if (plain.converged)
        ASSERT_NEAR(plain.alpha, halving.alpha, 2 * tolerance) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
      else
        ++plain_failures;
    }
  }
  std::printf(
      "[ crush curve ] one zero in %d of 1000000 states; safe Newton needs %d evaluations at most; plain Newton "
      "fails for %d of %d\n",
      unique, most, plain_failures, unique / 10);
  EXPECT_LE(most, 60);
  EXPECT_GT(unique, 500000);
  EXPECT_GT(plain_failures, 1000);
}

TEST(CrushCurveKinks, AMillionStatesOfTheQuadraticCurve) { check_million(quadratic); }
TEST(CrushCurveKinks, AMillionStatesOfTheTwoPowerCurve) { check_million(two_power); }

/// Largest zero of F in [1, alpha_old] by looking everywhere.
double largest_zero(const CrushCurve& curve, const Tillotson& eos, const State& s) {
  constexpr int samples = 1000;
  for (int k = samples - 1; k >= 0; --k)
    if (const double alpha = 1 + (s.alpha_old - 1) * k / samples; residual(curve, eos, s, alpha) <= 0) return alpha;
  return 1;
}

/// With a stiff curve (n1 = 12) hot expanded nylon has several zeros. The right one is that which history leads to:
/// heated and squeezed in small steps, the body follows the largest zero below its distension so far. It may drop to a
/// lower one only where the one it sat on ceases to exist; it never skips one that is there. Halving the whole range
/// does skip.
TEST(CrushCurveKinks, HistoryLeadsToTheLargestOfSeveralZeros) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  const CrushCurve stiff = CrushCurve::two_power(alpha0, 4.64, 1.90, 1e8, 7e8, 2e9, 12, 3);
  int several = 0, steps = 0, skipped_by_halving = 0;
  for (int path = 0; path < 60; ++path) {
    State s{nylon.rho0 / alpha0 * (0.3 + 0.7 * uniform(random)), 1e5, alpha0};
    const double heat = 2e4 * uniform(random), squeeze = 1 + 0.004 * uniform(random);
    for (int k = 0; k < 300; ++k, ++steps) {
      s.rho *= squeeze;
      s.e += heat;
      const double alpha = solve(stiff, nylon, s, DistensionSolver::safe_newton).alpha, cell = (s.alpha_old - 1) / 1000;
      several += !has_one_zero(nylon, s);
      ASSERT_GE(alpha, largest_zero(stiff, nylon, s) - 2 * tolerance) << s.rho << ' ' << s.e << ' ' << s.alpha_old;
      ASSERT_LE(alpha, largest_zero(stiff, nylon, s) + cell + 2 * tolerance) << s.rho << ' ' << s.e;
      skipped_by_halving += solve(stiff, nylon, s, DistensionSolver::bisection).alpha < alpha - cell;
      s.alpha_old = alpha;
    }
  }
  std::printf("[ several zeros ] possible in %d of %d steps; halving skips the right one in %d\n", several, steps,
              skipped_by_halving);
  EXPECT_GT(several, 1000);
  EXPECT_GT(skipped_by_halving, 0);
}

}  // namespace
}  // namespace ejecta
