#include "material/exact_riemann.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ejecta {
namespace {

struct Tube {
  GasState left, right;
  double pressure, velocity, density_left, density_right;
  double digit_p, digit_u;  ///< half of the last digit printed; more in the last tube, whose sides are rounded too
};

/// Toro 2009, tables 4.2 and 4.3, gamma = 1.4.
constexpr Tube tubes[] = {
    {{1, 0, 1}, {0.125, 0, 0.1}, 0.30313, 0.92745, 0.42632, 0.26557, 5e-6, 5e-6},
    {{1, -2, 0.4}, {1, 2, 0.4}, 0.00189, 0, 0.02185, 0.02185, 5e-6, 5e-6},
    {{1, 0, 1000}, {1, 0, 0.01}, 460.894, 19.5975, 0.57506, 5.99924, 5e-4, 5e-5},
    {{1, 0, 0.01}, {1, 0, 100}, 46.0950, -6.19633, 5.99242, 0.57511, 5e-5, 5e-6},
    {{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 1691.64, 8.68975, 14.2823, 31.0426, 1e-2, 3e-5}};

TEST(ExactRiemann, StarStatesAreThoseOfToro) {
  for (const Tube& tube : tubes) {
    const ExactRiemann exact(tube.left, tube.right, 1.4);
    ASSERT_FALSE(exact.vacuum());
    EXPECT_NEAR(exact.star_pressure(), tube.pressure, tube.digit_p);
    EXPECT_NEAR(exact.star_velocity(), tube.velocity, tube.digit_u);
    EXPECT_NEAR(exact.star_density_left(), tube.density_left, 6e-6 * std::max(1.0, 10 * tube.density_left));
    EXPECT_NEAR(exact.star_density_right(), tube.density_right, 6e-6 * std::max(1.0, 10 * tube.density_right));
  }
}

/// Beyond the waves nothing has happened; beside the contact are the star states; fluxes across a shock balance.
TEST(ExactRiemann, StatesBetweenTheWaves) {
  const Tube& sod = tubes[0];
  const ExactRiemann exact(sod.left, sod.right, 1.4);
  EXPECT_EQ(exact.at(-2).density, 1);
  EXPECT_EQ(exact.at(2).density, 0.125);
  EXPECT_EQ(exact.at(exact.star_velocity() - 1e-9).density, exact.star_density_left());
  EXPECT_EQ(exact.at(exact.star_velocity() + 1e-9).density, exact.star_density_right());
  const double shock = 1.75216;
  EXPECT_EQ(exact.at(shock - 1e-4).density, exact.star_density_right());
  EXPECT_EQ(exact.at(shock + 1e-4).density, 0.125);
  const GasState behind = exact.at(shock - 1e-4);
  EXPECT_NEAR(behind.density * (shock - behind.velocity), 0.125 * shock, 1e-5);
  // In the fan u + 2 c / (gamma - 1) and p / rho^gamma are those of the left side, and u - c is the speed.
  const GasState fan = exact.at(-0.5);
  const double sound = std::sqrt(1.4 * fan.pressure / fan.density);
  EXPECT_NEAR(fan.velocity - sound, -0.5, 1e-12);
  EXPECT_NEAR(fan.velocity + 5 * sound, 5 * std::sqrt(1.4), 1e-12);
  EXPECT_NEAR(fan.pressure / std::pow(fan.density, 1.4), 1, 1e-12);
}

TEST(ExactRiemann, MirrorImage) {
  for (const Tube& tube : tubes) {
    const GasState left{tube.right.density, -tube.right.velocity, tube.right.pressure};
    const GasState right{tube.left.density, -tube.left.velocity, tube.left.pressure};
    const ExactRiemann exact(tube.left, tube.right, 1.4), mirrored(left, right, 1.4);
    for (const double speed : {-30.0, -3.0, -0.7, 0.3, 2.0, 10.0}) {
      EXPECT_NEAR(exact.at(speed).density, mirrored.at(-speed).density, 1e-9 * exact.at(speed).density);
      EXPECT_NEAR(exact.at(speed).velocity, -mirrored.at(-speed).velocity, 1e-9);
    }
  }
}

/// Sides that part faster than 2 (c_l + c_r) / (gamma - 1) leave nothing between them.
TEST(ExactRiemann, Vacuum) {
  const double limit = 10 * std::sqrt(1.4);  // of the difference in velocity, between gases with c = sqrt(1.4)
  EXPECT_FALSE(ExactRiemann({1, -0.499 * limit, 1}, {1, 0.499 * limit, 1}, 1.4).vacuum());
  const ExactRiemann exact({1, -0.6 * limit, 1}, {1, 0.6 * limit, 1}, 1.4);
  EXPECT_TRUE(exact.vacuum());
  EXPECT_EQ(exact.star_pressure(), 0);
  EXPECT_EQ(exact.star_density_left(), 0);
  EXPECT_EQ(exact.at(0).density, 0);
  EXPECT_EQ(exact.at(-0.05 * limit).density, 0);  // the left edge is at -0.6 + 0.5 of the limit
  EXPECT_GT(exact.at(-0.15 * limit).density, 0);
  EXPECT_LT(exact.at(-0.15 * limit).density, 1);
  EXPECT_EQ(exact.at(-limit).density, 1);
}

}  // namespace
}  // namespace ejecta
