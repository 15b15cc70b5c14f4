#include "observe/field_styles.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ejecta {
namespace {

Outset impact() {
  Outset outset;
  outset.speed = 5000;
  outset.density = 3000;
  outset.pressure = 2e9;
  return outset;
}

auto styles_of(const Scene& scene, const Outset& outset) { return field_styles(scene, extremes(scene, {}, outset)); }

TEST(FieldStyles, RangesFollowFromWhatTheRunSetsOutWith) {
  const auto styles = styles_of(Scene{}, impact());
  EXPECT_EQ(styles.at("pressure").range->min, 0);
  EXPECT_EQ(styles.at("pressure").range->max, 2e9);
  EXPECT_EQ(styles.at("density").range->max, 3000);
  EXPECT_EQ(styles.at("velocity").range->max, 5000);
  EXPECT_EQ(styles.at("damage").range->max, 1);
}

TEST(FieldStyles, TheRangeOfVelocityIsThatOfSoundWhereNothingMovesYet) {
  Outset outset = impact();
  outset.speed = 0;
  EXPECT_NEAR(styles_of(Scene{}, outset).at("velocity").range->max, std::sqrt(2e9 / 3000), 5);  // 816 to two digits
}

/// Of a rock whose particles of a millimetre crack at E (k V)^(-1/m) = 25 MPa, and yield at 1 GPa.
Material rock() {
  Material m;
  m.elastic = Elastic{.shear_modulus = 20e9, .bulk_modulus = 100e9 / 3};  // E = 50 GPa
  m.strength = VonMises{1e9};
  m.damage = GradyKipp{.weibull_m = 9, .weibull_k = 1e9 * std::pow(0.5e-3, -9)};
  return m;
}

TEST(FieldStyles, PressureInSolidsReachesAsFarAsTheyBearTensionAndFollowsItsLogarithm) {
  Scene scene;
  scene.spacing = 1e-3;
  const FieldStyle struck = field_styles(scene, extremes(scene, {rock()}, impact())).at("pressure");
  EXPECT_NEAR(struck.range->min, -100e6, 1e3);
  EXPECT_EQ(struck.range->max, 2e9);
  EXPECT_NEAR(struck.linear_to, 25e6, 1e3);
  // What is at rest, and only torn: three times what it bears, where nothing else is known.
  const FieldStyle torn = field_styles(scene, extremes(scene, {rock()}, Outset{})).at("pressure");
  EXPECT_NEAR(torn.range->max, 75e6, 1e3);
  EXPECT_NEAR(torn.range->min, -75e6, 1e3);
  EXPECT_NEAR(torn.linear_to, 0.03 * 75e6, 1e3);
}

TEST(FieldStyles, WithoutFlawsTheYieldStressCountsAndWithoutThatTheModulus) {
  Scene scene;
  scene.spacing = 1e-3;
  Material m = rock();
  m.damage.reset();
  EXPECT_EQ(field_styles(scene, extremes(scene, {m}, Outset{})).at("pressure").range->max, 3e9);
  m.strength.reset();
  EXPECT_EQ(field_styles(scene, extremes(scene, {m}, Outset{})).at("pressure").range->max, 1e9);
}

TEST(FieldStyles, WhatAnExplosiveDrivesIsSeen) {
  Material tnt;  // 21 GPa at the front
  tnt.eos = Jwl{.rho0 = 1630,
                .A = 371.2e9,
                .B = 3.231e9,
                .R1 = 4.15,
                .R2 = 0.95,
                .omega = 0.3,
                .E0 = 7e9,
                .detonation_speed = 6930};
  Outset outset = impact();
  outset.pressure = 21e9;
  EXPECT_NEAR(field_styles(Scene{}, extremes(Scene{}, {tnt}, outset)).at("pressure").linear_to, 21e6, 2e6);
}

TEST(FieldStyles, SolidsAreNeverThinnerThanHalf) {
  const Scene scene;
  EXPECT_EQ(field_styles(scene, extremes(scene, {rock()}, impact())).at("density").range->min, 1500);
  EXPECT_EQ(field_styles(scene, extremes(scene, {rock(), Material{}}, impact())).at("density").range->min, 0);  // a gas
}

/// A block of a metre that is 1000 kg/m^3 dense, yields at half its modulus, and moves.
struct Bouncing {
  Material rubber;
  Scene scene;
  Outset outset;
  Bouncing() {
    rubber.name = "rubber";
    rubber.eos = LinearEos{.rho0 = 1000, .c0 = 1000};
    rubber.elastic = Elastic{.shear_modulus = 0.75e9, .bulk_modulus = 1e9};
    rubber.strength = VonMises{0.5e9};
    Body body;
    body.material = "rubber";
    body.shape = BodyShape::rectangle;
    body.size = {1, 1, unset};
    scene.dimension = 2;
    scene.bodies = {body};
    outset.speed = 10;
    outset.density = 1200;
    outset.pressure = 1e6;
  }
  auto styles() const { return field_styles(scene, extremes(scene, {rubber}, outset)); }
};

TEST(FieldStyles, MotionBringsNoMoreAboutThanItsOwnWaves) {
  Bouncing block;  // rho u (c + u) = 14.2 MPa, and not three times the yield stress
  EXPECT_NEAR(block.styles().at("pressure").range->max, 15e6, 1e3);
  EXPECT_NEAR(block.styles().at("pressure").range->min, -15e6, 1e3);
  EXPECT_NEAR(block.styles().at("density").range->min, 985, 1);
  EXPECT_NEAR(block.styles().at("density").range->max, 1015, 1);
  block.scene.bodies[0].driven = true;  // it may be pulled on for ever
  EXPECT_NEAR(block.styles().at("pressure").range->max, 1.5e9, 1e3);
}

TEST(FieldStyles, APlaneImpactIsWithinTheRange) {
  Bouncing block;
  block.scene.boundary.lower[0] = BoundaryKind::reflecting;
  block.scene.bodies[0].velocity = {-10, 0, 0};  // rho (c_L + 3/2 u) u = 14.3 MPa
  EXPECT_NEAR(block.styles().at("pressure").range->max, 18e6, 1e3);
  block.rubber.strength = VonMises{1e6};
  EXPECT_NEAR(block.styles().at("pressure").range->min, -18e6, 1e3);  // four times the yield stress is no bound
  Material weak = rock();                                             // cracks at 2.5 MPa
  weak.damage->weibull_k *= 1e9;
  block.scene.spacing = 1e-3;
  const auto with_flaws = field_styles(block.scene, extremes(block.scene, {block.rubber, weak}, block.outset));
  EXPECT_GT(with_flaws.at("pressure").range->min, -10e6);
}

TEST(FieldStyles, TheLightestSolidIsWithinTheRangeOfDensity) {
  Bouncing block;
  Material steel = block.rubber;
  steel.name = "steel";
  steel.eos = LinearEos{.rho0 = 8000, .c0 = 1000};
  block.scene.bodies.push_back(block.scene.bodies[0]);
  block.scene.bodies[1].material = "steel";
  const auto styles = field_styles(block.scene, extremes(block.scene, {block.rubber, steel}, block.outset));
  EXPECT_LT(styles.at("density").range->min, 1000);
  EXPECT_GT(styles.at("density").range->max, 8000);
}

TEST(FieldStyles, RangesOfTheSceneComeFirst) {
  Scene scene;
  scene.insitu.ranges = {{"pressure", {0, 1e6}}, {"sound_speed", {100, 200}}};
  const auto styles = styles_of(scene, impact());
  EXPECT_EQ(styles.at("pressure").range->max, 1e6);
  EXPECT_EQ(styles.at("sound_speed").range->min, 100);
  EXPECT_EQ(styles.at("sound_speed").label, "sound speed");
}

TEST(FieldStyles, LeaveARangeOpenThatNothingIsKnownOf) {
  EXPECT_FALSE(styles_of(Scene{}, impact()).at("mach").range);
  EXPECT_FALSE(styles_of(Scene{}, Outset{}).at("pressure").range);
}

}  // namespace
}  // namespace ejecta
