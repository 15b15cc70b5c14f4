#include "material/mie_grueneisen.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "material/eos.hpp"

namespace ejecta {
namespace {

constexpr MieGrueneisen steel{.rho0 = 7900,
                              .c0 = 4570,
                              .S1 = 1.49,
                              .gamma0 = 1.93,
                              .b = 0.5,
                              .heat_capacity = 450.62,
                              .melt_temperature = 2380,
                              .melt_exponent = 1.4};
constexpr MieGrueneisen copper{.rho0 = 8930,
                               .c0 = 3940,
                               .S1 = 1.489,
                               .gamma0 = 2.02,
                               .b = 0.47,
                               .heat_capacity = 392.35,
                               .melt_temperature = 1790,
                               .melt_exponent = 1.5};
constexpr MieGrueneisen lexan{.rho0 = 1196, .c0 = 1933, .S1 = 3.49, .S2 = -8.2, .S3 = 9.6, .gamma0 = 0.61};

/// Worked out by another program from the published form.
TEST(MieGrueneisen, ReproducesReferenceStates) {
  const auto expect = [](const MieGrueneisen& eos, double rho, double e, double pressure) {
    EXPECT_NEAR(eos.evaluate(rho, e).pressure, pressure, 1e-12 * std::abs(pressure)) << rho;
  };
  expect(steel, 9000, 2e5, 29621061778.38606);
  expect(steel, 7500, 1e5, -6829260000.0);
  expect(steel, 11000, 2e6, 130373134459.63245);
  expect(copper, 9500, 1e5, 11243408319.513435);
  expect(copper, 8500, 0, -6675148000.0);
  expect(lexan, 1500, 1e6, 3542733125.1760783);
  expect(lexan, 1700, 3e6, 8531022896.582722);
}

TEST(MieGrueneisen, DerivativesAgreeWithDifferences) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const MieGrueneisen& eos : {steel, copper, lexan}) {
    for (int state = 0; state < 100000;) {
      const double eta = 0.02 + 2 * uniform(random), rho = eta * eos.rho0, step = 1e-6;
      const double e = eos.c0 * eos.c0 * (uniform(random) - 0.1);
      const auto near = [&](double kink) { return std::abs(eta - kink) <= 2 * step; };
      if (near(1) || near(eos.eta_min) || near(eos.eta_max)) continue;
      ++state;
      const EosPoint p = eos.evaluate(rho, e);
      const double d_rho = step * eos.rho0, d_e = step * eos.c0 * eos.c0;
      const double by_rho =
          (eos.evaluate(rho + d_rho, e).pressure - eos.evaluate(rho - d_rho, e).pressure) / (2 * d_rho);
      const double by_e = (eos.evaluate(rho, e + d_e).pressure - eos.evaluate(rho, e - d_e).pressure) / (2 * d_e);
      ASSERT_NEAR(p.dP_drho, by_rho, 1e-7 * (eos.c0 * eos.c0 + std::abs(by_rho))) << eta << ' ' << e;
      ASSERT_NEAR(p.dP_de, by_e, 1e-7 * (eos.rho0 + std::abs(by_e))) << eta << ' ' << e;
    }
  }
}

/// Pressure at all joints; slopes where the form has none of its own: at eta_max, and cold at eta = 1.
TEST(MieGrueneisen, BranchesMeet) {
  const double step = 1e-10;
  for (const MieGrueneisen& eos : {steel, copper, lexan})
    for (const double e : {0.0, 1e5, 3e6})
      for (const double joint : {eos.eta_min, 1.0, eos.eta_max}) {
        const EosPoint below = eos.evaluate(joint * (1 - step) * eos.rho0, e);
        const EosPoint above = eos.evaluate(joint * (1 + step) * eos.rho0, e);
        const double stiffness = eos.rho0 * eos.c0 * eos.c0;
        EXPECT_NEAR(above.pressure, below.pressure, 1e-8 * stiffness) << joint << ' ' << e;
        if (joint == eos.eta_min) continue;
        EXPECT_NEAR(above.dP_de, below.dP_de, 1e-8 * eos.rho0) << joint;
        if (joint == eos.eta_max || e == 0) {
          EXPECT_NEAR(above.dP_drho, below.dP_drho, 1e-7 * below.dP_drho) << joint;
        }
      }
}

