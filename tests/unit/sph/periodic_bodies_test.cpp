#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

TEST(PeriodicBodies, APeriodicBoxIsWiderThanTheKernelReaches) {
  const auto strip = [](int spacings) {
    return R"([scene]
name = "strip"
dimension = 2
[resolution]
spacing = "1 m"
[time]
end = "1 s"
[[bodies]]
name = "gas"
material = "air"
shape = "rectangle"
size = ["20 m", ")" +
           std::to_string(spacings) + R"( m"]
density = "1 kg/m^3"
pressure = "1 Pa"
[numerics]
density = "summation"
kernel = "wendland_c4"
[boundary]
x = "periodic"
y = "periodic"
min = ["-10 m", ")" +
           std::to_string(-0.5 * spacings) + R"( m"]
max = ["10 m", ")" +
           std::to_string(0.5 * spacings) + " m\"]\n";
  };
  // The kernel reaches 2.6 spacings: nobody meets the same neighbour twice, or too few of them, from 3 on.
  const double wide = start<2>(strip(20))->particles.column(Field::density)[0];
  for (const int spacings : {3, 4, 5, 6})
    EXPECT_NEAR(start<2>(strip(spacings))->particles.column(Field::density)[0], wide, 1e-12 * wide) << spacings;
  for (const int spacings : {1, 2}) try {
      start<2>(strip(spacings));
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().size(), 1u);
      EXPECT_NE(std::string(error.what()).find("boundary.y: expected a periodic box wider than the kernel"),
                std::string::npos)
          << error.what();
    }
}

std::string box_across(double x, const std::string& more = "") {
  return fmt::format(R"([scene]
name = "across"
dimension = 2
[resolution]
spacing = "1 m"
[time]
end = "1 s"
[[bodies]]
name = "disc"
material = "copper"
shape = "disc"
center = ["{} m", "0 m"]
radius = "5 m"
[bodies.profile]
velocity = ["10*r", "0"]
{}
[boundary]
x = "periodic"
min = ["-10 m", "0 m"]
max = ["10 m", "0 m"]
)",
                     x, more);
}

TEST(PeriodicBodies, WhatSticksOutOfAPeriodicFaceComesInAtTheOther) {
  const auto sums = [](double x) {
    const auto sph = start<2>(box_across(x));
    const auto& p = sph->particles;
    std::array<double, 3> sum{static_cast<double>(p.size()), 0, 0};
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_LE(std::abs(p.column(Field::position, 0)[i]), 10);
      sum[1] += p.column(Field::mass)[i];
      sum[2] += p.column(Field::mass)[i] * p.column(Field::velocity, 0)[i];
    }
    return sum;
  };
  const auto middle = sums(0);
  for (const double x : {-10.0, -7.0, 9.75, 12.0, 35.0}) {
    const auto across = sums(x);
    EXPECT_EQ(across[0], middle[0]) << x;
    EXPECT_NEAR(across[1], middle[1], 1e-12 * middle[1]) << x;
    EXPECT_NEAR(across[2], middle[2], 1e-12 * middle[2]) << x;
  }
  // A body that is wider than the box fills it once.
  const std::string wide = "bodies.disc.radius=15 m";
  EXPECT_EQ(start<2>(box_across(0), {wide})->particles.size(), start<2>(box_across(4), {wide})->particles.size());
}

TEST(PeriodicBodies, BodiesThatMeetAcrossAPeriodicFaceOverlap) {
  const std::string other = R"([[bodies]]
name = "other"
material = "copper"
shape = "disc"
center = ["-9 m", "0 m"]
radius = "2 m")";
  start<2>(box_across(0, other));
  for (const double x : {9.0, -11.0}) try {
      start<2>(box_across(x, other));
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("with disc"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace ejecta
