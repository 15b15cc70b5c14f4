/// Metals in the stages: the varying shear modulus, and a single particle driven through large strains.
#include <gtest/gtest.h>

#include <cmath>

#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

std::unique_ptr<Sph<3>> one_particle(const std::string& material, const std::vector<std::string>& settings = {}) {
  return start<3>(R"([scene]
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
                      "\"\n",
                  settings);
}

double& at(Sph<3>& sim, Field f, int component = 0) { return sim.particles.column(f, component)[0]; }

TEST(ShearModulus, FollowsPressureAndTemperatureInAllStages) {
  const auto sim = one_particle("steel_304");
  const Material& steel = sim->materials[0];
  EXPECT_EQ(at(*sim, Field::shear_modulus), 77e9);
  const double rho = at(*sim, Field::density) = 1.1 * 7900;
  at(*sim, Field::specific_energy) = 3e5;
  equation_of_state(*sim);
  const MieGrueneisen& eos = std::get<MieGrueneisen>(steel.eos);
  const auto& law = std::get<SteinbergGuinan>(*steel.strength);
  const EosPoint point = eos.evaluate(rho, 3e5);
  const double shear = 77e9 * law.shear_factor(point.pressure, 1.1, warmth(eos, rho, 3e5));
  EXPECT_EQ(at(*sim, Field::shear_modulus), shear);
  EXPECT_GT(shear, 1.05 * 77e9);
  const double bulk = point.dP_drho + point.pressure / (rho * rho) * point.dP_de;
  EXPECT_NEAR(at(*sim, Field::sound_speed), std::sqrt(bulk + 4 * shear / (3 * rho)), 1e-9);

  at(*sim, Field::velocity_gradient, 1) = 1000;  // simple shear
  strain_rates(*sim);
  EXPECT_NEAR(at(*sim, Field::stress_rate, 2), 1000 * shear, 1e-3);

  sim->clock.dt = 1e-7;
  at(*sim, Field::deviatoric_stress, 2) = 2e9;
  strength(*sim);
  const double equivalent = std::sqrt(3.0) * at(*sim, Field::deviatoric_stress, 2);
  const double strain = at(*sim, Field::plastic_strain);
  const double yield = law.yield({.plastic_strain = strain, .shear_factor = shear / 77e9});
  EXPECT_NEAR(equivalent, yield, 1e-10 * yield);
  EXPECT_NEAR(std::sqrt(3.0) * 2e9 - equivalent, 3 * shear * strain, 1e-3);

  at(*sim, Field::density) = 7900;
  at(*sim, Field::specific_energy) = 1.2e6;  // beyond melting
  equation_of_state(*sim);
  strength(*sim);
  strain_rates(*sim);
  EXPECT_EQ(at(*sim, Field::shear_modulus), 0);
  EXPECT_EQ(at(*sim, Field::deviatoric_stress, 2), 0);
  EXPECT_EQ(at(*sim, Field::stress_rate, 2), 0);
  EXPECT_EQ(at(*sim, Field::plastic_strain), strain);
}

TEST(ShearModulus, IsAColumnOnlyWhereItVaries) {
  EXPECT_FALSE(one_particle("steel_4340")->particles.has(Field::shear_modulus));
  const auto both = start<3>(R"([scene]
name = "both"
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "a"
material = "steel_304"
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
[[bodies]]
name = "b"
material = "basalt"
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
center = ["5 mm", 0, 0]
)");
  const auto range = both->particles.material_ranges()[both->materials[0].name == "basalt" ? 0 : 1];
  EXPECT_EQ(both->particles.column(Field::shear_modulus)[range.begin], 22.7e9);
}

struct Sheared {
  double equivalent, plastic_strain, energy, plastic_work;  // Pa, 1, J/kg, J/kg
};