/// At the densities of nothing and of stars: finite, no less than the least sound speed, no tension left at no density.
TEST(MieGrueneisen, StaysFiniteOutsideItsRange) {
  for (const MieGrueneisen& eos : {steel, copper, lexan})
    for (const double e : {-1e5, 0.0, 1e5, 1e8})
      for (double eta = 1e-6; eta < 100; eta *= 1.01) {
        const double rho = eta * eos.rho0;
        const EosPoint p = eos.evaluate(rho, e);
        const double c = sound_speed(p, rho, eos.sound_speed_floor());
        ASSERT_TRUE(std::isfinite(p.pressure) && std::isfinite(p.dP_drho) && std::isfinite(p.dP_de)) << eta;
        ASSERT_TRUE(c >= 0.01 * eos.c0 && c < 1e6) << eta << ' ' << e << ' ' << c;
        if (eta > eos.eta_max && e >= 0) {
          ASSERT_GT(p.dP_drho, 0);
        }
      }
  EXPECT_LT(steel.evaluate(0.3 * 7900, 0).pressure, -1e9);
  EXPECT_EQ(steel.evaluate(0.24 * 7900, 0).pressure, 0) << "tension ends at half of eta_min";
  EXPECT_GT(steel.evaluate(1e-3 * 7900, 1e7).pressure, 0) << "heat presses however thin it is";
  EXPECT_EQ(sound_speed(steel.evaluate(3000, 0), 3000, steel.sound_speed_floor()), 45.7);
}

/// The jump conditions P = rho0 us up, rho = rho0 us/(us - up), e = up^2/2 give back the us(up) that went in: exactly,
/// whatever gamma0 and b.
TEST(MieGrueneisen, ItsHugoniotIsTheOneItIsMadeOf) {
  for (const MieGrueneisen& eos : {steel, copper, lexan})
    for (const double up : {1.0, 100.0, 250.0, 500.0, 1000.0}) {
      double low = up, high = 100 * eos.c0;  // excess falls with us
      for (int k = 0; k < 200; ++k) {
        const double us = 0.5 * (low + high), eta = us / (us - up);
        const bool behind =
            eta > eos.eta_max || eos.evaluate(eta * eos.rho0, up * up / 2).pressure > eos.rho0 * us * up;
        (behind ? low : high) = us;
      }
      const double slope = up / low;
      EXPECT_NEAR(low, eos.c0 + up * (eos.S1 + slope * (eos.S2 + slope * eos.S3)), 1e-8 * eos.c0) << up;
    }
}

struct Isentrope {
  double mu, energy, temperature, melting;  // J/kg, K, K
};

