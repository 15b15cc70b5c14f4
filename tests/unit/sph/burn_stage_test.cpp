#include <gtest/gtest.h>

#include <algorithm>

#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// A slab on a wall, lit along the wall: 200 particles. Without its detonator it burns where it is compressed.
const std::string slab = R"([scene]
name = "slab"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "10 us"
[[bodies]]
name = "slab"
material = "pbx_9501"
shape = "rectangle"
center = ["20 mm", 0]
size = ["40 mm", "5 mm"]
[boundary]
x_min = "symmetry"
y = "periodic"
min = [0, "-2.5 mm"]
max = [0, "2.5 mm"]
)";
const std::string lit_slab = slab + "[[detonators]]\nshape = \"plane\"\nposition = [0, 0]\nnormal = [1, 0]\n";

double quantity(const Sph<2>& sph, const std::string& name) {
  for (const Quantity& q : sph.quantities())
    if (q.name == name) return std::get<double>(q.value);
  ADD_FAILURE() << name;
  return 0;
}

TEST(BurnStage, BurnsByTheTimeOfLighting) {
  const auto sph = start<2>(lit_slab);
  const auto x = by_id(sph->particles, Field::position);
  std::vector<double> before(x.size(), 0);
  while (sph->clock.time < 2e-6) {
    step(*sph, no_limit);
    const auto burnt = by_id(sph->particles, Field::burnt), lit = by_id(sph->particles, Field::lighting_time);
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_NEAR(lit[i], x[i] / 8800, 1e-15);
      ASSERT_GE(burnt[i], before[i]);
      ASSERT_LE(burnt[i], 1);
      const double past = 8800 * (sph->clock.time - lit[i]);  // m
      ASSERT_TRUE(past <= 1.6e-3 || burnt[i] == 1) << x[i];
      ASSERT_TRUE(past >= -6e-3 || burnt[i] < 1e-3) << x[i];  // what the front presses ahead of itself
    }
    before = burnt;
  }
  const double mass = 40e-3 * 5e-3 * 1840, share = 8800 * sph->clock.time / 40e-3;
  EXPECT_NEAR(quantity(*sph, "burnt mass fraction"), share, 0.02);
  EXPECT_NEAR(quantity(*sph, "energy released"), quantity(*sph, "burnt mass fraction") * mass * 10.2e9 / 1840, 1);
  EXPECT_NEAR(sph->initial.internal, mass * 10.2e9 / 1840, 1e-9 * mass * 10.2e9 / 1840);
}

TEST(BurnStage, RestsUntilItIsLit) {
  const auto sph = start<2>(slab);
  advance(*sph, 20);
  EXPECT_EQ(std::ranges::max(by_id(sph->particles, Field::burnt)), 0);
  for (const double p : by_id(sph->particles, Field::pressure)) EXPECT_EQ(p, 0);
}

/// As far as it is compressed towards the state of Chapman & Jouguet, and what has burnt stays burnt.
TEST(BurnStage, BurnsByCompression) {
  const auto sph = start<2>(slab);
  const auto density = sph->particles.column(Field::density), burnt = sph->particles.column(Field::burnt);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = 1840 * (0.9 + 0.003 * static_cast<double>(i));
  burn(*sph);
  for (std::size_t i = 0; i < density.size(); ++i)
    EXPECT_NEAR(burnt[i], std::clamp((1 - 1840 / density[i]) / (1 - 0.7403), 0.0, 1.0), 1e-3);
  EXPECT_EQ(std::ranges::max(burnt), 1);
  const std::vector<double> before(burnt.begin(), burnt.end());
  std::ranges::fill(density, 1000);
  burn(*sph);
  EXPECT_TRUE(std::ranges::equal(burnt, before));
}

/// Products that leave a free end get fast and thin: no step collapses, no energy is lost, none falls below zero, and
/// nobody is faster than the products of a steady detonation that expand into a vacuum, 11.66 km/s (integrated by
/// another program along their isentrope).
TEST(BurnStage, ReleasesProductsToAVacuum) {
  const auto sph = start<2>(lit_slab);
  const double energy = sph->initial.internal;
  double shortest = 1;
  while (sph->clock.time < 20e-6) {
    shortest = std::min(shortest, step(*sph, no_limit).dt);
    const Totals now = sph->conserved();
    ASSERT_NEAR(now.internal + now.kinetic, energy, 1e-12 * energy);
  }
  EXPECT_GT(shortest, 30e-9);  // 0.4 h over 11 km/s is 47 ns
  EXPECT_GT(std::ranges::min(by_id(sph->particles, Field::specific_energy)), 0);
  const double fastest = std::ranges::max(by_id(sph->particles, Field::velocity));
  EXPECT_LT(fastest, 11656);
  EXPECT_GT(fastest, 6000);
  EXPECT_LT(std::ranges::min(by_id(sph->particles, Field::density)), 0.25 * 1840);
}

TEST(BurnStage, CostsNothingWithoutExplosives) {
  const auto gas = start<2>(gas_tube);
  EXPECT_FALSE(gas->particles.has(Field::burnt));
  EXPECT_FALSE(gas->particles.has(Field::lighting_time));
  for (const auto& stage : gas->stages) EXPECT_NE(stage.name, "burn");
}

}  // namespace
}  // namespace ejecta
