#include "material/eos.hpp"

#include <gtest/gtest.h>

#include <random>

namespace ejecta {
namespace {

constexpr Tillotson basalt{2700, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5};
constexpr Tillotson nylon{1185, 0.6, 2.0, 10.1e9, 33.8e9, 7e6, 2e6, 2.4e6, 10, 5};
constexpr Tillotson iron{7800, 0.5, 1.5, 128e9, 105e9, 9.5e6, 2.4e6, 8.67e6, 5, 5};

struct Vector {
  double rho, e, pressure, dP_drho, dP_de, c2;
};

/// Independently computed states: pressure to all digits given, derivatives (finite differences there) to six.
TEST(Tillotson, ReproducesReferenceStates) {
  const Vector states[] = {{2700, 0, 0, 9.88889e6, 5400, 9.88889e6},
                           {2700, 1e6, 5.3917008e9, 1.1892e7, 5383.42, 1.58735e7},
                           {3000, 0, 3.2962963e9, 1.20864e7, 6000, 1.4284e7},
                           {3000, 5e6, 3.3110725e10, 2.21473e7, 5926.08, 4.39491e7},
                           {4000, 2e7, 1.7684113e11, 5.99423e7, 7781.61, 1.45949e8},
                           {2600, 0, -9.5226337e8, 9.15638e6, 5200, 8.42387e6},
                           {2600, 1e6, 4.2391196e9, 1.11597e7, 5182.79, 1.44097e7},
                           {2500, 5e6, 2.2946091e10, 1.85259e7, 4906.69, 3.65402e7},
                           {2000, 1e7, 3.0355527e10, 3.40206e7, 2636.89, 5.40317e7},
                           {1500, 2e7, 1.6610031e10, 2.67433e7, 821.439, 3.28073e7},
                           {500, 3e7, 7.5e9, 1.5e7, 250, 2.25e7},
                           {10, 5e7, 2.5e8, 2.5e7, 5, 3.75e7}};
  for (const Vector& v : states) {
    const EosPoint p = basalt.evaluate(v.rho, v.e);
    EXPECT_NEAR(p.pressure, v.pressure, 2e-8 * std::abs(v.pressure)) << v.rho << ' ' << v.e;
    EXPECT_NEAR(p.dP_drho, v.dP_drho, 5e-6 * v.dP_drho) << v.rho << ' ' << v.e;
    EXPECT_NEAR(p.dP_de, v.dP_de, 5e-6 * v.dP_de) << v.rho << ' ' << v.e;
    EXPECT_NEAR(std::pow(sound_speed(p, v.rho, 0), 2), v.c2, 5e-6 * v.c2) << v.rho << ' ' << v.e;
  }
  EXPECT_NEAR(nylon.evaluate(1100, 1e6).pressure, 1.9965702e9, 50);
  EXPECT_NEAR(nylon.evaluate(1000, 2.2e6).pressure, 3.3318422e9, 50);
  EXPECT_NEAR(nylon.evaluate(1000, 2.2e6).dP_de, -16.3, 0.05);
  EXPECT_NEAR(nylon.evaluate(800, 3e6).pressure, 1.6548921e9, 50);
  EXPECT_NEAR(nylon.evaluate(100, 5e6).pressure, 3.0e8, 1);
}

TEST(Tillotson, DerivativesAgreeWithDifferences) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Tillotson& eos : {basalt, nylon, iron}) {
    int states = 0;
    while (states < 100000) {
      const double eta = 0.02 + 2 * uniform(random), rho = eta * eos.rho0;
      const double e = 2 * eos.E_cv * uniform(random) - 1e4;
      const double d_rho = 1e-5 * rho, d_e = 1e-5 * eos.E_cv;
      const auto near = [&](double value, double kink, double width) { return std::abs(value - kink) <= 2 * width; };
      const double mu = eta - 1;
      if (near(rho, eos.rho0, d_rho) || near(e, eos.E_iv, d_e) || near(e, eos.E_cv, d_e) || near(e, 0, d_e) ||
          near(mu, -eos.A / eos.B, 1e-5))
        continue;
      ++states;
      const EosPoint p = eos.evaluate(rho, e);
      const double by_rho =
          (eos.evaluate(rho + d_rho, e).pressure - eos.evaluate(rho - d_rho, e).pressure) / (2 * d_rho);
      const double by_e = (eos.evaluate(rho, e + d_e).pressure - eos.evaluate(rho, e - d_e).pressure) / (2 * d_e);
      const double scale = eos.A / eos.rho0 + std::abs(p.dP_drho);
      ASSERT_NEAR(p.dP_drho, by_rho, 1e-5 * scale) << rho << ' ' << e;
      ASSERT_NEAR(p.dP_de, by_e, 1e-5 * (rho + std::abs(by_e))) << rho << ' ' << e;
    }
  }
}

