#include "material/strength.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace ejecta {
namespace {

constexpr double sqrt3 = std::numbers::sqrt3;

TEST(Strength, VonMisesIsConstantAndWeakenedByDamage) {
  const VonMises basalt{3.5e9};
  EXPECT_EQ(basalt.yield({-1e9, 0.5}), 3.5e9);
  EXPECT_DOUBLE_EQ(basalt.intact_fraction(0.3), 0.7);
}

/// Drucker-Prager's cone through the compressive edges of Mohr-Coulomb: a triaxial compression test with confinement
/// sigma_3 fails at sigma_1 = sigma_3 (1 + sin)/(1 - sin) + 2 c cos/(1 - sin).
TEST(Strength, DruckerPragerMatchesMohrCoulombInTriaxialCompression) {
  const double phi = 0.6, cohesion = 2e6;
  const DruckerPrager soil{cohesion, phi};
  for (const double confinement : {0.0, 1e6, 5e7}) {
    const double axial =
        confinement * (1 + std::sin(phi)) / (1 - std::sin(phi)) + 2 * cohesion * std::cos(phi) / (1 - std::sin(phi));
    const double pressure = (axial + 2 * confinement) / 3;
    EXPECT_NEAR(soil.yield({pressure, 0}), axial - confinement, 1e-9 * axial);
  }
  EXPECT_EQ(soil.yield({-1e9, 0}), 0);
  EXPECT_EQ(soil.yield({0, 1}), 0);
  EXPECT_GT(soil.yield({1e6, 1}), 0);
  EXPECT_EQ(soil.intact_fraction(0.5), 1);
}

TEST(Strength, LundborgRunsFromCohesionToItsLimit) {
  const Lundborg granite{90e6, 2.0, 1.5e9};
  EXPECT_DOUBLE_EQ(granite.yield({0, 0}), sqrt3 * 90e6);
  EXPECT_DOUBLE_EQ(granite.yield({-1e9, 0}), sqrt3 * 90e6);
  EXPECT_NEAR(granite.yield({1e16, 0}), sqrt3 * 1.5e9, 1e3);
  EXPECT_NEAR((granite.yield({1.0, 0}) - granite.yield({0, 0})) / sqrt3, 2.0, 1e-6);  // initial slope mu
  EXPECT_NEAR(granite.yield({705e6, 0}) / sqrt3, 90e6 + 705e6, 1);                    // half way where mu P = Y_max - c
  EXPECT_DOUBLE_EQ(granite.intact_fraction(0.25), 0.75);
}

TEST(Strength, CollinsBlendsIntactAndBrokenRock) {
  const Collins rock{{90e6, 2.0, 1.5e9}, 1e6, 0.8};
  EXPECT_DOUBLE_EQ(rock.yield({1e8, 0}), rock.intact.yield({1e8, 0}));
  EXPECT_DOUBLE_EQ(rock.yield({1e7, 1}), sqrt3 * (1e6 + 0.8e7));
  EXPECT_DOUBLE_EQ(rock.yield({-0.5e6, 1}), sqrt3 * 0.5e6);
  EXPECT_EQ(rock.yield({-1e6, 1}), 0);
  EXPECT_EQ(rock.yield({-1e9, 1}), 0);
  EXPECT_DOUBLE_EQ(rock.yield({1e11, 1}), rock.intact.yield({1e11, 0}));  // friction never beats intact rock
  EXPECT_NEAR(rock.yield({1e7, 0.25}), 0.75 * rock.yield({1e7, 0}) + 0.25 * rock.yield({1e7, 1}), 1e-6);
  EXPECT_EQ(rock.intact_fraction(1), 1);
}

TEST(Strength, CollinsRockBreaksByStrainTheLessTheLowerThePressure) {
  const Collins rock{{90e6, 2.0, 1.5e9}, 0, 0.8, 1.2e9, 2.4e9};
  EXPECT_DOUBLE_EQ(rock.failure_strain(-1e9), 0.01);
  EXPECT_DOUBLE_EQ(rock.failure_strain(0.6e9), 0.03);
  EXPECT_DOUBLE_EQ(rock.failure_strain(1.2e9), 0.05);
  EXPECT_DOUBLE_EQ(rock.failure_strain(1.8e9), 0.075);
  EXPECT_DOUBLE_EQ(rock.failure_strain(3e9), 1);
  EXPECT_TRUE(rock.breaks_in_shear());
  EXPECT_FALSE((Collins{{90e6, 2.0, 1.5e9}, 0, 0.8}.breaks_in_shear()));
}

TEST(Strength, MeltSoftens) {
  EXPECT_DOUBLE_EQ(melt_factor(0.85e6, 3.4e6), 0.75);
  EXPECT_EQ(melt_factor(-1e3, 3.4e6), 1);
  EXPECT_EQ(melt_factor(4e6, 3.4e6), 0);
  EXPECT_EQ(melt_factor(1e9, unset), 1);
}

template <int Dim>
void check_radial_return() {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0, 1e9);
  const double yield = 1e9, shear_modulus = 22.7e9;
  for (int k = 0; k < 10000; ++k) {
    Deviator<Dim> trial;
    for (double& component : trial) component = normal(random);
    const RadialReturn r = radial_return<Dim>(trial, yield, shear_modulus);
    const Deviator<Dim> s = r.scale * trial;
    // On the surface of the full tensor, with its zz component, or untouched inside it.
    const double q = std::sqrt(1.5) * full_tensor<Dim>(s).norm(),
                 q_trial = std::sqrt(1.5) * full_tensor<Dim>(trial).norm();
    EXPECT_NEAR(q, std::min(yield, q_trial), 1e-5);
    EXPECT_NEAR(3 * shear_modulus * r.plastic_strain, q_trial - q, 1e-4);
    // Plastic strain tensor (trial - s)/(2 G), its equivalent sqrt(2/3) |.|, and the work sigma : d(eps_p) = Y
    // d(eps_p).
    const Mat<3> plastic = (full_tensor<Dim>(trial) - full_tensor<Dim>(s)) / (2 * shear_modulus);
    EXPECT_NEAR(std::sqrt(2.0 / 3) * plastic.norm(), r.plastic_strain, 1e-14);
    EXPECT_NEAR((full_tensor<Dim>(s).cwiseProduct(plastic)).sum(), q * r.plastic_strain, 1e-5);
  }
  const Deviator<Dim> some = Deviator<Dim>::Constant(1e6), none = Deviator<Dim>::Zero();
  EXPECT_EQ(radial_return<Dim>(some, 0, shear_modulus).scale, 0);
  EXPECT_EQ(radial_return<Dim>(none, 0, shear_modulus).scale, 1);
}

TEST(RadialReturn, EndsOnTheYieldSurface) {
  check_radial_return<2>();
  check_radial_return<3>();
}

}  // namespace
}  // namespace ejecta
