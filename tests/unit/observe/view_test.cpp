#include "observe/view.hpp"

#include <gtest/gtest.h>

namespace ejecta {
namespace {

Body ball(double radius, Triple center, Triple velocity) {
  Body body;
  body.radius = radius;
  body.center = center;
  body.velocity = velocity;
  return body;
}

Scene two_balls() {
  Scene scene;
  scene.dimension = 3;
  scene.bodies = {ball(0.01, {0, 0, 0.1}, {0, 0, -5000}), ball(0.05, {1, 2, 3}, {1, 0, 0})};
  return scene;
}

TEST(View, IsAFrameAboutTheBodyThatMovesLeast) {
  const View view = choose_view(two_balls());
  EXPECT_EQ(view.center, (Triple{1, 2, 3}));
  EXPECT_DOUBLE_EQ(view.width, 0.16);
  EXPECT_DOUBLE_EQ(view.height, 0.16);
}

TEST(View, HoldsAllBodiesThatMoveLeast) {
  Scene scene;
  scene.dimension = 2;
  Body plate;
  plate.shape = BodyShape::rectangle;
  plate.size = {0.6, 0.1, 7};
  plate.center = {0, 0.5, 0};
  scene.bodies = {ball(0.1, {0, 0, 0}, {0, 0, 0}), plate, ball(0.1, {9, 9, 0}, {1, 0, 0})};
  View view = choose_view(scene);
  EXPECT_NEAR(view.center[0], 0, 1e-15);
  EXPECT_NEAR(view.center[1], 0.225, 1e-15);
  EXPECT_EQ(view.center[2], 0);
  EXPECT_NEAR(view.width, 1.6 * 0.65, 1e-15);
  scene.detonators.emplace_back();
  EXPECT_NEAR(choose_view(scene).width, 3 * 0.65, 1e-15);
}

TEST(View, OfABoxIsAsWideAsItsLongestSideInTheDimensionsThereAre) {
  Scene scene = two_balls();
  scene.bodies[1].shape = BodyShape::box;
  scene.bodies[1].size = {0.1, 0.2, 7};
  EXPECT_DOUBLE_EQ(choose_view(scene).width, 11.2);
  scene.dimension = 2;
  EXPECT_DOUBLE_EQ(choose_view(scene).width, 0.32);
}

TEST(View, GrowsForABodyThatBeginsAtItsEdge) {
  Scene scene = two_balls();
  scene.bodies[0] = ball(0.01, {1.1, 2, 3}, {5, 0, 0});       // beyond the edge at 1.08
  EXPECT_NEAR(choose_view(scene).width, 1.05 * 0.22, 1e-12);  // with a margin
  EXPECT_EQ(choose_view(scene).center, (Triple{1, 2, 3}));
  scene.bodies[0].center = {1.2, 2, 3};  // far off
  EXPECT_NEAR(choose_view(scene).width, 0.16, 1e-12);
  scene.bodies[0].center = {1, 9, 3};  // along the line of sight
  EXPECT_NEAR(choose_view(scene).width, 0.16, 1e-12);
}

TEST(View, LeavesOutWhatTheBoundaryCutsOff) {
  Scene scene;
  scene.dimension = 2;
  scene.bodies = {ball(0.1, {0, 0, 0}, {0, 0, 0})};
  scene.boundary.min = {0, -0.02, 0};
  scene.boundary.lower = {BoundaryKind::symmetry, BoundaryKind::reflecting, BoundaryKind::open};
  const View cut = choose_view(scene);
  EXPECT_DOUBLE_EQ(cut.center[0], 0.05);
  EXPECT_DOUBLE_EQ(cut.center[1], 0.04);
  EXPECT_DOUBLE_EQ(cut.width, 1.6 * 0.12);
  // Slices of space are laid through the middle of the whole body.
  scene.dimension = 3;
  EXPECT_EQ(choose_view(scene).center[1], 0);
  scene.dimension = 2;
  // Across a periodic face it takes all of the box.
  scene.boundary.lower = scene.boundary.upper = {BoundaryKind::periodic, BoundaryKind::open, BoundaryKind::open};
  scene.boundary.max = {0.3, 0, 0};
  EXPECT_DOUBLE_EQ(choose_view(scene).center[0], 0.15);
  EXPECT_DOUBLE_EQ(choose_view(scene).width, 1.6 * 0.3);
}

TEST(View, TakesFromTheSceneWhatItGives) {
  Scene scene = two_balls();
  scene.insitu.view_center[2] = 0;
  scene.insitu.view_size = 0.5;
  const View view = choose_view(scene);
  EXPECT_EQ(view.center, (Triple{1, 2, 0}));
  EXPECT_EQ(view.width, 0.5);
  EXPECT_EQ(view.height, 0.5);
  scene.insitu.view_height = 0.2;
  EXPECT_EQ(choose_view(scene).height, 0.2);
}

TEST(View, OfSpaceIsSeenAlongY) {
  const Window window = choose_view(two_balls()).window(3);
  EXPECT_NEAR(0.5 * (window.low[0] + window.high[0]), 1, 1e-12);
  EXPECT_NEAR(0.5 * (window.low[1] + window.high[1]), 3, 1e-12);
}

TEST(View, HeadingIsTheTitleOrElseTheName) {
  Scene scene = two_balls();
  scene.name = "balls";
  EXPECT_EQ(heading(scene), "balls");
  scene.title = "Two balls";
  EXPECT_EQ(heading(scene), "Two balls");
}

}  // namespace
}  // namespace ejecta
