/// Strength and damage in states picked at random, and flaws whose constants overflow.
#include <gtest/gtest.h>

#include <random>

#include "hard_cases/shipped_materials.hpp"
#include "hard_cases/small_runs.hpp"

namespace ejecta {
namespace {

/// Whatever the pressure, the damage and the stress: yield is finite and not negative, broken rock is never stronger
/// than intact rock, the deviator is never above yield after the return, and a second return finds nothing left to do.
TEST(Strength, NeverAboveYield) {
  std::vector<Strength> models{VonMises{3.5e9}, DruckerPrager{2e6, 0.6}, Lundborg{90e6, 2, 1.5e9},
                               Collins{{90e6, 2, 1.5e9}, 1e6, 0.8}};
  for (const Material& material : shipped_materials())
    if (material.strength) models.push_back(*material.strength);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const auto magnitude = [&] { return std::pow(10, 3 + 9 * uniform(random)); };
  for (const Strength& any : models)
    std::visit(
        [&](const auto& model) {
          for (int k = 0; k < 50000; ++k) {
            const double pressure = (uniform(random) < 0.5 ? -1 : 1) * magnitude(), damage = uniform(random);
            const double yield = model.yield({pressure, damage}), intact = model.yield({pressure, 0});
            ASSERT_TRUE(std::isfinite(yield) && yield >= 0) << pressure << ' ' << damage;
            ASSERT_LE(yield, intact * (1 + 1e-12)) << pressure << ' ' << damage;
            ASSERT_TRUE(model.intact_fraction(damage) >= 0 && model.intact_fraction(damage) <= 1);
            Deviator<3> s;
            const double size = magnitude();
            for (double& component : s) component = size * normal(random);
            const RadialReturn first = radial_return<3>(s, yield, 1e10);
            ASSERT_TRUE(first.scale >= 0 && first.scale <= 1 && first.plastic_strain >= 0);
            s *= first.scale;
            ASSERT_LE(equivalent_stress<3>(s), yield * (1 + 1e-15));
            const RadialReturn second = radial_return<3>(s, yield, 1e10);
            ASSERT_GE(second.scale, 1 - 1e-15);  // by how far the first may miss the yield stress
            ASSERT_LE(second.plastic_strain, 1e-15 * yield / 1e10);
          }
        },
        any);
}

/// Damage through a life of random stresses, crushing and cracking: it never heals and
/// stays within [0, 1], tension is never made larger, pressure is left alone, and cracks grow forwards or not at all.
TEST(Damage, NeverHealsAndStaysBelowOne) {
  const auto sim = start<3>(R"([scene]
name = "life"
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "rock"
material = "pumice"
shape = "box"
size = ["10 mm", "10 mm", "10 mm"]
)");
  auto& p = sim->particles;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  std::vector<double> before(p.size(), 0), crack(p.size(), 0), applied(p.size());
  sim->clock.dt = 5e-9;
  for (int life = 0; life < 200; ++life) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      applied[i] = p.column(Field::pressure)[i] = 1e7 * normal(random);
      for (int k = 0; k < 5; ++k) p.column(Field::deviatoric_stress, k)[i] = 1e6 * normal(random);
      p.column(Field::distension)[i] = std::max(1.0, p.column(Field::distension)[i] - 0.01 * uniform(random));
    }
    damage(*sim);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double now = p.column(Field::damage)[i], pressure = p.column(Field::pressure)[i];
      ASSERT_TRUE(now >= before[i] && now <= 1) << before[i] << " -> " << now;
      ASSERT_EQ(pressure, applied[i] < 0 ? (1 - now) * applied[i] : applied[i]);
      ASSERT_TRUE(sim->particles.column(Field::intact_share)[i] >= 0 &&
                  sim->particles.column(Field::intact_share)[i] <= 1);
      ASSERT_TRUE(p.column(Field::crack_length)[i] >= crack[i] && p.column(Field::crack_length)[i] <= 1);
      crack[i] = p.column(Field::crack_length)[i];
      before[i] = now;
    }
  }
  EXPECT_EQ(std::ranges::max(before), 1);
}

/// k = 1e61 per m^3, measured for basalt with m = 16, is beyond single precision and its product with a volume is near
/// that limit; k = 1e300 is where double ends. Only ln k is ever used: flaws open at the strain (n/(k V))^(1/m), the
/// same in both precisions. A 2D disc of 8 mm holds 1e61 x 2e-4: its weakest flaw opens at 2.6e-4.
TEST(Damage, FlawConstantsBeyondSinglePrecision) {
  const auto weakest = [](const char* k, const char* precision) {
    const auto sim = start<2>(R"([scene]
name = "disc"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "1 us"
[[bodies]]
name = "disc"
material = "basalt"
shape = "disc"
radius = "8 mm"
[materials.basalt.damage]
weibull_m = 16
)",
                              {std::string("materials.basalt.damage.weibull_k=") + k + " 1/m^3",
                               std::string("numerics.precision=") + precision});
    const Outcome outcome = follow(*sim);
    EXPECT_EQ(outcome.error, "");
    for (const double strain : sim->particles.column(Field::flaw_strain))
      EXPECT_TRUE(std::isfinite(strain) && strain > 0) << k;
    return std::ranges::min(sim->particles.column(Field::flaw_strain));
  };
  const double volume = 3.14159265 * 8e-3 * 8e-3;
  const double expected = std::exp(-(61 * std::log(10.0) + std::log(volume)) / 16);
  EXPECT_NEAR(weakest("1e61", "double"), expected, 0.2 * expected);
  EXPECT_EQ(weakest("1e61", "mixed"), weakest("1e61", "double"));
  EXPECT_NEAR(weakest("1e300", "double") / weakest("1e61", "double"), std::pow(10, -239.0 / 16), 1e-18);
  EXPECT_GT(weakest("1e-300", "double"), 1e18);
}

}  // namespace
}  // namespace ejecta
