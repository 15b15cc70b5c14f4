#include <gtest/gtest.h>

#include <algorithm>

#include "sph/integrator.hpp"
#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

TEST(PeaksStage, RemembersTheExtremesOfEveryParticleAndWhereItWas) {
  const auto sim = start<3>(porous_impact, {"output.peaks=true"});
  const auto x = by_id(sim->particles, Field::position, 2);
  auto highest = by_id(sim->particles, Field::pressure), hottest = by_id(sim->particles, Field::specific_energy);
  auto lowest = by_id(sim->particles, Field::density);
  double released = 0;
  for (int k = 0; k < 60; ++k) {
    sim->clock.step = k + 1;
    predict(sim->particles, 1e-7, 1e-7);
    sim->clock.dt = 1e-7;
    sim->clock.time += 1e-7;
    evaluate(*sim);
    const auto p = by_id(sim->particles, Field::pressure), u = by_id(sim->particles, Field::specific_energy);
    const auto rho = by_id(sim->particles, Field::density);
    for (std::size_t i = 0; i < p.size(); ++i) {
      highest[i] = std::max(highest[i], p[i]);
      hottest[i] = std::max(hottest[i], u[i]);
      lowest[i] = std::min(lowest[i], rho[i]);
    }
    correct(sim->particles, 1e-7);
  }
  for (std::size_t i = 0; i < highest.size(); ++i)
    released = std::max(released, highest[i] - by_id(sim->particles, Field::pressure)[i]);
  EXPECT_GT(released, 1e6) << "nothing has happened";
  EXPECT_EQ(by_id(sim->particles, Field::pressure_peak), highest);
  EXPECT_EQ(by_id(sim->particles, Field::specific_energy_peak), hottest);
  EXPECT_EQ(by_id(sim->particles, Field::density_low), lowest);
  EXPECT_EQ(by_id(sim->particles, Field::initial_position, 2), x);
}

TEST(PeaksStage, CostsNothingUnlessAskedFor) {
  const auto plain = start<3>(porous_impact), asked = start<3>(porous_impact, {"output.peaks=true"});
  EXPECT_FALSE(plain->particles.has(Field::pressure_peak));
  EXPECT_EQ(plain->stages.size() + 1, asked->stages.size());
  advance(*plain, 5);
  advance(*asked, 5);
  EXPECT_EQ(by_id(plain->particles, Field::specific_energy), by_id(asked->particles, Field::specific_energy));
}

}  // namespace
}  // namespace ejecta
