#include "render/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/parallel.hpp"

namespace ejecta {
namespace {

constexpr int width = 200, height = 160;
constexpr std::uint32_t white = 0xFFFFFF, red = 0xC02020, blue = 0x2020C0;

struct Balls {
  std::vector<float> places, radii;
  std::vector<std::uint32_t> rgb;
  void add(Vec<3> x, double radius, std::uint32_t colour) {
    for (int a = 0; a < 3; ++a) places.push_back(static_cast<float>(x[a]));
    radii.push_back(static_cast<float>(radius));
    rgb.push_back(colour);
  }
  Solids solids() const { return {{places, radii, rgb}, {}, {}, false}; }
};

/// A picture two metres high, x to the right and z upwards: the eye is at negative y.
Camera camera() { return {Vec<3>::Zero(), Vec<3>::UnitX(), Vec<3>::UnitZ(), 2.0 / height}; }

std::uint32_t at(const Raster& r, double x, double z) {
  const int i = static_cast<int>(width / 2 + x * height / 2), j = static_cast<int>(height / 2 - z * height / 2);
  return r.rgb[static_cast<std::size_t>(j * width + i)];
}
int red_of(std::uint32_t rgb) { return static_cast<int>(rgb >> 16 & 255u); }
int blue_of(std::uint32_t rgb) { return static_cast<int>(rgb & 255u); }

TEST(Solids, TheNearerOfTwoBallsIsSeen) {
  Balls balls;
  balls.add({0, 0.5, 0}, 0.5, red);
  balls.add({0, -0.5, 0}, 0.3, blue);
  const Raster r = draw_solids(balls.solids(), camera(), width, height, white);
  EXPECT_GT(blue_of(at(r, 0, 0)), 2 * red_of(at(r, 0, 0)));
  EXPECT_GT(red_of(at(r, 0.4, 0)), 2 * blue_of(at(r, 0.4, 0)));
  EXPECT_EQ(at(r, 0.6, 0), white);
  EXPECT_EQ(at(r, 0, 0.6), white);
}

TEST(Solids, EdgesAreSmoothAndLightComesFromTheUpperLeft) {
  Balls balls;
  balls.add({0, 0, 0}, 0.5, 0xC0C0C0);
  const Raster r = draw_solids(balls.solids(), camera(), width, height, white);
  EXPECT_GT(red_of(at(r, -0.25, 0.25)), red_of(at(r, 0.25, -0.25)) + 30);
  std::set<std::uint32_t> right_edge;
  for (int j = 60; j < 100; ++j)
    for (int i = 130; i < 145; ++i) right_edge.insert(r.rgb[static_cast<std::size_t>(j * width + i)]);
  EXPECT_GT(right_edge.size(), 20u);
}

TEST(Solids, ABallShadesWhatLiesBehindIt) {
  Balls wall;  // a plane of small balls
  for (int k = -20; k <= 20; ++k)
    for (int i = -25; i <= 25; ++i) wall.add({0.05 * i, 0.3, 0.05 * k}, 0.04, 0xC0C0C0);
  const Raster open = draw_solids(wall.solids(), camera(), width, height, white);
  wall.add({0, -0.3, 0}, 0.15, 0xC0C0C0);  // far from the wall: nothing but its shadow reaches it
  const Raster shaded = draw_solids(wall.solids(), camera(), width, height, white);
  int darker = 0, brighter = 0;
  for (std::size_t p = 0; p < open.rgb.size(); ++p) {
    const int x = static_cast<int>(p) % width - width / 2, z = height / 2 - static_cast<int>(p) / width;
    if (std::hypot(x, z) < 0.2 * height / 2) continue;  // the ball itself
    darker += red_of(shaded.rgb[p]) < red_of(open.rgb[p]) - 15;
    brighter += red_of(shaded.rgb[p]) > red_of(open.rgb[p]) + 15;
  }
  EXPECT_GT(darker, 150);
  EXPECT_LT(brighter, 10);
}

TEST(Solids, CornersBetweenThingsAreDarkerThanOpenFaces) {
  // A floor that rises to the eye's right, as a step: two squares of triangles at different depths.
  const std::vector<float> places{-1, 0.2f, -1, 0, 0.2f, -1, 0, 0.2f, 1, -1, 0.2f, 1,
                                  0,  0,    -1, 1, 0,    -1, 1, 0,    1, 0,  0,    1};
  std::vector<float> normals;
  for (int k = 0; k < 8; ++k) normals.insert(normals.end(), {0, -1, 0});
  const std::vector<std::uint32_t> rgb(8, 0xA0A0A0);
  const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  const Solids step{{}, {places, normals, rgb, triangles}, {}, false};
  const Raster r = draw_solids(step, camera(), width, height, white);
  EXPECT_LT(red_of(at(r, -0.03, 0)), red_of(at(r, -0.5, 0)) - 5);
  EXPECT_NEAR(red_of(at(r, 0.5, 0)), red_of(at(r, 0.7, 0.4)), 2);  // and a plane is of one colour
}

TEST(Solids, APlateKeepsItsColoursAndItsHoles) {
  const std::vector<std::uint32_t> rgb{red, Plate::nothing, blue, red};  // rows upwards
  const Solids solids{{}, {}, {{-0.5, 0, -0.5}, {1, 0, 0}, {0, 0, 1}, 2, 2, rgb}, false};
  const Raster r = draw_solids(solids, camera(), width, height, white);
  EXPECT_EQ(at(r, -0.5, -0.5), red);
  EXPECT_EQ(at(r, 0.5, -0.5), white);
  EXPECT_EQ(at(r, -0.5, 0.5), blue);
  EXPECT_EQ(at(r, 0.5, 0.5), red);
}

TEST(Solids, APlateEndsWhereItIsHalfFullBetweenItsPixels) {
  const std::vector<std::uint32_t> rgb(4, red);
  const std::vector<float> filling{1, 0.2f, 1, 0.2f};  // one half at 5/8 of the way from left to right
  const Solids solids{{}, {}, {{-0.5, 0, -0.5}, {1, 0, 0}, {0, 0, 1}, 2, 2, rgb, filling}, false};
  const Raster r = draw_solids(solids, camera(), width, height, white);
  for (const double z : {-0.4, 0.0, 0.4}) {
    EXPECT_EQ(at(r, 0.125 - 0.02, z), red);
    EXPECT_EQ(at(r, 0.125 + 0.02, z), white);
  }
}

TEST(Solids, FlatOnesAreDiscsOfTheirOwnColour) {
  Balls balls;
  balls.add({0, 0, 0}, 0.5, red);
  Solids solids = balls.solids();
  solids.flat = true;
  const Raster r = draw_solids(solids, camera(), width, height, white);
  EXPECT_EQ(at(r, 0.3, -0.3), red);
  EXPECT_EQ(at(r, 0, 0), red);
}

TEST(Solids, ThePictureDoesNotDependOnTheThreadsAndBearsWhatIsNoNumber) {
  Balls balls;
  for (int k = 0; k < 3000; ++k)
    balls.add({std::sin(1.0 * k), std::sin(1.7 * k), std::sin(2.3 * k)}, 0.03,
              (static_cast<std::uint32_t>(k) * 1234567u) & white);
  balls.add({std::nan(""), 0, 0}, 0.1, red);
  balls.add({0, 0, std::nan("")}, 0.1, red);
  const int before = max_threads();
  set_threads(1);
  const Raster one = draw_solids(balls.solids(), camera(), width, height, white);
  set_threads(4);
  const Raster four = draw_solids(balls.solids(), camera(), width, height, white);
  set_threads(before);
  EXPECT_EQ(one.rgb, four.rgb);
}

}  // namespace
}  // namespace ejecta
