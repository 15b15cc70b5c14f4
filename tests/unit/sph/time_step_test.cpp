#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"
#include "sph/criteria.hpp"
#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

TEST(TimeStep, IsTheCourantConditionOfAGasAtRest) {
  const auto sim = start<2>(gas_tube);
  auto& p = sim->particles;
  for (int a = 0; a < 2; ++a) std::ranges::fill(p.column(Field::acceleration, a), 0.0);
  const Numerics& n = sim->scene.numerics;
  const std::size_t i = 100;
  p.column(Field::sound_speed)[i] = 10;
  p.column(Field::largest_mu)[i] = 3;
  const Vote vote = sim->vote();
  const double h = p.column(Field::smoothing_length)[i];
  EXPECT_EQ(vote.culprit, i);
  EXPECT_EQ(vote.reason, "Courant condition");
  EXPECT_NEAR(vote.dt, n.courant * h / (10 + 0.6 * (n.viscosity_alpha * 10 + 2 * n.viscosity_beta * 3)), 1e-15 * h);
}

TEST(TimeStep, IsShortenedByAcceleration) {
  const auto sim = start<2>(gas_tube);
  auto& p = sim->particles;
  p.set_vector(Field::acceleration, 50, Vec<2>(3e8, 4e8));
  const Vote vote = sim->vote();
  EXPECT_EQ(vote.culprit, 50u);
  EXPECT_EQ(vote.reason, "acceleration");
  EXPECT_NEAR(vote.dt, sim->scene.numerics.courant * std::sqrt(p.column(Field::smoothing_length)[50] / 5e8), 1e-18);
}

TEST(TimeStep, IsShortenedByCompression) {
  const auto sim = start<3>(porous_impact);
  auto& p = sim->particles;
  p.column(Field::compression_rate)[77] = -1e9;
  const Vote vote = sim->vote();
  EXPECT_EQ(vote.culprit, 77u);
  EXPECT_EQ(vote.reason, "compression");
  EXPECT_NEAR(vote.dt, sim->scene.numerics.courant * 1e-9, 1e-22);
}

/// A vapour of P = 2 rho e loses twice as large a share of its heat as of its density; cold matter has none to lose.
TEST(TimeStep, LeavesVapourSomeOfItsHeat) {
  const auto sim = start<3>(porous_impact);
  auto& p = sim->particles;
  p.column(Field::compression_rate)[77] = -1e9;
  const auto vote = [&](double pressure, double energy) {
    p.column(Field::pressure)[77] = pressure;
    p.column(Field::specific_energy)[77] = energy / p.column(Field::density)[77];
    return sim->vote().dt / (sim->scene.numerics.courant * 1e-9);
  };
  EXPECT_NEAR(vote(2e9, 1e9), 1. / 2, 1e-12);
  EXPECT_NEAR(vote(1e9, 1e6), 1. / 3, 1e-12) << "what elastic matter stores is no vapour's heat";
  EXPECT_NEAR(vote(1e9, -1e6), 1. / 3, 1e-12);
  EXPECT_NEAR(vote(5e8, 1e9), 1, 1e-12);
  EXPECT_NEAR(vote(-1e6, -1e7), 1, 1e-12);
  p.column(Field::compression_rate)[77] = 1e9;
  EXPECT_NEAR(vote(2e9, 1e9), 1, 1e-12) << "compression heats";
}

TEST(TimeStep, IsNotShortenedByGrowingCracks) {
  const auto sim = start<3>(porous_impact);
  const double before = sim->vote().dt;
  std::ranges::fill(sim->particles.column(Field::flaw_strain), 1e-9);
  std::ranges::fill(sim->particles.column(Field::local_strain), 0.1);
  sim->clock.dt = 1e-9;
  damage(*sim);
  EXPECT_GT(std::ranges::max(sim->particles.column(Field::crack_length)), 0.5) << "broken in one step";
  EXPECT_EQ(sim->vote().dt, before);
}

TEST(TimeStep, DoesNotDependOnTheFrame) {
  const auto at_rest = start<3>(porous_impact);
  const auto moving = start<3>(porous_impact, {"bodies[0].velocity=[\"10 km/s\", 0, \"1 km/s\"]",
                                               "bodies[1].velocity=[\"10 km/s\", \"200 m/s\", \"-2 km/s\"]"});
  for (int k = 0; k < 20; ++k) EXPECT_NEAR(step(*moving, no_limit).dt / step(*at_rest, no_limit).dt, 1, 1e-9);
  EXPECT_EQ(moving->list_builds, at_rest->list_builds);
}

TEST(Health, NamesStageAndParticleOfABadState) {
  const auto message_of = [](Field field, int component, double value) -> std::string {
    const auto sim = start<3>(porous_impact);
    sim->check_health();
    sim->particles.column(field, component)[place_of(sim->particles, 17)] = value;
    try {
      sim->check_health();
    } catch (const SimulationError& error) {
      return error.what();
    }
    return "no error";
  };
  const auto expect = [](const std::string& message, const std::string& origin) {
    EXPECT_NE(message.find(origin), std::string::npos) << message;
    EXPECT_NE(message.find("particle 17 (body \"target\", material \"pumice\")"), std::string::npos) << message;
  };
  expect(message_of(Field::density, 0, -1), "after set-up");
  expect(message_of(Field::density, 0, 0), "after set-up");
  expect(message_of(Field::velocity, 2, std::nan("")), "after set-up");
  expect(message_of(Field::specific_energy, 0, -INFINITY), "after set-up");
  expect(message_of(Field::acceleration, 1, INFINITY), "stage \"pair rates\" (field acceleration)");
}

}  // namespace
}  // namespace ejecta
