#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// One particle of a material, to be put into any state.
struct Probe {
  std::unique_ptr<Sph<3>> sim;
  Particles<3>& p;
  explicit Probe(const std::string& material, const std::string& more = "")
      : sim(start<3>(R"([scene]
name = "probe"
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "probe"
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
material = ")" + material +
                     "\"\n" + more)),
        p(sim->particles) {}
  const Material& material() const { return sim->materials[0]; }
  double& at(Field f, int component = 0) { return p.column(f, component)[0]; }
  EosPoint solid(double rho, double e) {
    return std::visit([&](const auto& eos) { return eos.evaluate(rho, e); }, material().eos);
  }
};

TEST(EquationOfStateStage, GivesPressureAndLongitudinalSpeedOfADenseSolid) {
  Probe probe("aluminium");
  probe.at(Field::density) *= 1.1;
  probe.at(Field::specific_energy) = 1e5;
  equation_of_state(*probe.sim);
  const double rho = probe.at(Field::density);
  const EosPoint point = probe.solid(rho, 1e5);
  EXPECT_EQ(probe.at(Field::pressure), point.pressure);
  const double bulk = point.dP_drho + point.pressure / (rho * rho) * point.dP_de;
  EXPECT_NEAR(probe.at(Field::sound_speed), std::sqrt(bulk + 4.0 / 3 * probe.material().elastic->shear_modulus / rho),
              1e-9);
}

TEST(EquationOfStateStage, SoundIsSlowerInAPorousBodyAsTheSceneSays) {
  // 300 m/s in the intact body, the speed in the solid in one without pores, and linear in the distension between.
  Probe solid("pumice"), porous("pumice", "[materials.pumice.porosity]\nsound_speed = \"300 m/s\"\n");
  const double alpha0 = solid.material().porosity->initial_distension(), rho0 = solid.at(Field::density);
  const auto crush_to = [&](double density) {
    for (Probe* probe : {&solid, &porous}) {
      probe->at(Field::density) = density;
      equation_of_state(*probe->sim);
    }
    EXPECT_EQ(porous.at(Field::distension), solid.at(Field::distension));
    return (porous.at(Field::distension) - 1) / (alpha0 - 1);
  };
  EXPECT_EQ(crush_to(rho0), 1);
  ASSERT_GT(solid.at(Field::sound_speed), 1000);
  EXPECT_NEAR(porous.at(Field::sound_speed), 300, 1e-9);
  const double pores = crush_to(1.4 * rho0), speed = solid.at(Field::sound_speed);
  ASSERT_TRUE(0.2 < pores && pores < 0.8);
  EXPECT_NEAR(porous.at(Field::sound_speed), pores * 300 + (1 - pores) * speed, 1e-9 * speed);
}

TEST(EquationOfStateStage, CrushesAPorousSolidForGood) {
  Probe probe("pumice");
  const Porosity& porosity = *probe.material().porosity;
  const double rho0 = probe.at(Field::density);
  EXPECT_EQ(probe.at(Field::distension), porosity.initial_distension());
  probe.at(Field::density) = 1.4 * rho0;
  equation_of_state(*probe.sim);
  const double alpha = probe.at(Field::distension), pressure = probe.at(Field::pressure);
  EXPECT_LT(alpha, porosity.initial_distension() - 0.5);
  EXPECT_NEAR(alpha, porosity.curve.alpha(pressure), 1e-9);
  EXPECT_NEAR(pressure, probe.solid(1.4 * alpha * rho0, 0).pressure / alpha, 1e-6 * pressure);
  EXPECT_LT(probe.at(Field::stress_factor), 1);
  probe.at(Field::density) = 1.38 * rho0;
  equation_of_state(*probe.sim);
  EXPECT_EQ(probe.at(Field::distension), alpha);
  EXPECT_LT(probe.at(Field::pressure), pressure);
  EXPECT_EQ(probe.at(Field::stress_factor), 1);
}

TEST(StrengthStage, ReturnsTheDeviatorToTheYieldSurfaceOfTheBody) {
  Probe probe("pumice");
  const double yield = std::get<VonMises>(*probe.material().strength).yield_stress;
  const double alpha = probe.at(Field::distension);
  probe.at(Field::specific_energy) = 0.25 * probe.material().melt_energy;
  probe.at(Field::deviatoric_stress, 2) = yield;  // pure shear: sqrt(3) times that, equivalent
  strength(*probe.sim);
  const double limit = 0.75 * yield / alpha;
  EXPECT_NEAR(std::sqrt(3.0) * probe.at(Field::deviatoric_stress, 2), limit, 1e-9 * yield);
  const double excess = std::sqrt(3.0) * yield - limit;
  EXPECT_NEAR(probe.at(Field::plastic_strain), excess / (3 * probe.material().elastic->shear_modulus / alpha), 1e-15);
  const double strained = probe.at(Field::plastic_strain);
  probe.at(Field::deviatoric_stress, 2) *= 0.9;
  strength(*probe.sim);
  EXPECT_EQ(probe.at(Field::plastic_strain), strained);
}

