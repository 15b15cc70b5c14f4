#include "sph/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace ejecta {
namespace {

constexpr double pi = std::numbers::pi;

Body sphere(double radius) {
  Body body;
  body.center = {1, 2, 3};
  body.radius = radius;
  return body;
}
Body disc(double radius) {
  Body body = sphere(radius);
  body.shape = BodyShape::disc;
  body.center[2] = 0;
  return body;
}
Body box(const Triple& size, bool flat = false) {
  Body body;
  body.shape = flat ? BodyShape::rectangle : BodyShape::box;
  body.center = {1, 2, flat ? 0.0 : 3};
  body.size = size;
  return body;
}
Body cylinder(double radius, double length, const Triple& axis) {
  Body body = sphere(radius);
  body.shape = BodyShape::cylinder;
  body.length = length;
  body.axis = axis;
  return body;
}

template <int Dim>
double filled(const PointCloud<Dim>& cloud) {
  return cloud.volume * static_cast<double>(cloud.points.size());
}

/// Nearest-neighbour distance of the point closest to the centre, and how many points are that near.
template <int Dim>
std::pair<double, int> nearest(const PointCloud<Dim>& cloud, const Vec<Dim>& center) {
  Vec<Dim> middle = cloud.points[0];
  for (const auto& x : cloud.points)
    if ((x - center).norm() < (middle - center).norm()) middle = x;
  double least = 1e300;
  for (const auto& x : cloud.points)
    if (x != middle) least = std::min(least, (x - middle).norm());
  int count = 0;
  for (const auto& x : cloud.points) count += x != middle && (x - middle).norm() < least * (1 + 1e-9);
  return {least, count};
}

TEST(Shapes, ABoxHasItsExactVolumeWhateverTheSpacing) {
  for (const Lattice lattice : {Lattice::cubic, Lattice::hexagonal})
    for (const double spacing : {0.1, 0.11, 0.37}) {
      EXPECT_NEAR(filled(fill<3>(box({1, 0.7, 1.3}), spacing, lattice)), 0.91, 1e-12);
      EXPECT_NEAR(filled(fill<2>(box({1, 0.7, 0}, true), spacing, lattice)), 0.7, 1e-12);
    }
  EXPECT_EQ(fill<3>(box({1, 0.5, 2}), 0.1, Lattice::cubic).points.size(), 1000u);
  EXPECT_EQ(fill<2>(box({1, 0.5, 0}, true), 0.1, Lattice::cubic).points.size(), 50u);
}

TEST(Shapes, ABoxIsFilledEvenly) {
  const auto cloud = fill<3>(box({1, 1, 1}), 0.2, Lattice::cubic);
  Vec<3> sum = Vec<3>::Zero();
  for (const auto& x : cloud.points) {
    sum += x;
    for (int a = 0; a < 3; ++a) {
      const double cells = (x[a] - (a + 0.5)) / 0.2 - 0.5;  // the box begins half an edge below (1, 2, 3)
      EXPECT_NEAR(cells, std::round(cells), 1e-9);
    }
  }
  EXPECT_LT((sum / 125 - Vec<3>(1, 2, 3)).norm(), 1e-12);
}

TEST(Shapes, RoundBodiesHaveTheirExactVolumeAtAboutTheSpacing) {
  for (const Lattice lattice : {Lattice::cubic, Lattice::hexagonal}) {
    const auto ball = fill<3>(sphere(0.5), 0.05, lattice),
               rod = fill<3>(cylinder(0.4, 1.5, {1, 2, -0.5}), 0.05, lattice);
    const auto plate = fill<2>(disc(0.5), 0.02, lattice);
    EXPECT_NEAR(filled(ball), pi / 6, 1e-13);
    EXPECT_NEAR(filled(rod), 0.24 * pi, 1e-13);
    EXPECT_NEAR(filled(plate), 0.25 * pi, 1e-13);
    EXPECT_NEAR(ball.volume, std::pow(0.05, 3), 0.02 * std::pow(0.05, 3));
    EXPECT_NEAR(rod.volume, std::pow(0.05, 3), 0.02 * std::pow(0.05, 3));
    EXPECT_NEAR(plate.volume, std::pow(0.02, 2), 0.02 * std::pow(0.02, 2));
  }
}

TEST(Shapes, NoPointLiesOutsideByMoreThanAQuarterOfTheSpacing) {
  const double s = 0.1, more = 0.5 * s;
  for (const Lattice lattice : {Lattice::cubic, Lattice::hexagonal}) {
    const auto all_inside = [&](const Body& body, const Body& grown, auto dim) {
      constexpr int Dim = decltype(dim)::value;
      for (const auto& x : fill<Dim>(body, s, lattice).points)
        EXPECT_TRUE(inside<Dim>(grown, x)) << info(body.shape).word;
    };
    const std::integral_constant<int, 3> space;
    const std::integral_constant<int, 2> plane;
    all_inside(sphere(0.5), sphere(0.5 + 0.5 * more), space);
    all_inside(cylinder(0.4, 1.5, {1, 2, -0.5}), cylinder(0.4 + 0.5 * more, 1.5 + more, {1, 2, -0.5}), space);
    all_inside(box({1, 0.7, 1.3}), box({1, 0.7, 1.3}), space);
    all_inside(disc(0.5), disc(0.5 + 0.5 * more), plane);
    all_inside(box({1, 0.7, 0}, true), box({1, 0.7, 0}, true), plane);
  }
}

TEST(Shapes, InsideKnowsTheSurface) {
  EXPECT_TRUE(inside<3>(sphere(0.5), {1.49, 2, 3}));
  EXPECT_FALSE(inside<3>(sphere(0.5), {1.4, 2.4, 3}));
  EXPECT_TRUE(inside<3>(box({1, 2, 3}), {1.49, 2.99, 4.49}));
  EXPECT_FALSE(inside<3>(box({1, 2, 3}), {1.49, 3.01, 4.49}));
  const Body tilted = cylinder(0.1, 2, {1, 1, 0});
  EXPECT_TRUE(inside<3>(tilted, {1 + 0.7, 2 + 0.7, 3}));
  EXPECT_FALSE(inside<3>(tilted, {1 + 0.72, 2 + 0.72, 3}));
  EXPECT_FALSE(inside<3>(tilted, {1 + 0.7, 2 - 0.7, 3}));
  EXPECT_FALSE(inside<3>(tilted, {1, 2, 3.11}));
  EXPECT_FALSE(inside<2>(disc(0.5), {1.4, 2.4}));
  EXPECT_TRUE(inside<2>(disc(0.5), {1.3, 2.3}));
}

TEST(Shapes, HexagonalLatticesAreClosePacked) {
  const auto solid = fill<3>(sphere(0.5), 0.1, Lattice::hexagonal);
  const auto [distance, count] = nearest<3>(solid, {1, 2, 3});
  EXPECT_NEAR(distance, std::pow(2.0, 1.0 / 6) * std::cbrt(solid.volume), 1e-12);
  EXPECT_EQ(count, 12);

  const auto plane = fill<2>(disc(0.5), 0.1, Lattice::hexagonal);
  const auto [distance2, count2] = nearest<2>(plane, {1, 2});
  EXPECT_NEAR(distance2, std::sqrt(2 / std::sqrt(3.0)) * std::sqrt(plane.volume), 1e-12);
  EXPECT_EQ(count2, 6);
}

TEST(Shapes, CubicLatticesHaveSixNeighboursAtTheSpacing) {
  const auto solid = fill<3>(sphere(0.5), 0.1, Lattice::cubic);
  const auto [distance, count] = nearest<3>(solid, {1, 2, 3});
  EXPECT_NEAR(distance, std::cbrt(solid.volume), 1e-12);
  EXPECT_EQ(count, 6);
}

TEST(Shapes, ARodAlongALatticeIsAsLongAsItIsSaidToBe) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double spacing : {0.1, 0.07, 0.052}) {
      Triple direction{0, 0, 0};
      direction[static_cast<std::size_t>(axis)] = -1;
      const Body rod = cylinder(0.4, 2, direction);
      const auto cloud = fill<3>(rod, spacing, Lattice::cubic);
      std::set<long> layers;
      double low = 1e9, high = -1e9;
      for (const auto& x : cloud.points) {
        low = std::min(low, x[axis]);
        high = std::max(high, x[axis]);
        layers.insert(std::lround(1e6 * x[axis]));
      }
      const double thickness = (high - low) / static_cast<double>(layers.size() - 1);
      EXPECT_NEAR(high - low + thickness, 2, 1e-12);
      EXPECT_NEAR(0.5 * (high + low), rod.center[static_cast<std::size_t>(axis)], 1e-12);
      EXPECT_NEAR(filled(cloud), volume(rod, 3), 1e-12);
    }
}

