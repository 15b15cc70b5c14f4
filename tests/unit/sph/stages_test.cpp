#include "sph/stages.hpp"

#include <gtest/gtest.h>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

using enum Field;

template <int Dim>
std::vector<std::string> names(const std::vector<Stage<Dim>>& stages) {
  std::vector<std::string> list;
  for (const auto& stage : stages) list.push_back(stage.name);
  return list;
}

/// Bytes per particle of columns, pair lists and pair records.
template <int Dim>
double bytes_per_particle(const Sph<Dim>& sim) {
  return static_cast<double>(sim.bytes()) / static_cast<double>(sim.particles.size());
}

TEST(Stages, AGasHasNothingOfASolid) {
  const auto sim = start<2>(gas_tube);
  EXPECT_EQ(names(sim->stages), (std::vector<std::string>{"neighbours", "density", "equation of state", "pair rates"}));
  EXPECT_EQ(sim->particles.fields(),
            (std::vector<Field>{position, velocity, acceleration, mass, density, specific_energy, specific_energy_rate,
                                pressure, sound_speed, smoothing_length, zeroth_moment, largest_mu}));
}

TEST(Stages, RiemannProblemsNeedSlopesButForTheFirstOrder) {
  const std::vector<std::string> plain{"neighbours", "density", "equation of state", "pair rates"},
      with_slopes{"neighbours", "density", "equation of state", "slopes", "pair rates"};
  const auto list_of = [](std::vector<std::string> overrides) {
    overrides.push_back("numerics.scheme=gsph");
    return names(start<2>(gas_tube, overrides)->stages);
  };
  EXPECT_EQ(list_of({}), with_slopes);
  EXPECT_EQ(list_of({"numerics.limiter=none"}), with_slopes);
  EXPECT_EQ(list_of({"numerics.faces=kernel"}), with_slopes);
  EXPECT_EQ(list_of({"numerics.limiter=none", "numerics.faces=kernel"}), plain);
  const auto sim = start<2>(gas_tube, {"numerics.scheme=gsph"});
  for (const Field f : {density_gradient, pressure_gradient, velocity_gradient, face_correction})
    EXPECT_TRUE(sim->particles.has(f)) << info(f).name;
  EXPECT_FALSE(start<2>(gas_tube)->particles.has(density_gradient));
}

TEST(Stages, PorousRockHasAllItsOwn) {
  const auto sim = start<3>(porous_impact);
  EXPECT_EQ(names(sim->stages),
            (std::vector<std::string>{"neighbours", "equation of state", "strength", "damage", "pair rates",
                                      "strain rates", "viscosity switches", "smoothing lengths"}));
  for (const Field f :
       {deviatoric_stress, stress_rate, plastic_strain, distension, stress_factor, Field::damage, crack_length,
        local_strain, flaw_strain, velocity_gradient, compression_rate, Field::shock_switch})
    EXPECT_TRUE(sim->particles.has(f)) << info(f).name;
  for (const Field f : {bond, start_position, stretch, viscosity_factor})
    EXPECT_FALSE(sim->particles.has(f)) << info(f).name;
  EXPECT_FALSE(sim->particles.has(flaw_count));
  EXPECT_TRUE(start<3>(porous_impact, {"materials.pumice.damage.growth=benz_asphaug"})->particles.has(flaw_count));
}

TEST(Stages, EachIsThereOnlyOnRequest) {
  const auto list_of = [](const std::vector<std::string>& overrides) {
    return names(start<2>(gas_tube, overrides)->stages);
  };
  for (const char* key : {"numerics.balsara=true", "numerics.shock_switch=true"})
    EXPECT_EQ(list_of({key}), (std::vector<std::string>{"neighbours", "density", "equation of state", "pair rates",
                                                        "viscosity switches"}));
  EXPECT_EQ(
      list_of({"numerics.density=continuity"}),
      (std::vector<std::string>{"neighbours", "equation of state", "pair rates", "strain rates", "smoothing lengths"}));
  EXPECT_EQ(list_of({"numerics.density=continuity", "numerics.smoothing_growth=1"}),
            (std::vector<std::string>{"neighbours", "equation of state", "pair rates", "strain rates"}));
}

TEST(Stages, AMaterialWithoutPoresOrDamageHasNoSuchColumns) {
  const auto sim =
      start<3>(porous_impact, {"materials.pumice.porosity.model=none", "materials.pumice.damage.model=none"});
  for (const Field f : {distension, stress_factor, Field::damage, crack_length, local_strain, flaw_strain})
    EXPECT_FALSE(sim->particles.has(f)) << info(f).name;
  EXPECT_TRUE(sim->particles.has(deviatoric_stress));
}

TEST(Stages, EveryColumnIsNamedByAStage) {
  const auto sim = start<3>(porous_impact);
  const std::vector<Field> named = fields_of(sim->stages);
  EXPECT_EQ(named, sim->particles.fields());
}

TEST(Stages, MemoryPerParticleStaysSmall) {
  // At sizes where surfaces count little. Of the rock's, 506 are columns, 297 the records of the pair pass, 117 those
  // of contact between pieces, 176 the sums over the surroundings, and the rest mostly candidate lists, which are
  // longer for clusters of four (AVX2) than of eight.
  const auto rock = start<3>(porous_impact, {"resolution.spacing=2.2 mm"});
  const auto gas = start<2>(gas_tube, {"resolution.spacing=6.25 mm"});
  advance(*rock, 3);
  advance(*gas, 3);
  RecordProperty("rock_bytes", std::to_string(bytes_per_particle(*rock)));
  RecordProperty("gas_bytes", std::to_string(bytes_per_particle(*gas)));
  EXPECT_LT(bytes_per_particle(*rock), 1550) << rock->particles.size() << " particles";
  EXPECT_LT(bytes_per_particle(*gas), 600) << gas->particles.size() << " particles";
}

}  // namespace
}  // namespace ejecta
