#include "material/air_chemistry.hpp"

#include <gtest/gtest.h>

#include "log_uniform.hpp"

namespace ejecta {
namespace {

/// Two particles a molecule where all have broken up, sixteen and more where nothing but nuclei is left.
TEST(AirChemistry, CountsItsParticles) {
  const double boltzmann = 1.380649e-23, molecule = 1.66053906660e-27 * (0.79 * 28.014 + 0.21 * 31.998);
  const auto per_molecule = [&](double rho, double t) {
    return air_in_equilibrium(rho, t).pressure * molecule / (rho * boltzmann * t);
  };
  EXPECT_NEAR(per_molecule(1.2, 300), 1, 1e-12);
  EXPECT_NEAR(per_molecule(1.2, 1000), 1, 1e-6);
  EXPECT_NEAR(per_molecule(1e-3, 3500), 1.21, 0.015);  // oxygen has broken up, or is in NO; nitrogen has not
  EXPECT_NEAR(per_molecule(1e-3, 7500), 2, 0.02);
  EXPECT_NEAR(per_molecule(1e-3, 1e8), 2 * (0.79 * 8 + 0.21 * 9), 1e-3);
}

/// The two ways of working out cold air meet where one hands over to the other.
TEST(AirChemistry, NothingHappensAt600Kelvin) {
  for (const double rho : {1e-6, 1e-3, 1.0, 1e3}) {
    const AirState below = air_in_equilibrium(rho, 600 * (1 - 1e-12)), above = air_in_equilibrium(rho, 600);
    EXPECT_NEAR(below.pressure, above.pressure, 1e-9 * above.pressure) << rho;
    EXPECT_NEAR(below.specific_energy, above.specific_energy, 1e-6 * above.specific_energy) << rho;
  }
}

/// What follows from entropy being a function of state: de/dv = T dP/dT - P at constant T and v. Every particle must
/// carry the energy that its equilibrium was worked out with.
TEST(AirChemistry, EnergyAndPressureAreOfOneFreeEnergy) {
  LogUniform between;
  for (int k = 0; k < 5000; ++k) {
    const double rho = between(1e-6, 1e4), t = between(700, 3e7), step = 1e-4;
    const AirState here = air_in_equilibrium(rho, t);
    const double by_volume = (air_in_equilibrium(rho / (1 + step), t).specific_energy -
                              air_in_equilibrium(rho / (1 - step), t).specific_energy) *
                             rho / (2 * step);
    const double by_temperature =
        (air_in_equilibrium(rho, t * (1 + step)).pressure - air_in_equilibrium(rho, t * (1 - step)).pressure) /
        (2 * step);
    ASSERT_NEAR(by_volume, by_temperature - here.pressure, 1e-5 * by_temperature) << rho << ' ' << t;
  }
}

}  // namespace
}  // namespace ejecta
