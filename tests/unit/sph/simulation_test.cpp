#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/errors.hpp"
#include "sph/sph.hpp"
#include "sph/stages.hpp"
#include "unit/base/thread_counts.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

template <int Dim>
ConservationErrors errors_after(Sph<Dim>& sim, int steps) {
  advance(sim, steps);
  return conservation_errors(sim.initial, totals(sim.particles));
}

TEST(Simulation, APorousImpactConservesMassMomentumAndEnergyToRoundOff) {
  for (const bool corrected : {false, true}) {
    const auto sim =
        start<3>(porous_impact, {std::string("numerics.gradient_correction=") + (corrected ? "true" : "false")});
    const double heat_before = sim->initial.internal;
    const ConservationErrors errors = errors_after(*sim, 200);
    EXPECT_EQ(errors.mass, 0);
    EXPECT_LT(errors.momentum, 1e-13);
    if (corrected) {
      EXPECT_LT(errors.angular_momentum, 1e-13);
    }
    EXPECT_LT(std::abs(errors.energy), 1e-12);
    EXPECT_GT(totals(sim->particles).internal, heat_before + 0.2 * sim->initial.kinetic) << "nothing has happened";
  }
}

TEST(Simulation, MixedPrecisionConservesMomentumToRoundOffAndEnergyToSingle) {
  const auto sim = start<3>(porous_impact, {"numerics.precision=mixed"});
  const ConservationErrors errors = errors_after(*sim, 200);
  EXPECT_EQ(errors.mass, 0);
  EXPECT_LT(errors.momentum, 1e-13);
  EXPECT_LT(std::abs(errors.energy), 1e-8);
}

TEST(Simulation, AGasTubeConservesEnergyAndKeepsItsSymmetry) {
  const auto sim = start<2>(gas_tube);
  const ConservationErrors errors = errors_after(*sim, 200);
  EXPECT_EQ(errors.mass, 0);
  EXPECT_LT(std::abs(errors.energy), 1e-12);
  EXPECT_GT(totals(sim->particles).kinetic, 0.01 * sim->initial.internal) << "nothing has happened";
  // The walls take momentum along x only.
  const Totals now = totals(sim->particles);
  EXPECT_LT(std::abs(now.momentum[1]), 1e-12 * now.momentum_scale);
}

TEST(Simulation, EveryThreadCountGivesTheSameBits) {
  const std::vector<std::vector<std::string>> variants{
      {}, {"numerics.precision=mixed"}, {"bodies.ball.material=rubber", "contact.friction=0.5"}};
  for (const auto& overrides : variants) {
    std::vector<std::unique_ptr<Sph<3>>> runs;
    for_thread_counts([&](int) {
      runs.push_back(start<3>(porous_impact, overrides));
      advance(*runs.back(), 20);
    });
    const Particles<3>& first = runs[0]->particles;
    for (const auto& other : {runs[1].get(), runs[2].get()}) {
      EXPECT_EQ(other->clock.time, runs[0]->clock.time);
      for (const Field f : first.fields())
        for (int k = 0; k < components(info(f).shape, 3); ++k)
          EXPECT_EQ(0, std::memcmp(first.column(f, k).data(), other->particles.column(f, k).data(),
                                   first.size() * sizeof(double)))
              << info(f).name;
    }
  }
}

TEST(Simulation, CrushingAndDamageAreOneWayAndOnTheCurve) {
  const auto sim = start<3>(porous_impact);
  const Material& pumice = sim->materials[0];
  ASSERT_TRUE(pumice.porosity);
  auto alpha = by_id(sim->particles, Field::distension), damage = by_id(sim->particles, Field::damage);
  double least = 10, most_damage = 0;
  std::size_t crushed = 0, rebounds = 0, healed = 0, on_curve = 0;
  for (int k = 0; k < 200; ++k) {
    step(*sim, no_limit);
    const auto new_alpha = by_id(sim->particles, Field::distension), new_damage = by_id(sim->particles, Field::damage);
    const auto pressure = by_id(sim->particles, Field::pressure), material = [&] {
      std::vector<double> m(sim->particles.size());
      for (std::size_t i = 0; i < m.size(); ++i)
        m[static_cast<std::size_t>(sim->particles.label(Label::id)[i])] = sim->particles.label(Label::material)[i];
      return m;
    }();
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      if (material[i] != 0) continue;
      rebounds += new_alpha[i] > alpha[i];
      healed += new_damage[i] < damage[i];
      least = std::min(least, new_alpha[i]);
      most_damage = std::max(most_damage, new_damage[i]);
      if (new_alpha[i] == alpha[i]) continue;
      ++crushed;
      on_curve += std::abs(new_alpha[i] - pumice.porosity->curve.alpha(pressure[i])) < 1e-6;
    }
    alpha = new_alpha;
    damage = new_damage;
  }
  EXPECT_EQ(rebounds, 0u);
  EXPECT_EQ(healed, 0u);
  EXPECT_EQ(on_curve, crushed);
  EXPECT_GT(crushed, 1000u);
  EXPECT_GE(least, 1);
  EXPECT_LT(least, 2);
  EXPECT_LE(most_damage, 1);
  EXPECT_GT(most_damage, 0.99);
}

