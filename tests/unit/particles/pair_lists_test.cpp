#include "particles/pair_lists.hpp"

#include <gtest/gtest.h>

#include <set>

#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

const Boundary open_space{};

template <int Dim>
std::size_t total_candidates(const PairLists<Dim>& lists) {
  std::size_t total = 0;
  for (std::size_t c = 0; c < lists.clusters().size(); ++c) total += lists.candidates(c).size();
  return total;
}

template <int Dim>
typename PairLists<Dim>::Settings settings_of(double support, std::size_t cluster, double horizon = 0,
                                              const Boundary& boundary = open_space) {
  return {support, cluster, horizon, boundary};
}

template <int Dim>
void random_velocities(Particles<Dim>& p, double speed, unsigned seed) {
  Uniform uniform(seed);
  for (int a = 0; a < Dim; ++a)
    for (double& v : p.column(Field::velocity, a)) v = uniform(-speed, speed);
}

template <int Dim>
void drift(Particles<Dim>& p, double dt) {
  for (int a = 0; a < Dim; ++a)
    for (std::size_t i = 0; i < p.size(); ++i) p.column(Field::position, a)[i] += dt * p.column(Field::velocity, a)[i];
}

TEST(PairLists, NameEveryPairWithinTheLargerSupport) {
  for (const std::size_t cluster : {8u, 16u})
    for (const double h_high : {0.05, 0.4}) {  // all alike; sizes in the ratio 1 : 20
      auto p3 = random_cloud<3>(700, 1, h_high > 0.1 ? 0.02 : 0.05, h_high);
      auto p2 = random_cloud<2>(701, 2, h_high > 0.1 ? 0.02 : 0.05, h_high);
      sort_in_space(p3, cluster);
      sort_in_space(p2, cluster);
      PairLists<3> lists3;
      PairLists<2> lists2;
      lists3.build(p3, settings_of<3>(2, cluster));
      lists2.build(p2, settings_of<2>(3, cluster));
      EXPECT_EQ(missed_neighbours(p3, lists3, open_space, 2), 0u);
      EXPECT_EQ(missed_neighbours(p2, lists2, open_space, 3), 0u);
    }
}

TEST(PairLists, NameNoCandidateTwice) {
  auto p = random_cloud<3>(500, 3, 0.05, 0.2);
  sort_in_space(p, 8);
  PairLists<3> lists;
  lists.build(p, settings_of<3>(2, 8));
  for (std::size_t c = 0; c < lists.clusters().size(); ++c) {
    const auto candidates = lists.candidates(c);
    EXPECT_EQ(std::set<std::uint32_t>(candidates.begin(), candidates.end()).size(), candidates.size());
  }
}

TEST(PairLists, ClustersKeepToOneMaterialAndCoverAll) {
  auto p = random_cloud<2>(101, 4, 0.05, 0.05);
  p.set_material_ranges({{0, 37}, {37, 37}, {37, 101}});
  sort_in_space(p, 8);
  PairLists<2> lists;
  lists.build(p, settings_of<2>(2, 8));
  std::size_t next = 0;
  for (const Cluster& c : lists.clusters()) {
    EXPECT_EQ(c.begin, next);
    EXPECT_LE(c.end - c.begin, 8u);
    EXPECT_EQ(c.begin < 37, c.end <= 37);
    next = c.end;
  }
  EXPECT_EQ(next, 101u);
}

TEST(PairLists, AFarFlungParticleWithAHugeSupportCostsTheOthersNothing) {
  auto near = random_cloud<3>(4001, 5, 0.06, 0.07);
  sort_in_space(near, 8);
  PairLists<3> lists;
  lists.build(near, settings_of<3>(2, 8));
  const std::size_t before = total_candidates(lists);

  auto with_far = random_cloud<3>(4001, 5, 0.06, 0.07);
  with_far.set_vector(Field::position, 4000, Vec<3>(1000, 300, 0));
  with_far.column(Field::smoothing_length)[4000] = 400;  // reaches 800: not as far as the others
  with_far.column(Field::velocity)[4000] = 1e4;
  sort_in_space(with_far, 8);
  lists.build(with_far, settings_of<3>(2, 8, 1e-4));
  // What is left is the shape of the few clusters that share its branch of the order: halving the long way round makes
  // slabs of them.
  EXPECT_LT(total_candidates(lists), 1.07 * static_cast<double>(before));
  EXPECT_EQ(missed_neighbours(with_far, lists, open_space, 2), 0u);

  // Within reach it becomes one more candidate of everybody, and everybody one of its own cluster's.
  for (double& h : with_far.column(Field::smoothing_length)) h = h > 1 ? 2000 : h;
  lists.build(with_far, settings_of<3>(2, 8, 1e-4));
  EXPECT_EQ(missed_neighbours(with_far, lists, open_space, 2), 0u);
  EXPECT_LT(total_candidates(lists), 1.07 * static_cast<double>(before) + 4001 + 4001.0 / 8);
}

/// Moves particles step by step; as long as the lists call themselves valid, no neighbour may be missing.
template <int Dim>
int steps_until_invalid(Particles<Dim> p, const Boundary& boundary, double horizon, double dt, double growth) {
  sort_in_space(p, 8);
  PairLists<Dim> lists;
  lists.build(p, settings_of<Dim>(2, 8, horizon, boundary));
  for (int step = 0; step < 1000; ++step) {
    if (!lists.valid(p, step * dt)) return step;
    EXPECT_EQ(missed_neighbours(p, lists, boundary, 2), 0u) << "after " << step << " steps";
    drift(p, dt);
    for (double& h : p.column(Field::smoothing_length)) h *= growth;
  }
  return 1000;
}

