#include "observe/plane_impact.hpp"

#include <gtest/gtest.h>

namespace ejecta {
namespace {

/// Of density 1000 kg/m^3 and longitudinal waves of 2 km/s.
Material soft() {
  Material m;
  m.name = "soft";
  m.eos = LinearEos{.rho0 = 1000, .c0 = 2000};
  m.elastic = Elastic{.shear_modulus = 0.75e9, .bulk_modulus = 3e9};
  return m;
}

/// Three times as dense.
Material hard() {
  Material m = soft();
  m.name = "hard";
  m.eos = LinearEos{.rho0 = 3000, .c0 = 2000};
  m.elastic = Elastic{.shear_modulus = 2.25e9, .bulk_modulus = 9e9};
  return m;
}

Body block(const char* material, double x, double speed, double height = 0.02) {
  Body b;
  b.material = material;
  b.shape = BodyShape::rectangle;
  b.center = {x, 0, 0};
  b.size = {0.02, height, unset};
  b.velocity = {speed, 0, 0};
  return b;
}

Scene scene_of(std::vector<Body> bodies) {
  Scene scene;
  scene.dimension = 2;
  scene.bodies = std::move(bodies);
  return scene;
}

TEST(PlaneImpact, OfLikeBodiesIsHalfTheImpedanceTimesTheVelocity) {
  const PlaneImpact impact = strongest_impact(scene_of({block("soft", 0, 0), block("soft", -0.03, 100)}), {soft()});
  EXPECT_NEAR(impact.pressure, 0.5 * 1000 * 2075 * 100, 1);
  EXPECT_NEAR(impact.speed, 100, 1e-9);  // the free surface of the one that was struck
}

TEST(PlaneImpact, FollowsTheImpedances) {
  const PlaneImpact impact =
      strongest_impact(scene_of({block("soft", 0, 0), block("hard", -0.03, 100)}), {soft(), hard()});
  EXPECT_NEAR(impact.pressure, 0.75 * 1000 * 2075 * 100, 1);
  EXPECT_NEAR(impact.speed, 150, 1e-9);
}

TEST(PlaneImpact, OfANarrowBodyIsTakenDownByTheRatioOfTheWidths) {
  const PlaneImpact impact =
      strongest_impact(scene_of({block("soft", 0, 0, 0.2), block("soft", -0.03, 100)}), {soft()});
  EXPECT_NEAR(impact.pressure, 0.1 * 0.5 * 1000 * 2075 * 100, 1);
}

TEST(PlaneImpact, AWallAndADrivenBodyDoNotGiveWay) {
  Scene scene = scene_of({block("soft", 0, -100)});
  scene.boundary.lower[0] = BoundaryKind::reflecting;
  EXPECT_NEAR(strongest_impact(scene, {soft()}).pressure, 1000 * 2150 * 100, 1);  // as of two at twice the velocity
  scene.bodies[0].velocity = {100, 0, 0};
  EXPECT_EQ(strongest_impact(scene, {soft()}).pressure, 0);  // away from it
  Scene pushed = scene_of({block("soft", 0, 0), block("hard", -0.03, 100)});
  pushed.bodies[1].driven = true;
  EXPECT_NEAR(strongest_impact(pushed, {soft(), hard()}).pressure, 1000 * 2075 * 100, 1);
}

TEST(PlaneImpact, IsNoneBetweenBodiesThatPartAndOfGases) {
  EXPECT_EQ(strongest_impact(scene_of({block("soft", 0, 0), block("soft", -0.03, -100)}), {soft()}).pressure, 0);
  Material gas;
  gas.name = "gas";
  gas.eos = IdealGas{};
  EXPECT_EQ(strongest_impact(scene_of({block("gas", 0, 0), block("gas", -0.03, 100)}), {gas}).pressure, 0);
}

TEST(PlaneImpact, PoresLetNoShockPass) {
  Material m = soft();
  m.porosity.emplace();
  const PlaneImpact impact = strongest_impact(scene_of({block("soft", 0, 0), block("soft", -0.03, 100)}), {m});
  EXPECT_LT(impact.pressure, 0.5 * 1000 * 76 * 100);
}

}  // namespace
}  // namespace ejecta
