#include <gtest/gtest.h>

#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// An aluminium rod of 24 x 6 particles between two grips that pull it apart at 400 m/s and up at 50 m/s.
const std::string rod = R"([scene]
name = "rod"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "left"
material = "aluminium"
shape = "rectangle"
center = ["-14 mm", 0]
size = ["4 mm", "6 mm"]
velocity = ["-200 m/s", "50 m/s"]
driven = true
[[bodies]]
name = "rod"
material = "aluminium"
shape = "rectangle"
size = ["24 mm", "6 mm"]
[[bodies]]
name = "right"
material = "aluminium"
shape = "rectangle"
center = ["14 mm", 0]
size = ["4 mm", "6 mm"]
velocity = ["200 m/s", "50 m/s"]
driven = true
[materials.aluminium.damage]
model = "grady_kipp_tensor"
weibull_m = 2.63
weibull_k = "1e9 1/m^3"
strain = "pseudo_plastic"
)";

/// The ledger is exact where pair forces are central: a gas has pressure only.
TEST(DrivenBodies, TheTorqueOfThePistonsIsCounted) {
  std::string gas = gas_tube;
  gas.replace(gas.find("[boundary]"), std::string::npos, "");
  const auto sim = start<2>(gas, {"bodies.right.driven=true", "bodies.right.velocity=[\"-0.5 m/s\", \"0.3 m/s\"]"});
  advance(*sim, 150);
  const Totals now = totals(sim->particles);
  EXPECT_GT((now.angular_momentum - sim->initial.angular_momentum).norm(), 1e-4 * now.angular_scale) << "none acted";
  EXPECT_LT(conservation_errors(sim->initial, now, sim->external).angular_momentum, 1e-12);
}

TEST(DrivenBodies, KeepTheirVelocityAndStayWhole) {
  const auto sim = start<2>(rod);
  advance(*sim, 300);
  const auto& p = sim->particles;
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const int body = p.label(Label::body)[i];
    if (body == 1) {
      most = std::max(most, p.column(Field::damage)[i]);
      continue;
    }
    EXPECT_EQ(p.vector(Field::velocity, i), Vec<2>(body == 0 ? -200 : 200, 50));
    EXPECT_EQ(p.column(Field::damage)[i], 0);
    EXPECT_EQ(sim->particles.column(Field::intact_share)[i], 1);
  }
  EXPECT_GT(most, 0.9) << "the rod breaks";
}

TEST(DrivenBodies, TheirWorkAndImpulseBalanceEnergyAndMomentum) {
  for (const char* more : {"numerics.gradient_correction=false", "numerics.gradient_correction=true"}) {
    const auto sim = start<2>(rod, {more});
    double worst_energy = 0, worst_momentum = 0;
    for (int k = 0; k < 300; ++k) {
      step(*sim, no_limit);
      const auto errors = conservation_errors(sim->initial, totals(sim->particles), sim->external);
      worst_energy = std::max(worst_energy, std::abs(errors.energy));
      worst_momentum = std::max(worst_momentum, errors.momentum);
    }
    EXPECT_LT(worst_energy, 1e-12);
    EXPECT_LT(worst_momentum, 1e-12);
    const Totals now = totals(sim->particles);
    EXPECT_GT(sim->external.work, 0.05 * sim->initial.kinetic) << "pulling costs";
    EXPECT_GT(std::abs(now.energy() - sim->initial.energy()), 0.05 * sim->initial.kinetic);
    EXPECT_GT(sim->external.impulse[1], 0.05 * sim->initial.momentum[1]) << "and so does lifting the rod";
    RecordProperty("energy", std::to_string(worst_energy));
    printf("  energy %.2g, momentum %.2g, work %.3g of the kinetic energy\n", worst_energy, worst_momentum,
           sim->external.work / sim->initial.kinetic);
  }
}

TEST(DrivenBodies, WithoutThemThereIsNoStage) {
  const auto sim = start<2>(rod, {"bodies.left.driven=false", "bodies.right.driven=false"});
  for (const auto& stage : sim->stages) EXPECT_NE(stage.name, "driven bodies");
  advance(*sim, 20);
  EXPECT_EQ(sim->external.work, 0);
}

}  // namespace
}  // namespace ejecta
