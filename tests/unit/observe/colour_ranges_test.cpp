#include "observe/colour_ranges.hpp"

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

TEST(ColourRanges, FollowFromWhatTheRunSetsOutWith) {
  const auto ranges = colour_ranges(Scene{}, {}, impact());
  EXPECT_EQ(ranges.at("pressure").min, -1e8);
  EXPECT_EQ(ranges.at("pressure").max, 2e9);
  EXPECT_EQ(ranges.at("density").max, 3000);
  EXPECT_EQ(ranges.at("velocity").max, 5000);
  EXPECT_EQ(ranges.at("damage").max, 1);
}

TEST(ColourRanges, OfVelocityIsThatOfSoundWhereNothingMovesYet) {
  Outset outset = impact();
  outset.speed = 0;
  EXPECT_DOUBLE_EQ(colour_ranges(Scene{}, {}, outset).at("velocity").max, std::sqrt(2e9 / 3000));
}

TEST(ColourRanges, OfTheSceneComeFirst) {
  Scene scene;
  scene.insitu.ranges = {{"pressure", {0, 1e6}}, {"sound_speed", {100, 200}}};
  const auto ranges = colour_ranges(scene, {}, impact());
  EXPECT_EQ(ranges.at("pressure").max, 1e6);
  EXPECT_EQ(ranges.at("sound_speed").min, 100);
}

}  // namespace
}  // namespace ejecta