/// Shears a particle at a constant rate [1/s] up to `angle`; the work of its stress heats it.
Sheared shear(Sph<3>& sim, double rate, double angle, int steps) {
  const double dt = sim.clock.dt = angle / rate / steps, rho = at(sim, Field::density);
  at(sim, Field::velocity_gradient, 1) = rate;
  double work = 0, before = 0;
  for (int k = 0; k < steps; ++k) {
    equation_of_state(sim);
    strain_rates(sim);
    const double stress = at(sim, Field::deviatoric_stress, 2);
    for (int c = 0; c < 5; ++c) at(sim, Field::deviatoric_stress, c) += dt * at(sim, Field::stress_rate, c);
    const double strain = at(sim, Field::plastic_strain);
    strength(sim);
    const double more = at(sim, Field::plastic_strain) - strain;
    double squares = 0;
    for (int c = 0; c < 5; ++c) squares += (c < 2 ? 0.5 : 1) * std::pow(at(sim, Field::deviatoric_stress, c), 2);
    const double zz = at(sim, Field::deviatoric_stress, 0) + at(sim, Field::deviatoric_stress, 1);
    const double equivalent = std::sqrt(3 * (squares + 0.5 * zz * zz));
    work += (more > 0 ? equivalent * more : 0) / rho;
    before = equivalent;
    at(sim, Field::specific_energy) += 0.5 * (stress + at(sim, Field::deviatoric_stress, 2)) * rate * dt / rho;
  }
  return {before, at(sim, Field::plastic_strain), at(sim, Field::specific_energy), work};
}

/// Copper by Johnson and Cook's law, sheared by 1 at 1e4/s. Once it flows, the plastic strain is the total one,
/// angle/sqrt(3), less the elastic one, Y/(3 G); its rate is rate/sqrt(3); the heat is the plastic work. The law at
/// that strain, rate and temperature is the stress, at every step size.
TEST(DrivenParticle, ObeysJohnsonAndCook) {
  for (const int steps : {500, 2000, 8000}) {
    const auto sim = one_particle("copper_ofhc_annealed");
    const auto& law = std::get<JohnsonCook>(*sim->materials[0].strength);
    const Sheared end = shear(*sim, 1e4, 1, steps);
    const double strain = 1 / std::sqrt(3.0) - end.equivalent / (3 * 47.7e9);
    EXPECT_NEAR(end.plastic_strain, strain, 1e-3 * strain) << steps;
    const double warmer = end.energy / 392.35;
    const double yield =
        law.yield({.plastic_strain = strain, .strain_rate = 1e4 / std::sqrt(3.0), .warmth = {warmer, 1490}});
    EXPECT_NEAR(end.equivalent, yield, 1e-3 * yield) << steps;
    const double elastic = end.equivalent * end.equivalent / (6 * 47.7e9 * 8930);
    EXPECT_NEAR(end.energy, end.plastic_work + elastic, 3e-3 * end.energy) << steps;
    EXPECT_GT(warmer, 40);
  }
}

/// Steel by Steinberg and Guinan's law: the same whatever the rate.
TEST(DrivenParticle, ObeysSteinbergAndGuinanAtAnyRate) {
  const Sheared slow = shear(*one_particle("steel_304"), 1e2, 1, 2000),
                fast = shear(*one_particle("steel_304"), 1e6, 1, 2000);
  EXPECT_NEAR(slow.equivalent, fast.equivalent, 1e-9 * slow.equivalent);
  const auto sim = one_particle("steel_304");
  const auto& law = std::get<SteinbergGuinan>(*sim->materials[0].strength);
  const double warmer = slow.energy / 450.62, pressure = 1.93 * 7900 * slow.energy;
  const double factor = law.shear_factor(pressure, 1, {warmer, 2080});
  const double strain = 1 / std::sqrt(3.0) - slow.equivalent / (3 * 77e9 * factor);
  EXPECT_NEAR(slow.plastic_strain, strain, 1e-3 * strain);
  const double yield = law.yield({.plastic_strain = strain, .shear_factor = factor});
  EXPECT_NEAR(slow.equivalent, yield, 1e-3 * yield);
}

}  // namespace
}  // namespace ejecta