TEST(PairLists, MissNobodyWhileTheyAreValid) {
  auto p2 = random_cloud<2>(300, 6, 0.04, 0.1);
  random_velocities(p2, 1.0, 7);
  auto p3 = random_cloud<3>(400, 8, 0.06, 0.15);
  random_velocities(p3, 1.0, 9);
  for (const double growth : {1.0, 1.002}) {
    const int steps2 = steps_until_invalid(p2, open_space, 0.01, 0.001, growth);
    const int steps3 = steps_until_invalid(p3, open_space, 0.01, 0.001, growth);
    // Each particle may move for the horizon of ten steps and three per cent of its support more.
    EXPECT_GE(steps2, growth > 1 ? 8 : 10);
    EXPECT_GE(steps3, growth > 1 ? 8 : 10);
    EXPECT_LT(steps2, 50);
    EXPECT_LT(steps3, 50);
  }
}

TEST(PairLists, AParticleThatAcceleratesInvalidatesThem) {
  auto p = random_cloud<3>(200, 10, 0.1, 0.1);
  sort_in_space(p, 8);
  PairLists<3> lists;
  lists.build(p, settings_of<3>(2, 8, 1.0));
  p.column(Field::position)[123] += 0.029 * 0.2;  // a resting particle may move by 3 % of its support
  EXPECT_TRUE(lists.valid(p, 0));
  p.column(Field::position)[123] += 0.002 * 0.2;
  EXPECT_FALSE(lists.valid(p, 0));
}

TEST(PairLists, ACommonVelocityMakesNoDifference) {
  auto p = random_cloud<3>(400, 11, 0.06, 0.1);
  random_velocities(p, 1.0, 12);
  auto boosted = p;
  for (double& v : boosted.column(Field::velocity)) v += 1e4;
  const int steps = steps_until_invalid(p, open_space, 0.01, 0.001, 1.0);
  EXPECT_EQ(steps_until_invalid(boosted, open_space, 0.01, 0.001, 1.0), steps);
  PairLists<3> lists, boosted_lists;
  lists.build(p, settings_of<3>(2, 8, 0.01));
  boosted_lists.build(boosted, settings_of<3>(2, 8, 0.01));
  EXPECT_EQ(total_candidates(lists), total_candidates(boosted_lists));
}

TEST(PairLists, GhostsStandBeyondPeriodicAndReflectingFaces) {
  for (const BoundaryKind x : {BoundaryKind::periodic, BoundaryKind::reflecting})
    for (const BoundaryKind y : {BoundaryKind::open, BoundaryKind::periodic, BoundaryKind::reflecting}) {
      const Boundary box{{x, y, x}, {x, y, x}, {0, 0, 0}, {1, 1, 1}};
      auto p2 = random_cloud<2>(250, 13, 0.03, 0.1);
      auto p3 = random_cloud<3>(300, 14, 0.05, 0.1);
      sort_in_space(p2, 8);
      sort_in_space(p3, 16);
      PairLists<2> lists2;
      PairLists<3> lists3;
      lists2.build(p2, settings_of<2>(2, 8, 0, box));
      lists3.build(p3, settings_of<3>(2, 16, 0, box));
      EXPECT_EQ(missed_neighbours(p2, lists2, box, 2), 0u);
      EXPECT_EQ(missed_neighbours(p3, lists3, box, 2), 0u);
      EXPECT_GT(lists3.ghosts().size(), 100u);
    }
}

TEST(PairLists, MissNoImageWhileEverythingMovesTowardsAWall) {
  for (const BoundaryKind kind : {BoundaryKind::reflecting, BoundaryKind::periodic}) {
    const std::array<BoundaryKind, 3> kinds{kind, BoundaryKind::open, BoundaryKind::open};
    const Boundary box{kinds, kinds, {0, 0, 0}, {1, 1, 1}};
    auto p = random_cloud<2>(300, 15, 0.04, 0.06);
    random_velocities(p, 0.1, 16);
    for (double& v : p.column(Field::velocity)) v -= 1;
    for (double& x : p.column(Field::position)) x = 0.08 + 0.6 * x;  // out of reach of their images at first
    const int steps = steps_until_invalid(p, box, 0.05, 0.005, 1.0);
    EXPECT_GE(steps, 10);
    EXPECT_LT(steps, 1000);
  }
}

TEST(PairLists, CoincidentParticlesAreAllCandidates) {
  auto p = random_cloud<3>(40, 17, 0.1, 0.1);
  for (std::size_t i = 0; i < p.size(); ++i) p.set_vector(Field::position, i, Vec<3>(0.5, 0.5, 0.5));
  sort_in_space(p, 8);
  PairLists<3> lists;
  lists.build(p, settings_of<3>(2, 8));
  for (std::size_t c = 0; c < lists.clusters().size(); ++c) EXPECT_EQ(lists.candidates(c).size(), 40u);
}

TEST(PairLists, ServeNoParticlesAndOne) {
  auto none = random_cloud<3>(0, 18, 0.1, 0.1);
  PairLists<3> lists;
  EXPECT_FALSE(lists.built());
  lists.build(none, settings_of<3>(2, 8));
  EXPECT_TRUE(lists.clusters().empty());
  EXPECT_EQ(lists.mean_candidates(), 0);

  auto one = random_cloud<3>(1, 19, 0.1, 0.1);
  lists.build(one, settings_of<3>(2, 8));
  ASSERT_EQ(lists.clusters().size(), 1u);
  ASSERT_EQ(lists.candidates(0).size(), 1u);
  EXPECT_EQ(lists.candidates(0)[0], 0u);
  EXPECT_TRUE(lists.valid(one, 0));
  EXPECT_FALSE(lists.valid(none, 0)) << "the number of particles has changed";
  lists.invalidate();
  EXPECT_FALSE(lists.valid(one, 0));
}

}  // namespace
}  // namespace ejecta
