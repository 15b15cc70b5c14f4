/// Matter that is pulled apart, heated through vaporisation, or vapour. One or two materials are followed closely in
/// tests/unit/material/eos_test.cpp; here is what must hold for all that are shipped.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hard_cases/shipped_materials.hpp"

namespace ejecta {
namespace {

/// Cold matter pulled apart resists up to a greatest tension and then lets go: P -> 0 as rho -> 0. The parabola
/// A mu + B mu^2 does so only for A = B. Beyond -A/B it would repel (A < B), and at zero density it would leave a
/// tension of A - B (A > B) whose P/rho^2, the pair force, grows without bound. Past the greatest tension c^2 < 0 by
/// the formula: the state is unstable in truth, and the floor keeps the sound speed real.
TEST(ExpandedStates, ColdMatterPulledApartLetsGo) {
  for_each_tillotson([](const std::string& name, const Tillotson& eos) {
    double tension = 0, previous = 0;
    bool letting_go = false;
    for (double eta = 1; eta >= 0.01; eta -= 1e-4) {
      const EosPoint p = eos.evaluate(eta * eos.rho0, 0);
      ASSERT_LE(p.pressure, 0) << name << ' ' << eta;
      ASSERT_TRUE(std::isfinite(sound_speed(p, eta * eos.rho0, eos.sound_speed_floor()))) << name << ' ' << eta;
      ASSERT_GE(sound_speed(p, eta * eos.rho0, eos.sound_speed_floor()), eos.sound_speed_floor()) << name << ' ' << eta;
      if (letting_go)
        ASSERT_GE(p.pressure, previous - 1e-9 * eos.A) << name << ": tension grows again at " << eta;
      else
        letting_go = p.pressure > previous;
      tension = std::max(tension, -p.pressure);
      previous = p.pressure;
    }
    EXPECT_LE(tension, 0.2501 * eos.A) << name;
    EXPECT_LT(-previous, 0.0101 * eos.A) << name << ": no zero pressure at zero density";
  });
}

/// Between E_iv and E_cv the pressure is a blend that changes fast: nylon has 0.4 MJ/kg to go from condensed to
/// expanded, and at (1000 kg/m^3, 2.2 MJ/kg) heating even lowers the pressure, dP/de = -16.3. No step of the pressure
/// is hidden in it: across rho0, E_iv, E_cv and e = 0 it is continuous to 1e-6 for every material.
TEST(ExpandedStates, TheMixedBandJoinsItsNeighboursWithoutAStep) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for_each_tillotson([&](const std::string& name, const Tillotson& eos) {
    constexpr double step = 1e-10;
    double largest = 0;
    const auto jump = [&](double rho1, double e1, double rho2, double e2) {
      const double p1 = eos.evaluate(rho1, e1).pressure, p2 = eos.evaluate(rho2, e2).pressure;
      largest = std::max(largest, std::abs(p1 - p2) / (std::abs(p1) + 0.01 * eos.A));
    };
    for (int k = 0; k < 20000; ++k) {
      const double rho = eos.rho0 * (0.01 + 1.49 * uniform(random)), e = 3 * eos.E_cv * uniform(random);
      jump(eos.rho0 * (1 - step), e, eos.rho0 * (1 + step), e);
      for (const double edge : {0.0, eos.E_iv, eos.E_cv})
        jump(rho, edge - step * eos.E_cv, rho, edge + step * eos.E_cv);
    }
    EXPECT_LT(largest, 1e-6) << name;
  });
}

TEST(ExpandedStates, NylonInTheMixedBandLosesPressureWhenHeated) {
  const Material nylon = read_material("nylon", {EJECTA_SOURCE_DIR "/inputs/materials"});
  const EosPoint p = std::get<Tillotson>(nylon.eos).evaluate(1000, 2.2e6);
  EXPECT_NEAR(p.dP_de, -16.3, 0.05);
  EXPECT_GT(sound_speed(p, 1000, 0), 1000);  // dP/drho more than makes up for it
}

/// Far beyond E_cv, or spread out far enough, only a rho e is left: P V = a m e, an ideal gas of gamma = 1 + a.
TEST(ExpandedStates, VapourIsAnIdealGas) {
  for_each_tillotson([](const std::string& name, const Tillotson& eos) {
    const IdealGas gas{1 + eos.a, eos.rho0};
    const auto check = [&](double rho, double e) {
      const EosPoint p = eos.evaluate(rho, e), ideal = gas.evaluate(rho, e);
      EXPECT_NEAR(p.pressure, ideal.pressure, 1e-9 * ideal.pressure) << name << ' ' << rho;
      EXPECT_NEAR(sound_speed(p, rho, 0), sound_speed(ideal, rho, 0), 1e-6 * sound_speed(ideal, rho, 0)) << name;
    };
    for (double rho = 0.1 * eos.rho0; rho > 1e-30; rho *= 0.1) check(rho, 200 * eos.E_cv);
    for (double e = eos.E_cv; e < 1e4 * eos.E_cv; e *= 2) check(1e-3 * eos.rho0, e);
  });
}

/// State of what has reacted as far as it can.
template <class EosT>
EosPoint burnt(const EosT& eos, double rho, double e) {
  if constexpr (reacts<EosT>)
    return eos.evaluate(rho, e, 1);
  else
    return eos.evaluate(rho, e);
}

/// A particle may come into any state: 1e-4 to 10 times its reference density, up to 1 GJ/kg. Pressure, derivatives and
/// sound speed are finite there. Compressed matter has c^2 > 0 by the formula. Expanded matter may be unstable (c^2 <
/// 0) even under pressure, where liquid and vapour would separate; the floor of the sound speed is all it needs.
TEST(ExpandedStates, AnyStateHasAFinitePressureAndARealSoundSpeed) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Material& material : shipped_materials()) {
    std::visit(
        [&](const auto& eos) {
          for (int k = 0; k < 200000; ++k) {
            const double rho = eos.reference_density() * std::pow(10, -4 + 5 * uniform(random));
            const double e = k % 2 ? 1e9 * uniform(random) : std::pow(10, 9 * uniform(random));
            const EosPoint p = burnt(eos, rho, e);
            ASSERT_TRUE(std::isfinite(p.pressure) && std::isfinite(p.dP_drho) && std::isfinite(p.dP_de))
                << material.name << ' ' << rho << ' ' << e;
            const double c = sound_speed(p, rho, eos.sound_speed_floor());
            ASSERT_TRUE(std::isfinite(c) && c > 0) << material.name << ' ' << rho << ' ' << e;
            if (rho < eos.reference_density()) continue;
            ASSERT_GT(p.pressure, 0) << material.name << ' ' << rho << ' ' << e;
            ASSERT_GT(c, 10 * eos.sound_speed_floor()) << material.name << ' ' << rho << ' ' << e;
          }
        },
        material.eos);
  }
}

}  // namespace
}  // namespace ejecta