TEST(Tillotson, PressureIsContinuousAcrossBranches) {
  for (const Tillotson& eos : {basalt, nylon, iron}) {
    const double step = 1e-9;
    for (double e = 0; e < 3 * eos.E_cv; e += 0.01 * eos.E_cv) {
      const double below = eos.evaluate(eos.rho0 * (1 - step), e).pressure;
      const double above = eos.evaluate(eos.rho0 * (1 + step), e).pressure;
      EXPECT_NEAR(above, below, 1e-6 * (eos.A + above)) << e;
    }
    for (double eta = 0.01; eta < 1.5; eta += 0.01)
      for (const double edge : {eos.E_iv, eos.E_cv, 0.0}) {
        const double below = eos.evaluate(eta * eos.rho0, edge - step * eos.E_cv).pressure;
        const double above = eos.evaluate(eta * eos.rho0, edge + step * eos.E_cv).pressure;
        EXPECT_NEAR(above, below, 1e-6 * (0.01 * eos.A + std::abs(below))) << eta << ' ' << edge;
      }
    const double kink = eos.rho0 * (1 - eos.A / eos.B);
    if (kink > 0) {
      EXPECT_NEAR(eos.evaluate(kink * (1 + step), 0).pressure, eos.evaluate(kink * (1 - step), 0).pressure,
                  1e-6 * eos.A);
    }
  }
}

TEST(Tillotson, ColdExpansionStaysFiniteAndNeverRepels) {
  for (const Tillotson& eos : {basalt, nylon, iron})
    for (const double e : {-1e5, 0.0, 1e3})
      for (double eta = 1; eta > 1e-6; eta *= 0.99) {
        const EosPoint p = eos.evaluate(eta * eos.rho0, e);
        const double c = sound_speed(p, eta * eos.rho0, eos.sound_speed_floor());
        ASSERT_TRUE(std::isfinite(p.pressure) && std::isfinite(p.dP_drho) && std::isfinite(p.dP_de)) << eta;
        ASSERT_GE(c, eos.sound_speed_floor());
        if (e <= 0) {
          ASSERT_LE(p.pressure, 0) << eta;
        }
      }
  // Tension of basalt has its greatest value A/4 at mu = -1/2 and is gone at great distance.
  EXPECT_NEAR(basalt.evaluate(1350, 0).pressure, -26.7e9 / 4, 1);
  EXPECT_LT(std::abs(basalt.evaluate(0.01 * 2700, 0).pressure), 0.011 * 26.7e9);
  EXPECT_EQ(nylon.evaluate(0.5 * 1185, 0).pressure, 0);
  EXPECT_EQ(sound_speed(basalt.evaluate(1200, 0), 1200, basalt.sound_speed_floor()), basalt.sound_speed_floor());
}

TEST(Tillotson, VapourIsAnIdealGas) {
  for (const double rho : {1e-30, 1e-9, 1.0, 100.0}) {
    const double e = 200 * basalt.E_cv;
    const EosPoint p = basalt.evaluate(rho, e), gas = IdealGas{1.5, 1}.evaluate(rho, e);
    EXPECT_NEAR(p.pressure, gas.pressure, 1e-12 * gas.pressure);
    EXPECT_NEAR(sound_speed(p, rho, 0), sound_speed(gas, rho, 0), 1e-9 * sound_speed(gas, rho, 0));
  }
}

TEST(IdealGas, PressureEnergyAndSoundSpeed) {
  const IdealGas air{1.4, 1.2};
  EXPECT_DOUBLE_EQ(air.evaluate(1, 2.5).pressure, 1);
  EXPECT_DOUBLE_EQ(air.specific_energy(0.125, 0.1), 2);
  EXPECT_DOUBLE_EQ(air.evaluate(0.3, air.specific_energy(0.3, 17.0)).pressure, 17.0);
  EXPECT_NEAR(sound_speed(air.evaluate(1, 2.5), 1, air.sound_speed_floor()), std::sqrt(1.4), 1e-15);
  EXPECT_EQ(sound_speed(air.evaluate(1, 0), 1, air.sound_speed_floor()), 0);
  EXPECT_EQ(reference_density(Eos{air}), 1.2);
  EXPECT_EQ(reference_density(Eos{basalt}), 2700);
}

TEST(Eos, SaysWhatItCanDo) {
  const IdealGas air{1.4, 1.2};
  EXPECT_TRUE(is_gas(air));
  EXPECT_FALSE(is_gas(basalt));
  EXPECT_EQ(specific_energy_at(air, 0.3, 17.0), air.specific_energy(0.3, 17.0));
  EXPECT_EQ(specific_energy_at(basalt, 2700, 17.0), std::nullopt);
  EXPECT_TRUE(has_temperature(MieGrueneisen{}));
  EXPECT_FALSE(has_temperature(air));
}

}  // namespace
}  // namespace ejecta
