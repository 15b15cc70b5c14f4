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