TEST(DamageStage, CracksGrowInTensionOnlyAndTakeTensionAway) {
  Probe probe("pumice");
  probe.at(Field::pressure) = 1e7;
  damage(*probe.sim);
  EXPECT_EQ(probe.at(Field::crack_length), 0);
  EXPECT_EQ(probe.at(Field::damage), 0);
  EXPECT_EQ(probe.sim->particles.column(Field::intact_share)[0], 1);

  probe.at(Field::pressure) = -1e9;
  damage(*probe.sim);
  EXPECT_EQ(probe.at(Field::crack_length), 0) << "no time, no growth";
  const Elastic& elastic = *probe.material().elastic;
  EXPECT_DOUBLE_EQ(probe.at(Field::local_strain), probe.at(Field::distension) * 1e9 / elastic.young());

  // A flaw far weaker than the others grows alone: by c_g/R, 4 pi R^3/3 = V. It opens half-way through the step.
  const double volume = probe.at(Field::mass) / probe.at(Field::density);
  const double radius = std::cbrt(3 * volume / (4 * std::numbers::pi));
  const double speed = probe.material().damage->crack_speed_factor * probe.at(Field::sound_speed);
  probe.at(Field::local_strain) = 0;
  probe.at(Field::flaw_strain) = 0.5e-8;
  probe.sim->clock.dt = radius / speed;
  probe.at(Field::pressure) = -1e-8 * elastic.young() / probe.at(Field::distension);
  damage(*probe.sim);
  EXPECT_NEAR(probe.at(Field::crack_length), 0.5, 1e-12);
  EXPECT_NEAR(probe.at(Field::damage), 0.125, 1e-12);
  EXPECT_NEAR(probe.sim->particles.column(Field::intact_share)[0], 0.875, 1e-12);
  probe.sim->clock.dt *= 0.5;
  probe.at(Field::pressure) = 1e9;
  damage(*probe.sim);
  EXPECT_NEAR(probe.at(Field::crack_length), 0.75, 1e-12) << "and closes half-way through this one, half as long";
  EXPECT_EQ(probe.at(Field::pressure), 1e9) << "broken matter bears pressure";

  probe.at(Field::pressure) = -1e9;
  damage(*probe.sim);
  EXPECT_EQ(probe.at(Field::damage), 1);
  EXPECT_EQ(probe.at(Field::pressure), 0);
  probe.at(Field::crack_length) = 0.1;
  probe.at(Field::pressure) = -1e9;
  damage(*probe.sim);
  EXPECT_EQ(probe.at(Field::damage), 1) << "what is broken stays broken";
  EXPECT_EQ(probe.at(Field::pressure), 0);
  EXPECT_EQ(probe.sim->particles.column(Field::intact_share)[0], 0);
}

TEST(DamageStage, PlasticStrainBreaksRock) {
  Probe probe("basalt");
  const Collins& rock = std::get<Collins>(*probe.material().strength);
  const double shear = probe.material().elastic->shear_modulus, pressure = 0.5e9;
  const auto strain_by = [&](double plastic) {  // pure shear
    const double yield = rock.yield({pressure, probe.at(Field::damage)});
    probe.at(Field::pressure) = pressure;
    probe.at(Field::deviatoric_stress, 2) = (yield + 3 * shear * plastic) / std::sqrt(3.0);
    strength(*probe.sim);
    damage(*probe.sim);
  };
  const double enough = rock.failure_strain(pressure);
  strain_by(0.25 * enough);
  EXPECT_NEAR(probe.at(Field::damage), 0.25, 1e-9);
  strain_by(0.25 * enough);
  EXPECT_NEAR(probe.at(Field::damage), 0.5, 1e-9);
  EXPECT_EQ(probe.at(Field::pressure), pressure) << "broken matter bears pressure";
  strain_by(2 * enough);
  EXPECT_EQ(probe.at(Field::damage), 1);
  probe.at(Field::pressure) = -1e6;
  damage(*probe.sim);
  EXPECT_EQ(probe.at(Field::pressure), 0) << "and no tension";

  Probe spared("basalt_von_mises");
  EXPECT_FALSE(spared.p.has(Field::shear_damage));
}

TEST(DamageStage, CrushedPoresAreDamageToo) {
  Probe probe("pumice");
  probe.at(Field::distension) = 1;
  damage(*probe.sim);
  EXPECT_NEAR(probe.at(Field::damage), 1, 1e-12);
}

}  // namespace
}  // namespace ejecta
