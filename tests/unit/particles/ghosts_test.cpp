#include "particles/ghosts.hpp"

#include <gtest/gtest.h>

#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

Boundary unit_box(BoundaryKind kind) { return {{kind, kind, kind}, {kind, kind, kind}, {0, 0, 0}, {1, 1, 1}}; }

/// Positions of the images of one particle at x in the unit box.
template <int Dim>
std::vector<Vec<Dim>> images_of(const Vec<Dim>& x, const Boundary& boundary, double reach) {
  auto p = random_cloud<Dim>(1, 1, 0.1, 0.1);
  p.set_vector(Field::position, 0, x);
  GhostList<Dim> list;
  find_ghosts(p, {}, boundary, reach, list);
  std::vector<Vec<Dim>> places;
  for (const Ghost& ghost : list.ghosts) {
    Vec<Dim> place;
    for (int a = 0; a < Dim; ++a) place[a] = list.transform(ghost).position(a, x[a]);
    places.push_back(place);
  }
  return places;
}

template <int Dim>
bool contains(const std::vector<Vec<Dim>>& places, const Vec<Dim>& x) {
  return std::any_of(places.begin(), places.end(), [&](const Vec<Dim>& p) { return (p - x).norm() < 1e-14; });
}

TEST(Ghosts, OpenSpaceHasNone) {
  EXPECT_FALSE(Boundary{}.bounded());
  EXPECT_TRUE(images_of<3>({0.01, 0.01, 0.01}, Boundary{}, 0.1).empty());
}

TEST(Ghosts, NoneFarFromTheFaces) {
  EXPECT_TRUE(images_of<3>({0.5, 0.5, 0.5}, unit_box(BoundaryKind::periodic), 0.1).empty());
}

TEST(Ghosts, APeriodicCornerHasImagesAtTheOtherCorners) {
  const auto places = images_of<2>({0.01, 0.98}, unit_box(BoundaryKind::periodic), 0.1);
  EXPECT_EQ(places.size(), 3u);
  EXPECT_TRUE(contains<2>(places, {1.01, 0.98}));
  EXPECT_TRUE(contains<2>(places, {0.01, -0.02}));
  EXPECT_TRUE(contains<2>(places, {1.01, -0.02}));
  EXPECT_EQ(images_of<3>({0.01, 0.98, 0.02}, unit_box(BoundaryKind::periodic), 0.1).size(), 7u);
}

TEST(Ghosts, AReflectingCornerMirrors) {
  const auto places = images_of<2>({0.01, 0.98}, unit_box(BoundaryKind::reflecting), 0.1);
  EXPECT_EQ(places.size(), 3u);
  EXPECT_TRUE(contains<2>(places, {-0.01, 0.98}));
  EXPECT_TRUE(contains<2>(places, {0.01, 1.02}));
  EXPECT_TRUE(contains<2>(places, {-0.01, 1.02}));
}

TEST(Ghosts, EachFaceHasItsKind) {
  Boundary floor;
  floor.lower[1] = BoundaryKind::reflecting;
  floor.min[1] = 0;
  EXPECT_TRUE(floor.bounded());
  EXPECT_EQ(images_of<2>({0.01, 0.02}, floor, 0.1).size(), 1u);
  EXPECT_TRUE(contains<2>(images_of<2>({0.01, 0.02}, floor, 0.1), {0.01, -0.02}));
  EXPECT_TRUE(images_of<2>({0.01, 0.98}, floor, 0.1).empty()) << "no face above";
  auto p = random_cloud<2>(2, 2, 0.1, 0.1);
  p.set_vector(Field::position, 0, Vec<2>(0.5, -0.25));
  p.set_vector(Field::position, 1, Vec<2>(0.5, 1e6));
  wrap_positions(p, floor);
  EXPECT_EQ(p.vector(Field::position, 0), Vec<2>(0.5, 0.25));
  EXPECT_EQ(p.vector(Field::position, 1), Vec<2>(0.5, 1e6));

  floor.upper[1] = BoundaryKind::symmetry;
  floor.max[1] = 1;
  GhostList<2> list;
  p.set_vector(Field::position, 1, Vec<2>(0.5, 0.95));
  p.set_vector(Field::position, 0, Vec<2>(0.5, 0.05));
  find_ghosts(p, {}, floor, 0.1, list);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_TRUE(list.transform(list.ghosts[0]).behind_wall);
  EXPECT_FALSE(list.transform(list.ghosts[1]).behind_wall) << "a plane of symmetry";
}