TEST(Simulation, ALoneBodyFliesBallistically) {
  const auto sim = start<3>(R"([scene]
name = "flight"
[resolution]
spacing = "1 m"
[time]
end = "1 s"
[[bodies]]
name = "stone"
material = "nylon"
shape = "box"
center = ["1 m", "2 m", "3 m"]
size = ["1 m", "1 m", "1 m"]
velocity = ["100 m/s", "-20 m/s", "3 m/s"]
)");
  ASSERT_EQ(sim->particles.size(), 1u);
  advance(*sim, 50);
  const Vec<3> v(100, -20, 3), x = Vec<3>(1, 2, 3) + sim->clock.time * v;
  EXPECT_EQ(sim->particles.vector(Field::velocity, 0), v);
  EXPECT_LT((sim->particles.vector(Field::position, 0) - x).norm(), 1e-14 * x.norm());
}

TEST(Simulation, APairListServesManySteps) {
  const auto sim = start<3>(porous_impact);
  advance(*sim, 100);
  EXPECT_LT(sim->list_builds, 40);
  EXPECT_GE(sim->sorts, 1);
}

/// The message of the SimulationError that the next step throws.
template <int Dim>
std::string failure_of_next_step(Sph<Dim>& sim) {
  try {
    step(sim, no_limit);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "no error";
}

bool mentions(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

TEST(Simulation, ANotANumberEndsItNamingTheParticle) {
  const auto sim = start<3>(porous_impact);
  advance(*sim, 5);
  const std::size_t ball = sim->particles.material_ranges()[1].begin;
  sim->particles.column(Field::specific_energy)[ball] = std::nan("");
  const std::string message = failure_of_next_step(*sim);
  EXPECT_TRUE(mentions(message, "step 6")) << message;
  EXPECT_TRUE(mentions(message, "particle ")) << message;
  EXPECT_TRUE(mentions(message, "nan")) << message;
  EXPECT_TRUE(mentions(message, "body \"")) << message;
  EXPECT_TRUE(mentions(message, "material \"")) << message;
}

/// Densities are held near what the neighbours leave a particle, but nothing takes the place of one that is lost.
TEST(Simulation, RemarksOnEnergiesBelowZero) {
  const auto sim = start<3>(porous_impact);
  EXPECT_TRUE(sim->remarks().empty());
  const double mean = sim->initial.energy() / sim->initial.mass;
  sim->particles.column(Field::specific_energy)[50] = -0.005 * mean;
  EXPECT_TRUE(sim->remarks().empty());
  for (const std::size_t i : {50u, 60u}) sim->particles.column(Field::specific_energy)[i] = -0.02 * mean;
  ASSERT_EQ(sim->remarks().size(), 1u);
  EXPECT_TRUE(sim->remarks()[0].worrying);
  EXPECT_EQ(sim->remarks()[0].text.find("2 particles have a specific energy below zero, down to -0.02 times"), 0u)
      << sim->remarks()[0].text;
}

TEST(Simulation, ADensityThatIsNoNumberEndsItToo) {
  for (const double lost : {std::nan(""), static_cast<double>(INFINITY)}) {
    const auto sim = start<3>(porous_impact);
    advance(*sim, 5);
    sim->particles.column(Field::density)[place_of(sim->particles, 17)] = lost;
    const std::string message = failure_of_next_step(*sim);
    EXPECT_TRUE(mentions(message, "step 6")) << message;
    EXPECT_TRUE(mentions(message, "state not finite")) << message;
  }
}

TEST(Simulation, ACollapsedTimeStepEndsItNamingReasonAndParticle) {
  const auto sim = start<3>(porous_impact);
  sim->particles.column(Field::sound_speed)[place_of(sim->particles, 99)] = 1e30;
  const std::string message = failure_of_next_step(*sim);
  EXPECT_TRUE(mentions(message, "time step has collapsed")) << message;
  EXPECT_TRUE(mentions(message, "Courant condition of particle 99 (body \"target\"")) << message;
}

TEST(Simulation, AnEnergyDriftBeyondTheLimitEndsIt) {
  const auto sim = start<2>(gas_tube);
  advance(*sim, 10);
  for (double& e : sim->particles.column(Field::specific_energy)) e *= 1.1;
  EXPECT_THROW(advance(*sim, 20), SimulationError);
}

}  // namespace
}  // namespace ejecta
