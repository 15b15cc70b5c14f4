#include "sph/shells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ejecta {
namespace {

constexpr double pi = std::numbers::pi;

Body round_body(BodyShape shape) {
  Body body;
  body.shape = shape;
  body.center = {1, 2, shape == BodyShape::disc ? 0.0 : 3};
  body.radius = 0.5;
  body.inner_radius = 0.4;
  if (shape == BodyShape::cylinder) {
    body.length = 0.7;
    body.axis = {1, 2, -0.5};
  }
  return body;
}

template <int Dim>
double least_distance(const PointCloud<Dim>& cloud) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (cloud.points[i] - cloud.points[j]).norm());
  return least;
}

/// Volume, centre, and how many particles a body of that volume should have.
template <int Dim>
void expect_exact(const Body& body, double spacing, double aspect) {
  Body with_aspect = body;
  with_aspect.aspect = aspect;
  const auto cloud = lay_shells<Dim>(with_aspect, spacing, false, 7);
  double sum = 0;
  for (const auto& cell : cloud.cells) sum += cell.volume;
  EXPECT_NEAR(sum, volume(body, Dim), 1e-12 * sum);
  EXPECT_NEAR(static_cast<double>(cloud.points.size()) * std::pow(spacing, Dim), sum, 0.03 * sum);
  for (std::size_t k = 0; k < cloud.points.size(); ++k) {
    EXPECT_TRUE(inside<Dim>(body, cloud.points[k]));
    EXPECT_NEAR(cloud.cells[k].normal.norm(), 1, 1e-12);
    EXPECT_NEAR(cloud.cells[k].volume, std::pow(spacing, Dim), 0.2 * std::pow(spacing, Dim));
  }
  EXPECT_GT(least_distance(cloud), 0.45 * spacing / std::pow(aspect, (Dim - 1.0) / Dim));
}

TEST(Shells, VolumesAreExactAndParticlesAboutTheSpacingApart) {
  for (const double aspect : {1.0, 2.0}) {
    expect_exact<2>(round_body(BodyShape::disc), 0.02, aspect);
    expect_exact<3>(round_body(BodyShape::cylinder), 0.035, aspect);
    expect_exact<3>(round_body(BodyShape::sphere), 0.035, aspect);
  }
}

TEST(Shells, NoTwoShellsAreTurnedAlike) {
  const auto cloud = lay_shells<2>(round_body(BodyShape::disc), 0.02, false, 7);
  const Vec<2> center(1, 2);
  std::vector<double> phase;
  double last = 0;
  for (const auto& x : cloud.points) {
    const double radius = (x - center).norm();
    if (std::abs(radius - last) < 1e-9) continue;
    last = radius;
    phase.push_back(std::atan2(x[1] - 2, x[0] - 1));
  }
  ASSERT_EQ(phase.size(), 5u);
  for (std::size_t k = 1; k < phase.size(); ++k) EXPECT_GT(std::abs(phase[k] - phase[k - 1]), 1e-4);
}

template <int Dim>
void expect_clear_of_planes(Body body, double spacing) {
  body.axis = {0, 0, 1};
  const auto cloud = lay_shells<Dim>(body, spacing, true, 7);
  int first_quarter = 0, second_quarter = 0;
  for (const auto& x : cloud.points) {
    const Vec<Dim> d = x - Eigen::Map<const Vec<Dim>>(body.center.data());
    for (int a = 0; a < Dim; ++a) EXPECT_GT(std::abs(d[a]), 0.15 * spacing);
    first_quarter += d[0] > 0 && d[1] > 0;
    second_quarter += d[0] < 0 && d[1] > 0;
  }
  EXPECT_EQ(first_quarter, second_quarter);
}

TEST(Shells, MirrorsSeeNoParticleNearThem) {
  expect_clear_of_planes<2>(round_body(BodyShape::disc), 0.02);
  expect_clear_of_planes<3>(round_body(BodyShape::cylinder), 0.035);
  expect_clear_of_planes<3>(round_body(BodyShape::sphere), 0.035);
}

TEST(Shells, AFullBodyHasAMiddle) {
  Body ball = round_body(BodyShape::sphere);
  ball.inner_radius = 0;
  const auto cloud = lay_shells<3>(ball, 0.1, false, 7);
  double sum = 0;
  for (const auto& cell : cloud.cells) sum += cell.volume;
  EXPECT_NEAR(sum, pi / 6, 1e-12);
}

}  // namespace
}  // namespace ejecta
