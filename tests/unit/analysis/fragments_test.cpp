/// What is told of the fragments found, and their numbers through a run.
#include "analysis/fragments.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "unit/analysis/fragment_cloud.hpp"

namespace ejecta {
namespace {

/// A ball at the corner of the box, its particles put back in at the other sides.
TEST(Fragments, APieceAcrossPeriodicFacesIsWhole) {
  Cloud inside, across;
  inside.add_ball({0, 0, 0}, 4, {3, -1, 2}, {0.1, -0.2, 0.25});
  across = inside;
  across.box = {PeriodicAxis{-1, 20}, PeriodicAxis{-20.5, 21}, PeriodicAxis{}};
  for (double& x : across.x[0]) x += x < -1 ? 20 : 0;
  for (double& y : across.x[1]) y -= y >= 0.5 ? 21 : 0;
  const FragmentTable expected = describe_groups(inside.input(), find_groups(inside.input(), {}));
  const FragmentTable table = describe_groups(across.input(), find_groups(across.input(), {}));
  ASSERT_EQ(table.fragments.size(), 1u);
  const Fragment &one = expected.fragments[0], &other = table.fragments[0];
  EXPECT_EQ(other.carried.particles, inside.mass.size());
  EXPECT_NEAR((other.centre - one.centre).norm(), 0, 1e-13);
  EXPECT_NEAR((other.spin - one.spin).norm(), 0, 1e-13);
  EXPECT_NEAR((other.semi_axes - one.semi_axes).norm(), 0, 1e-13);
}

TEST(Fragments, APieceRoundTheWholeBoxIsOne) {
  Cloud bar;
  for (int i = 0; i < 12; ++i) bar.add({i + 0.5, 0, 0}, Vec<3>::Zero());
  bar.box[0] = {0, 12};
  const FragmentTable table = describe_groups(bar.input(), find_groups(bar.input(), {}));
  ASSERT_EQ(table.fragments.size(), 1u);
  EXPECT_NEAR(table.fragments[0].semi_axes[0], std::sqrt(5.0 * 144 / 12), 1e-12);  // unwrapped somewhere, not folded
}

TEST(Fragments, ABarPointsAlongItself) {
  Cloud bar;
  for (int i = 0; i < 12; ++i) bar.add({-0.6 * i, 0.8 * i, 0}, Vec<3>::Zero());
  const FragmentTable table = describe_groups(bar.input(), find_groups(bar.input(), {}));
  ASSERT_EQ(table.fragments.size(), 1u);
  EXPECT_NEAR((table.fragments[0].long_axis - Vec<3>(-0.6, 0.8, 0)).norm(), 0, 1e-12);
}

TEST(Fragments, PiecesOfTheTargetComeFirst) {
  Cloud cloud;
  cloud.add_ball({0, 0, 0}, 4, Vec<3>::Zero(), Vec<3>::Zero(), 0);
  cloud.add_ball({20, 0, 0}, 2, Vec<3>::Zero(), Vec<3>::Zero(), 1);
  cloud.add_ball({40, 0, 0}, 3, Vec<3>::Zero(), Vec<3>::Zero(), 1);
  cloud.add({60, 0, 0}, Vec<3>::Zero(), 1, 1, 0, 1);  // dust
  FragmentInput in = cloud.input();
  in.target = 1;
  const FragmentTable table = describe_groups(in, find_groups(in, {}));
  ASSERT_EQ(table.fragments.size(), 3u);
  EXPECT_EQ(table.fragments[0].carried.mass, 123);
  EXPECT_EQ(table.fragments[1].carried.mass, 33);
  EXPECT_EQ(table.fragments[2].carried.mass, 257);
  EXPECT_EQ(table.largest_mass(1), 123);
  const FragmentSensitivity outcome = fragment_sensitivity(in, {})[1];
  EXPECT_DOUBLE_EQ(outcome.largest_mass_fraction, 123.0 / 157);
  EXPECT_DOUBLE_EQ(outcome.dust_mass_fraction, 1.0 / 157);
}

TEST(Fragments, TwoBallsAndTheirDust) {
  Cloud cloud;
  cloud.add_ball({0, 0, 0}, 4, {1, 0, 0}, {0, 0, 0.25}, 0);
  const std::size_t first = cloud.mass.size();
  cloud.add_ball({20, 0, 0}, 3, {-2, 0, 1}, {0.5, 0, 0}, 1);
  const std::size_t second = cloud.mass.size() - first;
  cloud.add({10, 0, 0}, {0, 3, 0});                      // alone
  cloud.add({0.5, 0.5, 0.5}, {0, 0, 0}, 1.0, 1.0, 1.0);  // inside the first ball but shattered
  const FragmentTable table = describe_groups(cloud.input(), find_groups(cloud.input(), {}));
  ASSERT_EQ(table.fragments.size(), 2u);
  const Fragment &big = table.fragments[0], &small = table.fragments[1];
  EXPECT_EQ(big.carried.particles, first);
  EXPECT_EQ(small.carried.particles, second);
  EXPECT_EQ(table.dust.particles, 2u);
  EXPECT_NEAR((small.centre - Vec<3>(20, 0, 0)).norm(), 0, 1e-13);
  EXPECT_NEAR((small.velocity - Vec<3>(-2, 0, 1)).norm(), 0, 1e-13);
  EXPECT_NEAR((big.spin - Vec<3>(0, 0, 0.25)).norm(), 0, 1e-13);
  EXPECT_NEAR((small.spin - Vec<3>(0.5, 0, 0)).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(big.mass_by_body[0], static_cast<double>(first));
  EXPECT_DOUBLE_EQ(small.mass_by_material[1], static_cast<double>(second));
  EXPECT_NEAR(big.semi_axes[0], std::cbrt(static_cast<double>(first) * 0.75 / M_PI), 0.02 * big.semi_axes[0]);
  EXPECT_NEAR(big.semi_axes[0], big.semi_axes[2], 1e-12);
}

TEST(Fragments, SumsEqualTotalsToRoundOff) {
  for (const int dimension : {2, 3}) {
    Cloud cloud = random_cloud(dimension, 4000, 3);
    cloud.piece_of_body = {0, 0, 0};  // welded: apart, the mixture would hardly hang together
    FragmentSettings settings;
    settings.damage_threshold = 0.9;
    const FragmentTable table = describe_groups(cloud.input(), find_groups(cloud.input(), settings));
    ASSERT_GT(table.fragments.size(), 3u);
    ASSERT_GT(table.dust.particles, 100u);
    Carried sum = table.dust;
    for (const Fragment& f : table.fragments) sum += f.carried;
    double mass = 0, momentum_scale = 0, angular_scale = 0;
    Vec<3> momentum = Vec<3>::Zero(), angular = Vec<3>::Zero();
    for (std::size_t i = 0; i < cloud.mass.size(); ++i) {
      const Vec<3> x(cloud.x[0][i], cloud.x[1][i], cloud.x[2][i]), v(cloud.v[0][i], cloud.v[1][i], cloud.v[2][i]);
      mass += cloud.mass[i];
      momentum += cloud.mass[i] * v;
      angular += cloud.mass[i] * x.cross(v);
      momentum_scale += cloud.mass[i] * v.norm();
      angular_scale += cloud.mass[i] * x.norm() * v.norm();
    }
    EXPECT_EQ(sum.particles, cloud.mass.size());
    EXPECT_NEAR(sum.mass / mass, 1, 1e-14);
    EXPECT_NEAR((sum.momentum - momentum).norm() / momentum_scale, 0, 1e-14);
    EXPECT_NEAR((sum.angular_momentum - angular).norm() / angular_scale, 0, 1e-14);
  }
}

TEST(Fragments, FarFlungParticlesAreHarmless) {
  Cloud cloud;
  cloud.add_ball({0, 0, 0}, 6, Vec<3>::Zero());
  const std::size_t ball = cloud.mass.size();
  for (int k = 0; k < 40; ++k) cloud.add({1e6 * (k + 1), -1e7 * k, 1e300 * k}, {1e3, 0, 0});
  cloud.add({-1e6, 0, 0}, Vec<3>::Zero(), 1.0, 1e4);  // and one blown up ten thousand times
  const FragmentTable table = describe_groups(cloud.input(), find_groups(cloud.input(), {}));
  ASSERT_EQ(table.fragments.size(), 1u);
  EXPECT_EQ(table.fragments[0].carried.particles, ball);
  EXPECT_EQ(table.dust.particles, 41u);
}

TEST(Fragments, NumbersFollowTheMassThroughABreakUp) {
  FragmentTracker tracker;
  Cloud before;
  before.add_ball({0, 0, 0}, 3, Vec<3>::Zero());
  const std::size_t small = before.mass.size();
  before.add_ball({20, 0, 0}, 4, Vec<3>::Zero());
  const FragmentTable first = tracker.update(before.input(), {});
  ASSERT_EQ(first.fragments.size(), 2u);
  EXPECT_EQ(first.fragments[0].number, 1);
  EXPECT_EQ(first.number[0], 2);

  // The big ball breaks into two; its smaller part is now lighter than the untouched ball.
  Cloud after = before;
  for (std::size_t i = small; i < after.mass.size(); ++i)
    if (after.x[0][i] > 22) after.x[0][i] += 10;
  const FragmentTable second = tracker.update(after.input(), {});
  ASSERT_EQ(second.fragments.size(), 3u);
  EXPECT_EQ(second.fragments[0].number, 1);
  EXPECT_EQ(second.number[0], 2);
  for (std::size_t i = small; i < after.mass.size(); ++i) EXPECT_EQ(second.number[i], after.x[0][i] > 22 ? 3 : 1);
  EXPECT_EQ(tracker.last_number(), 3);

  // Particle order means nothing: a tracker restored from a checkpoint and fed reversed columns agrees.
  FragmentTracker restored;
  restored.restore(after.id, second.number, tracker.last_number());
  Cloud reversed = after;
  for (auto* column : {&reversed.x[0], &reversed.x[1], &reversed.x[2], &reversed.mass, &reversed.density})
    std::reverse(column->begin(), column->end());
  std::reverse(reversed.id.begin(), reversed.id.end());
  const FragmentTable third = restored.update(reversed.input(), {});
  for (std::size_t i = 0; i < third.number.size(); ++i)
    EXPECT_EQ(third.number[i], second.number[static_cast<std::size_t>(reversed.id[i])]);
}

TEST(Fragments, NoParticlesNoFragments) {
  Cloud cloud;
  const FragmentTable table = FragmentTracker().update(cloud.input(), {});
  EXPECT_TRUE(table.fragments.empty());
  EXPECT_EQ(table.dust.particles, 0u);
}

}  // namespace
}  // namespace ejecta
