#include "schemes/riemann_star.hpp"

#include <gtest/gtest.h>

#include "material/exact_riemann.hpp"
#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

constexpr double gamma_of_air = 1.4;
using Lanes = simd::Doubles;

struct Problem {
  const char* name;
  GasState left, right;
  /// Relative errors of p*, and of u* in units of the faster of both sounds, of the approximate solution.
  double pressure_error, velocity_error;
};

/// The five of Toro (2009, table 4.1), and two halves of Noh's problem.
const std::vector<Problem> problems{
    {"Sod, moving", {1, 0.75, 1}, {0.125, 0, 0.1}, 0.001, 0.002},
    {"two rarefactions, nearly a vacuum", {1, -2, 0.4}, {1, 2, 0.4}, 1, 1e-12},
    {"blast from the left", {1, 0, 1000}, {1, 0, 0.01}, 0.23, 0.06},
    {"blast from the right", {1, 0, 0.01}, {1, 0, 100}, 0.23, 0.06},
    {"two shocks", {5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 0.06, 0.61},
    {"cold walls", {1, 1, 1e-6}, {1, -1, 1e-6}, 1e-6, 1e-12},
};

template <class Solver>
StarState<Lanes> solve(Solver&& star, const GasState& l, const GasState& r) {
  const auto all = [](double a) { return simd::all<Lanes>(a); };
  return star(MeetingGas<Lanes>{all(l.density), all(l.pressure), all(gamma_of_air)},
              MeetingGas<Lanes>{all(r.density), all(r.pressure), all(gamma_of_air)}, all(r.velocity - l.velocity));
}
constexpr auto exact = [](const auto& l, const auto& r, auto apart) { return exact_star(l, r, apart); };
constexpr auto approximate = [](const auto& l, const auto& r, auto apart) { return approximate_star(l, r, apart); };

TEST(RiemannStar, NewtonsMethodFindsTheExactSolution) {
  for (const Problem& problem : problems) {
    const ExactRiemann truth(problem.left, problem.right, gamma_of_air);
    const auto star = solve(exact, problem.left, problem.right);
    EXPECT_NEAR(star.pressure[0], truth.star_pressure(), 1e-10 * truth.star_pressure()) << problem.name;
    const double scale = std::abs(problem.left.velocity) + std::abs(truth.star_velocity()) + 1e-3;
    EXPECT_NEAR(problem.left.velocity - star.faster_left[0], truth.star_velocity(), 1e-9 * scale) << problem.name;
    EXPECT_NEAR(problem.right.velocity + star.faster_right[0], truth.star_velocity(), 1e-9 * scale) << problem.name;
  }
}

/// Gas without pressure that parts has no waves: what is between moves with the mean, and does not hang on round-off.
TEST(RiemannStar, ColdGasThatPartsKeepsItsMeanVelocity) {
  for (const double pressure : {1e-20, 1e-200, std::numeric_limits<double>::min()})
    for (double apart = 1e-16; apart < 1e4; apart *= 7) {
      const auto star = solve(approximate, {1, 0, pressure}, {1, apart, pressure});
      EXPECT_LE(star.pressure[0], pressure * (1 + 1e-8)) << pressure << ' ' << apart;
      EXPECT_NEAR(star.faster_left[0], -0.5 * apart, 1e-12 * apart) << pressure << ' ' << apart;
      EXPECT_NEAR(star.faster_right[0], -0.5 * apart, 1e-12 * apart) << pressure << ' ' << apart;
    }
}

TEST(RiemannStar, TheApproximationIsAsGoodAsStated) {
  for (const Problem& problem : problems) {
    const ExactRiemann truth(problem.left, problem.right, gamma_of_air);
    const auto star = solve(approximate, problem.left, problem.right);
    EXPECT_NEAR(star.pressure[0], truth.star_pressure(), problem.pressure_error * truth.star_pressure())
        << problem.name;
    EXPECT_GE(star.pressure[0], 0) << problem.name;
    const auto sound = [](const GasState& gas) { return std::sqrt(gamma_of_air * gas.pressure / gas.density); };
    EXPECT_NEAR(problem.left.velocity - star.faster_left[0], truth.star_velocity(),
                problem.velocity_error * std::max(sound(problem.left), sound(problem.right)))
        << problem.name;
  }
}

TEST(RiemannStar, AVacuumHasNoPressure) {
  const GasState left{1, -10, 1}, right{1, 10, 1};
  EXPECT_TRUE(ExactRiemann(left, right, gamma_of_air).vacuum());
  EXPECT_EQ(solve(exact, left, right).pressure[0], 0);
  EXPECT_EQ(solve(approximate, left, right).pressure[0], 0);
}

TEST(RiemannStar, BothSidesGetTheSameNumbers) {
  Uniform uniform(3);
  for (int k = 0; k < 2000; ++k) {
    const auto gas = [&] { return GasState{std::exp(uniform(-7, 7)), uniform(-3, 3), std::exp(uniform(-7, 7))}; };
    const GasState left = gas(), right = gas();
    for (const bool newton : {false, true}) {
      const auto star = newton ? solve(exact, left, right) : solve(approximate, left, right);
      // Turned round: the velocities too, so that what closes closes again.
      const GasState l = {right.density, -right.velocity, right.pressure},
                     r = {left.density, -left.velocity, left.pressure};
      const auto turned = newton ? solve(exact, l, r) : solve(approximate, l, r);
      ASSERT_EQ(star.pressure[0], turned.pressure[0]);
      ASSERT_EQ(star.faster_left[0], turned.faster_right[0]);
      ASSERT_EQ(star.faster_right[0], turned.faster_left[0]);
    }
  }
}

TEST(RiemannStar, MatterThatIsColdComesToAFiniteState) {
  for (const bool newton : {false, true})
    for (const double closing : {0.0, 1.0, -1.0}) {
      const GasState left{1, closing, 0}, right{2, -closing, 0};
      const auto star = newton ? solve(exact, left, right) : solve(approximate, left, right);
      EXPECT_TRUE(std::isfinite(star.pressure[0]) && std::isfinite(star.faster_left[0]));
      EXPECT_GE(star.pressure[0], 0);
    }
}

}  // namespace
}  // namespace ejecta
