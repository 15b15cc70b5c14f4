#include "reference/sedov.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace ejecta {
namespace {

constexpr Geometry all[] = {Geometry::planar, Geometry::cylindrical, Geometry::spherical};

/// Kamm & Timmes 2007, table of the standard cases of uniform density, to a unit of the last digit.
TEST(Sedov, EnergyConstantIsThatOfKammAndTimmes) {
  EXPECT_NEAR(Sedov(Geometry::planar, 1.4).alpha(), 1.077486, 1e-6);
  EXPECT_NEAR(Sedov(Geometry::cylindrical, 1.4).alpha(), 0.984074, 1e-6);
  EXPECT_NEAR(Sedov(Geometry::spherical, 1.4).alpha(), 0.851071, 1e-6);
}

TEST(Sedov, EnergyConstantOfOtherGases) {
  EXPECT_NEAR(Sedov(Geometry::cylindrical, 1.2).alpha(), 2.00519, 6e-6);
  EXPECT_NEAR(Sedov(Geometry::cylindrical, 1.3).alpha(), 1.32797, 6e-6);
  EXPECT_NEAR(Sedov(Geometry::cylindrical, 5.0 / 3).alpha(), 0.56428, 6e-6);
}

TEST(Sedov, ShockObeysRankineAndHugoniot) {
  for (const Geometry geometry : all)
    for (const double gamma : {1.1, 1.4, 5.0 / 3, 3.0}) {
      const Sedov::State s = Sedov(geometry, gamma).state(1);
      EXPECT_DOUBLE_EQ(s.density, (gamma + 1) / (gamma - 1));
      EXPECT_DOUBLE_EQ(s.velocity, 2 / (gamma + 1));
      EXPECT_DOUBLE_EQ(s.pressure, 2 / (gamma + 1));
    }
}

/// All matter that the shock has swept up is inside, the energy is the one asked for, and the gas keeps the entropy
/// that the shock gave it: p/rho^gamma ~ D^2 of the time at which the shock was at the radius that held the same mass.
TEST(Sedov, ProfilesHoldMassEnergyAndEntropy) {
  for (const Geometry geometry : all)
    for (const double gamma : {1.2, 1.4, 5.0 / 3}) {
      const Sedov sedov(geometry, gamma);
      const int nu = 1 + static_cast<int>(geometry);
      const auto integral = [&](auto&& of, double to) {
        return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
            [&](double x) { return of(sedov.state(x)) * std::pow(x, nu - 1); }, 0.0, to, 8, 1e-9);
      };
      const auto mass = [&](double to) { return integral([](const auto& s) { return s.density; }, to); };
      EXPECT_NEAR(mass(1) * nu, 1, 1e-7);
      const double energy = integral(
          [&](const auto& s) { return 0.5 * s.density * s.velocity * s.velocity + s.pressure / (gamma - 1); }, 1);
      const double directions = geometry == Geometry::planar ? 2 : all_directions(geometry);
      EXPECT_NEAR(directions * energy * std::pow(2.0 / (nu + 2), 2), sedov.alpha(), 1e-7 * sedov.alpha());
      const Sedov::State behind = sedov.state(1), s = sedov.state(0.9);
      // The shock swept that mass at R' = R (nu mass)^(1/nu), and D ~ R^(-nu/2).
      EXPECT_NEAR(s.pressure / std::pow(s.density, gamma),
                  behind.pressure / std::pow(behind.density, gamma) / (nu * mass(0.9)), 1e-6 * behind.pressure);
    }
}

TEST(Sedov, CentreHasPressureAndNoMatter) {
  const Sedov sedov(Geometry::cylindrical, 1.4);
  EXPECT_NEAR(sedov.state(0).pressure, 0.310766, 1e-6);
  EXPECT_EQ(sedov.state(0).density, 0);
  EXPECT_EQ(sedov.state(0).velocity, 0);
  EXPECT_NEAR(sedov.state(0.01).velocity, 0.01 / 1.4, 1e-8);  // that of a gas that expands at constant pressure
  // Nothing to speak of; integrated inwards a velocity in excess grows like 1/r, from round-off.
  EXPECT_NEAR(sedov.state(0.0005).density / sedov.state(0.002).density, std::pow(0.25, 5), 1e-5 * std::pow(0.25, 5));
}

TEST(Sedov, RadiusGrowsWithItsSpeed) {
  const Sedov sedov(Geometry::cylindrical, 1.4);
  EXPECT_NEAR(sedov.radius(4.184e12, 1.225, 1e-3), 43.1625, 1e-4);
  for (const Geometry geometry : all) {
    const Sedov s(geometry, 1.4);
    const double t = 1e-3, h = 1e-8;
    EXPECT_NEAR(s.speed(1e9, 1.2, t), (s.radius(1e9, 1.2, t + h) - s.radius(1e9, 1.2, t - h)) / (2 * h),
                1e-6 * s.speed(1e9, 1.2, t));
  }
  EXPECT_FALSE(Sedov::exists(Geometry::spherical, 7));
  EXPECT_TRUE(Sedov::exists(Geometry::cylindrical, 7));
}

}  // namespace
}  // namespace ejecta