TEST(Shapes, AHoleIsLeftOut) {
  Body shell = sphere(1), ring = disc(1), tube = cylinder(1, 3, {0, 0, 1});
  for (Body* body : {&shell, &ring, &tube}) body->inner_radius = 0.6;
  EXPECT_DOUBLE_EQ(volume(shell, 3), 4 * pi / 3 * (1 - 0.216));
  EXPECT_DOUBLE_EQ(volume(ring, 2), pi * (1 - 0.36));
  EXPECT_DOUBLE_EQ(volume(tube, 3), 3 * pi * (1 - 0.36));
  EXPECT_FALSE(inside<3>(shell, Vec<3>(1, 2, 3.5)));
  EXPECT_TRUE(inside<3>(shell, Vec<3>(1, 2, 3.7)));
  EXPECT_FALSE(inside<3>(tube, Vec<3>(1.5, 2, 4)));
  EXPECT_TRUE(inside<3>(tube, Vec<3>(1.7, 2, 4)));
  const auto cloud = fill<2>(ring, 0.05, Lattice::cubic);
  EXPECT_NEAR(filled(cloud), volume(ring, 2), 1e-12);
  for (const auto& x : cloud.points) EXPECT_GT((x - Vec<2>(1, 2)).norm(), 0.58);
}

