#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/errors.hpp"
#include "unit/base/thread_counts.hpp"
#include "unit/simulation/small_scenes.hpp"

namespace ejecta {
namespace {

/// The scene with the ball first.
std::string ball_first() {
  const std::size_t target = porous_impact.find("[[bodies]]"), ball = porous_impact.find("[[bodies]]", target + 1);
  return porous_impact.substr(0, target) + porous_impact.substr(ball) + porous_impact.substr(target, ball - target);
}

/// Flaws of the pumice particles by where they are.
std::map<std::array<double, 3>, std::array<double, 3>> flaws_by_position(const Simulation<3>& sim) {
  std::map<std::array<double, 3>, std::array<double, 3>> flaws;
  const auto& p = sim.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (sim.materials[static_cast<std::size_t>(p.label(Label::material)[i])].name == "pumice")
      flaws[{p.column(Field::position, 0)[i], p.column(Field::position, 1)[i], p.column(Field::position, 2)[i]}] = {
          p.column(Field::flaw_strain)[i], p.column(Field::flaw_exponent)[i], p.column(Field::flaw_count)[i]};
  return flaws;
}

TEST(SetUp, FlawsDoNotDependOnTheOrderOfParticlesOrThreads) {
  const auto flaws = flaws_by_position(*start<3>(porous_impact));
  ASSERT_GT(flaws.size(), 400u);
  EXPECT_EQ(flaws, flaws_by_position(*start<3>(ball_first())));
  for_thread_counts([&](int) { EXPECT_EQ(flaws, flaws_by_position(*start<3>(porous_impact))); });
  EXPECT_NE(flaws, flaws_by_position(*start<3>(porous_impact, {"random.seed=2"})));
}

TEST(SetUp, EveryParticleHasAFlawAndTheyDiffer) {
  std::map<double, int> strains;
  for (const auto& [x, flaw] : flaws_by_position(*start<3>(porous_impact))) {
    EXPECT_GE(flaw[2], 1);
    EXPECT_GT(flaw[0], 0);
    ++strains[flaw[0]];
  }
  EXPECT_GT(strains.size(), 400u);
}

TEST(SetUp, BodiesHaveTheirMassVelocityAndState) {
  const auto sim = start<3>(porous_impact);
  const auto& p = sim->particles;
  const Range target = p.material_ranges()[0], ball = p.material_ranges()[1];
  EXPECT_EQ(target.end, ball.begin);
  EXPECT_EQ(ball.end, p.size());
  double mass = 0;
  for (std::size_t i = target.begin; i < target.end; ++i) {
    mass += p.column(Field::mass)[i];
    EXPECT_EQ(p.vector(Field::velocity, i), Vec<3>(0, 0, 0));
    EXPECT_EQ(p.column(Field::distension)[i], sim->materials[0].porosity->initial_distension());
    EXPECT_EQ(p.label(Label::body)[i], 0);
  }
  for (std::size_t i = ball.begin; i < ball.end; ++i) {
    EXPECT_EQ(p.vector(Field::velocity, i), Vec<3>(0, 200, -3000));
    EXPECT_EQ(p.column(Field::distension)[i], 1);
    EXPECT_EQ(p.label(Label::body)[i], 1);
  }
  const double volume = 4 * std::numbers::pi / 3 * std::pow(0.035, 3);
  EXPECT_NEAR(mass, volume * sim->materials[0].bulk_density(), 1e-12 * mass);
}

TEST(SetUp, MassesInMixedPrecisionAreNumbersThatSinglePrecisionHolds) {
  const auto sim = start<3>(porous_impact, {"numerics.precision=mixed"}), exact = start<3>(porous_impact);
  const auto mass = sim->particles.column(Field::mass);
  for (const double m : mass) EXPECT_EQ(m, static_cast<double>(static_cast<float>(m)));
  EXPECT_NEAR(totals(sim->particles).mass / totals(exact->particles).mass, 1, 1e-7);
}

TEST(SetUp, AUniformGasIsInEquilibrium) {
  const auto sim =
      start<2>(gas_tube, {"bodies[1].density=1 kg/m^3", "bodies[1].pressure=1 Pa", "bodies[1].spacing_factor=1"});
  const auto& p = sim->particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(p.column(Field::density)[i], 1, 0.02);
    EXPECT_NEAR(p.column(Field::pressure)[i], 1, 0.02);
    EXPECT_LT(p.vector(Field::acceleration, i).norm(), 1e-9);
    // n_h particles per smoothing length
    EXPECT_NEAR(p.column(Field::smoothing_length)[i], sim->scene.numerics.nodes_per_h * 0.025, 1e-3 * 0.025);
  }
}

TEST(SetUp, OverlappingBodiesAreAnInputError) {
  try {
    start<3>(porous_impact, {"bodies[1].center=[0, 0, \"30 mm\"]"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies.ball"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("overlap"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ejecta
