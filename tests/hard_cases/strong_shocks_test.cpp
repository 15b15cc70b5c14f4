/// Shocks without a scale to compare with: into gas with no pressure, from one hot particle, and at any speed.
#include <gtest/gtest.h>

#include <cstdio>

#include "hard_cases/small_runs.hpp"

namespace ejecta {
namespace {

const std::string gas = R"([materials.gas.eos]
model = "ideal_gas"
gamma = 1.6666666666666667
density = "1 kg/m^3"
)";

/// Noh's problem in the plane: cold gas runs into a wall at 1 m/s.
const std::string noh = R"([scene]
name = "noh"
dimension = 2
[resolution]
spacing = "10 mm"
[time]
end = "0.6 s"
[[bodies]]
name = "gas"
material = "gas"
shape = "rectangle"
center = ["0.5 m", 0]
size = ["1 m", "0.1 m"]
density = "1 kg/m^3"
velocity = ["-1 m/s", 0]
[boundary]
x = "reflecting"
y = "periodic"
min = [0, "-50 mm"]
max = ["2 m", "50 mm"]
)" + gas;

/// At P0 = 1e-6 Pa, and at none at all, the Mach number is a thousand or infinite; the sound speed ahead of the shock
/// says nothing about the time step, the speed of approach does. The energy of no particle falls below what it was, and
/// the gas behind the shock is near the limit (gamma + 1)/(gamma - 1) = 4 of the density; by continuity, which is not
/// made for gases, it stays a seventh below.
TEST(StrongShocks, IntoGasWithoutPressure) {
  for (const char* pressure : {"1e-6 Pa", "0 Pa"})
    for (const char* density : {"summation", "continuity"}) {
      const auto sim =
          start<2>(noh, {std::string("bodies[0].pressure=") + pressure, std::string("numerics.density=") + density});
      const double at_first = sim->particles.column(Field::specific_energy)[0];
      const Outcome outcome = follow(*sim);
      EXPECT_EQ(outcome.error, "");
      // Without pressure some particles end at -1e-58 J/kg beside 0.5: round-off of zero.
      EXPECT_GE(outcome.least_energy, 0.999 * at_first - 1e-50) << pressure << ' ' << density;
      EXPECT_LT(std::abs(outcome.conservation.energy), 1e-13);
      double behind = 0;
      int count = 0;
      for (std::size_t i = 0; i < sim->particles.size(); ++i)
        if (const double x = sim->particles.column(Field::position, 0)[i]; x > 0.05 && x < 0.15) {
          behind += sim->particles.column(Field::density)[i];
          ++count;
        }
      EXPECT_NEAR(behind / count, 4, std::string(density) == "summation" ? 0.3 : 0.7) << pressure << ' ' << density;
    }
}

/// All the energy of a blast in one of 41 x 41 particles.
std::unique_ptr<Sph<2>> spike(double ratio, const std::vector<std::string>& overrides) {
  auto sim = start<2>(R"([scene]
name = "spike"
dimension = 2
[resolution]
spacing = "24.390243902439025 mm"
[time]
end = "0.1 s"
[[bodies]]
name = "gas"
material = "gas"
shape = "rectangle"
size = ["1 m", "1 m"]
density = "1 kg/m^3"
pressure = "1 Pa"
[boundary]
x = "periodic"
y = "periodic"
min = ["-0.5 m", "-0.5 m"]
max = ["0.5 m", "0.5 m"]
)" + gas,
                      overrides);
  auto& p = sim->particles;
  const double hot = 1 / p.column(Field::mass)[0];
  for (std::size_t i = 0; i < p.size(); ++i)
    p.column(Field::specific_energy)[i] = p.vector(Field::position, i).norm() < 1e-6 ? hot : hot / ratio;
  begin_from_here(*sim);
  return sim;
}

/// A spike 1e10 times as hot as its neighbours. Each side of a pair takes its own share of the pair's work and half of
/// the viscous heat, so no cold neighbour pays for the hot one: nobody's energy falls below what it was.
TEST(StrongShocks, FromOneHotParticleLeaveNobodyBelowZero) {
  for (const char* precision : {"double", "mixed"}) {
    const auto sim = spike(1e10, {"numerics.density=summation", std::string("numerics.precision=") + precision});
    const double cold = 1e-10 / sim->particles.column(Field::mass)[0];
    const Outcome outcome = follow(*sim);
    EXPECT_EQ(outcome.error, "");
    EXPECT_GE(outcome.least_energy, 0.99 * cold) << precision;
    const bool exact = sim->scene.numerics.precision == Precision::double_precision;
    EXPECT_LT(std::abs(outcome.conservation.energy), exact ? 1e-13 : 1e-7);
    EXPECT_LT(outcome.conservation.momentum, 1e-13) << "a pair has been missed by one of its sides";
    EXPECT_GT(totals(sim->particles).kinetic, 0.1) << "nothing has happened";
  }
}

