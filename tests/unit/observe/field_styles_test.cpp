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
  EXPECT_EQ(styles.at("pressure").range->min, -1e8);
  EXPECT_EQ(styles.at("pressure").range->max, 2e9);
  EXPECT_EQ(styles.at("density").range->max, 3000);
  EXPECT_EQ(styles.at("velocity").range->max, 5000);
  EXPECT_EQ(styles.at("damage").range->max, 1);
}

TEST(FieldStyles, TheRangeOfVelocityIsThatOfSoundWhereNothingMovesYet) {
  Outset outset = impact();
  outset.speed = 0;
  EXPECT_DOUBLE_EQ(styles_of(Scene{}, outset).at("velocity").range->max, std::sqrt(2e9 / 3000));
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
  EXPECT_FALSE(styles_of(Scene{}, impact()).at("specific_energy").range);
  EXPECT_FALSE(styles_of(Scene{}, Outset{}).at("pressure").range);
}

}  // namespace
}  // namespace ejecta