TEST(Shapes, TheFaceOfAHoleStaysWhereItIsWhenACloudIsScaled) {
  for (const Lattice lattice : {Lattice::cubic, Lattice::hexagonal})
    for (const double hole : {0.5, 0.75, 0.9})
      for (const double spacing : {0.05, 0.04, 0.03}) {
        Body shell = sphere(1), ring = disc(1), tube = cylinder(1, 0.5, {0, 0, 1});
        for (Body* body : {&shell, &ring, &tube}) body->inner_radius = hole;
        const auto in_space = fill<3>(shell, spacing, lattice), along = fill<3>(tube, spacing, lattice);
        const auto in_plane = fill<2>(ring, spacing, lattice);
        for (const auto& x : in_space.points) ASSERT_GE((x - Vec<3>(1, 2, 3)).norm(), hole * (1 - 1e-12));
        for (const auto& x : along.points) ASSERT_GE((x - Vec<3>(1, 2, 3)).head<2>().norm(), hole * (1 - 1e-12));
        for (const auto& x : in_plane.points) ASSERT_GE((x - Vec<2>(1, 2)).norm(), hole * (1 - 1e-12));
        EXPECT_NEAR(filled(in_space), volume(shell, 3), 1e-12);
        EXPECT_NEAR(filled(along), volume(tube, 3), 1e-12);
        EXPECT_NEAR(filled(in_plane), volume(ring, 2), 1e-12);
      }
}

TEST(Shapes, DepthIsTheDistanceFromTheNearestFace) {
  Body tube = cylinder(1, 3, {0, 0, 1});
  tube.inner_radius = 0.6;
  EXPECT_NEAR((depth<3>(tube, {1.7, 2, 3})), 0.1, 1e-15);
  EXPECT_NEAR((depth<3>(tube, {1, 2.95, 3})), 0.05, 1e-15);
  EXPECT_NEAR((depth<3>(tube, {1.8, 2, 4.48})), 0.02, 1e-15);
  EXPECT_NEAR((depth<3>(tube, {1.5, 2, 3})), -0.1, 1e-15);
  EXPECT_NEAR((depth<3>(sphere(0.5), {1, 2, 3})), 0.5, 1e-15);
  EXPECT_NEAR((depth<2>(box({1, 2, 0}, true), {1.4, 2})), 0.1, 1e-15);
}

}  // namespace
}  // namespace ejecta