/// With density by continuity the hot particle thins out without bound once its neighbours have left. The step that
/// keeps its density positive goes to zero; the run ends and says for whom.
TEST(StrongShocks, AParticleThatThinsOutWithoutBoundIsNamed) {
  const auto sim = spike(1e10, {"numerics.density=continuity"});
  const Outcome outcome = follow(*sim);
  if (outcome.error.empty()) {
    EXPECT_GE(outcome.least_energy, 0);
    return;
  }
  EXPECT_TRUE(mentions(outcome.error, "the time step has collapsed")) << outcome.error;
  EXPECT_TRUE(mentions(outcome.error, "by the compression of particle ")) << outcome.error;
}

/// From a walk to the speed of light (which the equations do not know): the same few dozen steps, energy to round-off.
/// Beyond, the step is so short that the run would not end, and it says for whom; at last squares overflow.
TEST(StrongShocks, AnyImpactSpeedRunsOrIsNamed) {
  for (const char* speed : {"1 m/s", "3 km/s", "100 km/s", "1e6 m/s", "3e8 m/s"}) {
    const auto sim = start<3>(porous_impact, {std::string("bodies.ball.velocity=0 0 -") + speed});
    const Outcome outcome = follow(*sim, 60);
    EXPECT_EQ(outcome.error, "") << speed;
    EXPECT_LT(std::abs(outcome.conservation.energy), 1e-13) << speed;
    EXPECT_GE(outcome.least_energy, -1e-9) << speed;  // round-off of 4.5e16 J/kg
  }
  for (const char* speed : {"1e12 m/s", "1e100 m/s"}) {
    const auto sim = start<3>(porous_impact, {std::string("bodies.ball.velocity=0 0 -") + speed});
    const Outcome outcome = follow(*sim, 60);
    EXPECT_TRUE((mentions(outcome.error, "by the ") && mentions(outcome.error, "particle ")) ||
                mentions(outcome.error, "total energy has drifted"))
        << speed << ' ' << outcome.error;
  }
  EXPECT_THROW(start<3>(porous_impact, {"bodies.ball.velocity=0 0 -1e200 m/s"}), InputError);
}

/// Nylon thrown at rock at 6 km/s passes the narrow band between its incipient and complete vaporisation, where heating
/// lowers the pressure. Hundreds of particle-steps are spent there; the time step does not notice.
TEST(StrongShocks, CrossingTheMixedBandLeavesTheTimeStepAlone) {
  const auto sim = start<2>(R"([scene]
name = "band"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "100 us"
[[bodies]]
name = "target"
material = "basalt"
shape = "rectangle"
size = ["40 mm", "16 mm"]
[[bodies]]
name = "rod"
material = "nylon"
shape = "disc"
radius = "8 mm"
center = [0, "16.5 mm"]
velocity = [0, "-6 km/s"]
)");
  const auto& nylon = std::get<Tillotson>(sim->materials[1].eos);
  const auto& p = sim->particles;
  int in_band = 0, falling = 0;
  double first = 0, shortest = 1;
  for (int k = 0; k < 400; ++k) {
    step(*sim, no_limit);
    if (k == 0) first = sim->clock.dt;
    shortest = std::min(shortest, sim->clock.dt);
    const Range rod = p.material_ranges()[1];
    for (std::size_t i = rod.begin; i < rod.end; ++i) {
      const double rho = p.column(Field::density)[i], e = p.column(Field::specific_energy)[i];
      if (rho >= nylon.rho0 || e <= nylon.E_iv || e >= nylon.E_cv) continue;
      ++in_band;
      falling += nylon.evaluate(rho, e).dP_de < 0;
    }
  }
  std::printf("[ mixed band ] %d particle-steps, dP/de < 0 in %d; shortest step %.2f of the first\n", in_band, falling,
              shortest / first);
  EXPECT_GT(falling, 100);
  EXPECT_GT(shortest, 0.3 * first);
}

}  // namespace
}  // namespace ejecta
