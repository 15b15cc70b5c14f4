/// How exactly the distension must be solved for. P is stiff in alpha, dP/d(alpha) = 3 GPa for the pumice at hand,
/// while its pores begin to crush and its flaws to open at 1 MPa, which is 3e-4 in alpha. Within a loose tolerance a
/// body sticks, off its curve, and then slips back onto it: pressure jumps to and fro, and so does the share of the
/// strain that the solid sees. Its stress, too large by then, opens flaws that should have stayed closed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// A bar of pumice thrown at a wall at 100 m/s: crushed near the wall, elastic beyond, still without a free surface.
const std::string compaction = R"([scene]
name = "compaction"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "24 us"
[[bodies]]
name = "bar"
material = "pumice"
shape = "rectangle"
center = ["75 mm", 0]
size = ["150 mm", "4 mm"]
velocity = ["-100 m/s", 0]
[boundary]
x = "reflecting"
y = "periodic"
min = [0, "-2 mm"]
max = ["1 m", "2 mm"]
)";

struct Outcome {
  std::vector<double> damage;  ///< at the end, by particle id
  double pressure_path = 0;    ///< sum of |changes of P| over all steps, mean over the particles [Pa]
};

Outcome crush(DistensionSolver solver, double tolerance) {
  Scene scene = parse_scene(compaction, "compaction.toml");
  scene.numerics.distension_solver = solver;
  scene.numerics.distension_tolerance = tolerance;  // a scene file may not ask for more than 1e-7
  const auto sim = set_up<2>(scene, read_materials(scene, EJECTA_SOURCE_DIR "/inputs/materials").list);
  Outcome outcome;
  std::vector<double> before = by_id(sim->particles, Field::pressure);
  while (sim->clock.time < scene.time_end) {
    step(*sim, no_limit);
    const std::vector<double> now = by_id(sim->particles, Field::pressure);
    for (std::size_t i = 0; i < now.size(); ++i) outcome.pressure_path += std::abs(now[i] - before[i]) / now.size();
    before = now;
  }
  outcome.damage = by_id(sim->particles, Field::damage);
  return outcome;
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

/// At the wall P = rho0 U u and u^2 = P (alpha0 - alpha)/rho_s put 14 MPa and alpha = 1.62 behind a front of U = 195
/// m/s. It crushes a thirtieth of the bar, to a damage of 0.67: 0.021 on average, and somewhat less as the deviator
/// bears a part. For tolerances up to 1e-7, the limit a scene may set, that is right to one particle of the 600, whose
/// weakest flaw may be at the brink. At 1e-5 two to six times as much breaks; at 1e-3 the pressure of a particle also
/// wanders many times as far: some in every step, so the less the fewer the steps.
TEST(DistensionTolerance, DamageOscillatesAboveAMillionthAndNotAtAllBelow) {
  const Outcome exact = crush(DistensionSolver::safe_newton, 1e-12);
  double mean_damage = 0;
  for (const double d : exact.damage) mean_damage += d / static_cast<double>(exact.damage.size());
  EXPECT_GT(mean_damage, 0.8 * 0.021);
  EXPECT_LT(mean_damage, 0.021);
  for (const auto solver : {DistensionSolver::safe_newton, DistensionSolver::bisection})
    for (const double tolerance : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3}) {
      const Outcome outcome = crush(solver, tolerance);
      const double off = mean_difference(outcome.damage, exact.damage);
      const double wandering = outcome.pressure_path / exact.pressure_path;
      std::printf("[ tolerance %.0e ] damage off by %.1e, pressure path %.3f of the exact one\n", tolerance, off,
                  wandering);
      if (tolerance <= 1e-7) {
        EXPECT_LT(off, 1.5 / static_cast<double>(exact.damage.size()));
        EXPECT_NEAR(wandering, 1, 0.03);
      } else {
        EXPECT_GT(off, mean_damage);
        EXPECT_GT(wandering, tolerance < 1e-3 ? 1.1 : 5);
      }
    }
}

}  // namespace
}  // namespace ejecta