TEST(Ghosts, GuestsAreSeenAsTheyAreAndInMirrors) {
  auto p = random_cloud<2>(1, 1, 0.1, 0.1), guest = random_cloud<2>(2, 2, 0.1, 0.1);
  p.set_vector(Field::position, 0, Vec<2>(0.5, 0.5));
  guest.set_vector(Field::position, 0, Vec<2>(0.6, 0.5));
  guest.set_vector(Field::position, 1, Vec<2>(0.95, 0.5));
  Boundary wall;
  wall.upper[0] = BoundaryKind::reflecting;
  wall.max[0] = 1;
  GhostList<2> list;
  find_ghosts(p, {&guest}, wall, 0.1, list);
  ASSERT_EQ(list.size(), 3u);
  for (const Ghost& ghost : list.ghosts) EXPECT_EQ(&list.owner(ghost, p), &guest);
  const auto at = [&](std::size_t k) {
    const Ghost& ghost = list.ghosts[k];
    return list.transform(ghost).position(0, guest.column(Field::position)[ghost.source]);
  };
  EXPECT_EQ(at(0), 0.6);
  EXPECT_EQ(at(1), 0.95);
  EXPECT_NEAR(at(2), 1.05, 1e-15);
}

TEST(Ghosts, LeaversOfAPeriodicBoxComeBackIn) {
  const std::array<BoundaryKind, 3> kinds{BoundaryKind::periodic, BoundaryKind::open, BoundaryKind::open};
  const Boundary box{kinds, kinds, {0, 0, 0}, {1, 1, 1}};
  auto p = random_cloud<2>(3, 2, 0.1, 0.1);
  p.set_vector(Field::position, 0, Vec<2>(-0.25, -0.25));
  p.set_vector(Field::position, 1, Vec<2>(1.25, 1.25));
  p.set_vector(Field::position, 2, Vec<2>(1, 0.5));
  wrap_positions(p, box);
  EXPECT_EQ(p.vector(Field::position, 0), Vec<2>(0.75, -0.25));
  EXPECT_EQ(p.vector(Field::position, 1), Vec<2>(0.25, 1.25));
  EXPECT_EQ(p.vector(Field::position, 2), Vec<2>(0, 0.5));
}

TEST(Ghosts, WhatCrossedAReflectingFaceComesBackAsItsMirrorImage) {
  const std::array<BoundaryKind, 3> kinds{BoundaryKind::open, BoundaryKind::reflecting, BoundaryKind::open};
  const Boundary box{kinds, kinds, {0, 0, 0}, {1, 1, 1}};
  Particles<3> p;
  p.allocate(2, std::array{Field::deviatoric_stress, Field::stress_rate, Field::damage_tensor, Field::uncut_gradient});
  p.set_vector(Field::position, 0, Vec<3>(-0.25, -0.25, 0.5));
  p.set_vector(Field::position, 1, Vec<3>(0.5, 1.25, 0.5));
  for (std::size_t i = 0; i < 2; ++i) {
    p.set_vector(Field::velocity, i, Vec<3>(1, 2, 3));
    for (int a = 0; a < 3; ++a) p.previous(Field::acceleration, a)[i] = 1 + a;
    for (int k = 0; k < 5; ++k) p.column(Field::deviatoric_stress, k)[i] = 1 + k;  // xx, yy, xy, xz, yz
    for (int k = 0; k < 5; ++k) p.expected(Field::stress_rate, k)[i] = 1 + k;
    for (int k = 0; k < 6; ++k) p.column(Field::damage_tensor, k)[i] = 1 + k;  // xx, yy, zz, xy, xz, yz
    for (int k = 0; k < 9; ++k) p.column(Field::uncut_gradient, k)[i] = 1 + k;
  }
  wrap_positions(p, box);
  EXPECT_EQ(p.vector(Field::position, 0), Vec<3>(-0.25, 0.25, 0.5));
  EXPECT_EQ(p.vector(Field::position, 1), Vec<3>(0.5, 0.75, 0.5));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(p.vector(Field::velocity, i), Vec<3>(1, -2, 3));
    EXPECT_EQ(p.previous(Field::acceleration, 1)[i], -2);
    const std::array<double, 5> mirrored{1, 2, -3, 4, -5};
    for (int k = 0; k < 5; ++k) {
      EXPECT_EQ(p.column(Field::deviatoric_stress, k)[i], mirrored[static_cast<std::size_t>(k)]);
      EXPECT_EQ(p.expected(Field::stress_rate, k)[i], mirrored[static_cast<std::size_t>(k)]);
    }
    Mat<3> tensor, gradient;
    tensor << 1, -4, 5, -4, 2, -6, 5, -6, 3;
    gradient << 1, -2, 3, -4, 5, -6, 7, -8, 9;
    EXPECT_EQ(p.symmetric(Field::damage_tensor, i), tensor);
    EXPECT_EQ(p.tensor(Field::uncut_gradient, i), gradient);
  }
}

}  // namespace
}  // namespace ejecta
