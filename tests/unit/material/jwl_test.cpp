#include "material/jwl.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "material/eos.hpp"

namespace ejecta {
namespace {

constexpr Jwl tnt{.rho0 = 1630,
                  .A = 371.2e9,
                  .B = 3.231e9,
                  .R1 = 4.15,
                  .R2 = 0.95,
                  .omega = 0.30,
                  .E0 = 7.0e9,
                  .detonation_speed = 6930};
constexpr Jwl pbx_9501{.rho0 = 1840,
                       .A = 852.4e9,
                       .B = 18.02e9,
                       .R1 = 4.6,
                       .R2 = 1.3,
                       .omega = 0.38,
                       .E0 = 10.2e9,
                       .detonation_speed = 8800};

/// Worked out by another program: the state of Chapman & Jouguet, and pressure and energy on the isentrope through it.
TEST(Jwl, ReproducesReferenceStates) {
  const auto expect_cj = [](const Jwl& eos, double volume, double pressure, double speed) {
    const ChapmanJouguet cj = eos.chapman_jouguet();
    EXPECT_NEAR(cj.volume, volume, 1e-4);
    EXPECT_NEAR(cj.pressure, pressure, 0.005e9);
    EXPECT_NEAR(cj.speed, speed, 1);
    EXPECT_NEAR(cj.velocity, speed * (1 - volume), 1);
  };
  expect_cj(tnt, 0.7317, 21.00e9, 6929);
  expect_cj(pbx_9501, 0.7403, 37.00e9, 8800);
  const auto expect = [](const Jwl& eos, double V, double E, double pressure) {
    EXPECT_NEAR(eos.evaluate(eos.rho0 / V, E / eos.rho0, 1).pressure, pressure, 1e-3 * pressure) << V;
  };
  expect(tnt, 0.7317, 9.817e9, 21.00e9);
  expect(tnt, 2.2, 3.1806e9, 0.81489e9);
  expect(tnt, 50, 1.0775e9, 0.0064647e9);
  expect(pbx_9501, 1, 8.8153e9, 14.686e9);
  expect(pbx_9501, 7, 1.5172e9, 0.08429e9);
}

/// Products that leave a steady detonation do so at their speed of sound: u + c = D.
TEST(Jwl, DetonationIsSonic) {
  for (const Jwl& eos : {tnt, pbx_9501}) {
    const ChapmanJouguet cj = eos.chapman_jouguet();
    const double rho = eos.rho0 / cj.volume;
    const double e = (eos.E0 + 0.5 * cj.pressure * (1 - cj.volume)) / eos.rho0;
    const EosPoint state = eos.evaluate(rho, e, 1);
    EXPECT_NEAR(state.pressure, cj.pressure, 1e-9 * cj.pressure);
    EXPECT_NEAR(cj.velocity + sound_speed(state, rho, 0), cj.speed, 1e-6 * cj.speed);
  }
}

TEST(Jwl, DerivativesAgreeWithDifferences) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Jwl& eos : {tnt, pbx_9501})
    for (int k = 0; k < 10000; ++k) {
      const double rho = eos.rho0 * (0.01 + 1.6 * uniform(random)),
                   e = eos.energy_at_rest() * (0.2 + 2 * uniform(random));
      const EosPoint p = eos.evaluate(rho, e, 1);
      const double d_rho = 1e-5 * rho, d_e = 1e-5 * e;
      ASSERT_NEAR((eos.evaluate(rho + d_rho, e, 1).pressure - eos.evaluate(rho - d_rho, e, 1).pressure) / (2 * d_rho),
                  p.dP_drho, 1e-6 * (std::abs(p.dP_drho) + p.pressure / rho));
      ASSERT_NEAR((eos.evaluate(rho, e + d_e, 1).pressure - eos.evaluate(rho, e - d_e, 1).pressure) / (2 * d_e),
                  p.dP_de, 1e-6 * p.dP_de);
    }
}

/// However dense: along the tangent, without a jump of pressure or slope, and stable.
TEST(Jwl, GoesOnBeyondItsForm) {
  for (const Jwl& eos : {tnt, pbx_9501}) {
    const double edge = eos.rho0 / Jwl::densest, e = eos.energy_at_rest();
    const EosPoint before = eos.evaluate(edge * (1 - 1e-9), e, 1), after = eos.evaluate(edge * (1 + 1e-9), e, 1);
    EXPECT_NEAR(after.pressure, before.pressure, 1e-7 * before.pressure);
    EXPECT_NEAR(after.dP_drho, before.dP_drho, 1e-7 * before.dP_drho);
    for (double rho = eos.rho0; rho < 20 * eos.rho0; rho *= 1.1) EXPECT_GT(eos.evaluate(rho, 0, 1).dP_drho, 0);
    const EosPoint far = eos.evaluate(10 * eos.rho0, e, 1);
    EXPECT_NEAR(far.pressure, after.pressure + after.dP_drho * (10 * eos.rho0 - edge), 1e-7 * far.pressure);
  }
}

TEST(Jwl, PressureGrowsWithWhatHasBurntAndNothingPulls) {
  const double rho = pbx_9501.rho0, e = pbx_9501.energy_at_rest();
  const EosPoint whole = pbx_9501.evaluate(rho, e, 1);
  EXPECT_EQ(pbx_9501.evaluate(rho, e).pressure, 0);
  EXPECT_DOUBLE_EQ(pbx_9501.evaluate(rho, e, 0.25).pressure, 0.25 * whole.pressure);
  EXPECT_EQ(pbx_9501.evaluate(rho, e, 0.25).dP_drho, whole.dP_drho);
  // Colder than the isentrope by far, where A and B alone would pull.
  const EosPoint cold = pbx_9501.evaluate(0.5 * rho, -2 * e, 1);
  EXPECT_EQ(cold.pressure, 0);
  EXPECT_EQ(sound_speed(cold, 0.5 * rho, pbx_9501.sound_speed_floor()), 88);
}

TEST(Jwl, SaysWhatABurnAsks) {
  const auto explosive = explosive_of(Eos{pbx_9501});
  ASSERT_TRUE(explosive);
  EXPECT_EQ(explosive->detonation_speed, 8800);
  EXPECT_NEAR(explosive->cj_compression, 1 - 0.7403, 1e-4);
  EXPECT_DOUBLE_EQ(explosive->energy, 10.2e9 / 1840);
  EXPECT_DOUBLE_EQ(energy_at_rest(Eos{pbx_9501}), 10.2e9 / 1840);
  EXPECT_FALSE(explosive_of(Eos{IdealGas{1.4, 1.2}}));
  EXPECT_EQ(energy_at_rest(Eos{IdealGas{1.4, 1.2}}), 0);
  EXPECT_TRUE(is_gas(Eos{pbx_9501}));
  static_assert(reacts<Jwl>);
}

}  // namespace
}  // namespace ejecta