/// The isentrope from rest, integrated by another program (Runge-Kutta to 1e-12); Lindemann's law.
TEST(MieGrueneisen, TemperatureIsCountedFromTheIsentrope) {
  const auto check = [](const MieGrueneisen& eos, const std::vector<Isentrope>& points) {
    for (const Isentrope& p : points) {
      const double rho = (1 + p.mu) * eos.rho0, x = p.mu / (1 + p.mu);
      const double b = p.mu > 0 ? eos.b : 0, isentropic = 300 * std::exp((eos.gamma0 - b) * x + b * std::log1p(p.mu));
      const double allowed = 1e-3 * p.energy / eos.heat_capacity;
      EXPECT_NEAR(eos.temperature_rise(rho, p.energy), isentropic - 300, allowed) << p.mu;
      EXPECT_NEAR(eos.temperature_rise(rho, 2e5), p.temperature - 300, allowed) << p.mu;
      EXPECT_NEAR(eos.melting_rise(rho), p.melting - 300, 1e-9 * p.melting) << p.mu;
    }
  };
  check(steel, {{-0.1, 111818.96171595433, 437.78514090741714, 1672.8814750633487},
                {-0.02, 4234.954065905093, 722.8482379928616, 2230.021512594743},
                {0.05, 26082.34577702617, 715.0226771792499, 2772.153954490381},
                {0.1, 104194.22051254283, 570.9327900015899, 3187.1739432922896},
                {0.2, 415436.871237385, -61.01051151889902, 4077.484687015453},
                {0.3, 931592.4996042334, -1147.7399514408069, 5035.188404953635},
                {0.5, 2575554.230337605, -4679.9384390533405, 7098.736166890583}});
  check(copper, {{-0.1, 82842.92918885345, 538.2914569997197, 1233.1201861512286},
                 {0.1, 77420.32553954443, 673.6443583680556, 2436.409306399886},
                 {0.3, 691028.4893171643, -766.1971910462458, 3945.0934315817335}});
  EXPECT_EQ(steel.temperature_rise(7900, 0), 0);
  MieGrueneisen constant = steel;
  constant.melt_exponent = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(constant.melting_rise(10000), 2080);
}

/// Published fits of the energies at 0 K and at melting, polynomials in mu of rho0 e in Mbar (Spheral, test
/// ExpandingTube): an account of the temperature that owes nothing to the one under test. T = (e - e_cold)/c_v.
TEST(MieGrueneisen, TemperatureAgreesWithPublishedColdAndMeltingEnergies) {
  using Polynomial = std::array<double, 6>;
  const auto check = [](const MieGrueneisen& eos, const Polynomial& cold, const Polynomial& melt) {
    const auto energy = [&](const Polynomial& p, double mu) {
      double sum = 0;
      for (int k = 5; k >= 0; --k) sum = sum * mu + p[static_cast<std::size_t>(k)];
      return sum * 1e11 / eos.rho0;
    };
    for (double mu = -0.05; mu < 0.5; mu += 0.01) {
      const double rho = (1 + mu) * eos.rho0, allowed = mu < 0 ? 2 : 1 + 2e-3 * energy(cold, mu) / eos.heat_capacity;
      const double temperature = (1e6 - energy(cold, mu)) / eos.heat_capacity;
      EXPECT_NEAR(300 + eos.temperature_rise(rho, 1e6), temperature, allowed) << mu;
      const double melting = (energy(melt, mu) - energy(cold, mu)) / eos.heat_capacity;
      EXPECT_NEAR(300 + eos.melting_rise(rho), melting, 1) << mu;
    }
  };
  check(steel, {-0.0106797724, -0.020687202, 0.824893246, -0.0239505843, -0.0244522017, 0.0538030101},
        {0.0740464217, 0.249802214, 1.00445029, -0.136451475, 0.00772897829, 0.0506390305});
  check(copper, {-0.0105111874, -0.0213429672, 0.692768584, -0.0245626513, -0.0248677403, 0.0435373677},
        {0.0522055639, 0.190143176, 0.851351901, -0.112049022, -0.00611436674, 0.0436007831});
}

TEST(LinearEos, PressureAndSoundSpeed) {
  const LinearEos rubber{1010, 852}, warm{1010, 852, 0.5};
  const EosPoint p = rubber.evaluate(1.1 * 1010, 5e3);
  EXPECT_NEAR(p.pressure, 0.1 * 1010 * 852 * 852, 1e-6);
  EXPECT_EQ(sound_speed(p, 1.1 * 1010, 0), 852);
  EXPECT_EQ(p.dP_de, 0);
  EXPECT_NEAR(warm.evaluate(1010, 5e3).pressure, 0.5 * 1010 * 5e3, 1e-6);
  EXPECT_EQ(warm.evaluate(900, 5e3).dP_de, 0.5 * 1010);
  EXPECT_EQ(warmth(rubber, 1010, 1e6).rise, 0);
  EXPECT_EQ(reference_density(Eos{rubber}), 1010);
}

}  // namespace
}  // namespace ejecta
