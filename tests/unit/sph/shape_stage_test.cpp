#include <gtest/gtest.h>

#include <random>

#include "sph/stages.hpp"
#include "unit/base/thread_counts.hpp"
#include "unit/schemes/node_set.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

constexpr double edge = 1, spacing = 1.0 / 16;

/// A box full of gas, periodic along x and with mirrors along y; each coordinate displaced by up to `jitter` spacings.
/// Metrics round.
std::unique_ptr<Sph<2>> gas_box(double jitter) {
  auto sim = start<2>(R"([scene]
name = "gas_box"
dimension = 2
[resolution]
spacing = "62.5 mm"
[time]
end = "1 s"
[[bodies]]
name = "gas"
material = "air"
shape = "rectangle"
size = ["1 m", "1 m"]
density = "1 kg/m^3"
pressure = "1 Pa"
[numerics]
scheme = "asph"
nodes_per_h = 1.5
[boundary]
x = "periodic"
y = "reflecting"
min = ["-0.5 m", "-0.5 m"]
max = ["0.5 m", "0.5 m"]
)");
  Particles<2>& p = sim->particles;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-jitter * spacing, jitter * spacing);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (int a = 0; a < 2; ++a) p.column(Field::position, a)[i] += uniform(random);
    p.set_symmetric(Field::smoothing_metric, i, Mat<2>::Identity() / std::pow(1.5 * spacing, 2));
    p.column(Field::smoothing_length)[i] = 1.5 * spacing;
  }
  sim->lists.invalidate();
  renew_lists(*sim);
  return sim;
}

/// The box and its mirror image along y: a periodic set. Nodes 2i and 2i + 1 are particle i and its image.
NodeSet<2> unfolded(const Sph<2>& sim) {
  NodeSet<2> set;
  set.box = Vec<2>(edge, 2 * edge).asDiagonal();
  for (std::size_t i = 0; i < sim.particles.size(); ++i) {
    const Vec<2> x = sim.particles.vector(Field::position, i);
    set.x.push_back(x);
    set.x.push_back({x[0], edge - x[1]});
    for (int k = 0; k < 2; ++k) set.metric.push_back(sim.particles.symmetric(Field::smoothing_metric, i));
  }
  return set;
}

Mat<2> unimodular(const Mat<2>& m) { return m / std::sqrt(m.determinant()); }

TEST(ShapeStage, VotesAsThePeriodicSetThatTheBoxStandsFor) {
  auto sim = gas_box(0.2);
  auto set = unfolded(*sim);
  const Mat<2> before = sim->particles.symmetric(Field::smoothing_metric, 0);
  sim->clock.step = 2 * sim->scene.numerics.shape_interval;
  vote_shapes<2>().run(*sim);
  vote(set, {});
  double largest = 1;
  for (std::size_t i = 0; i < sim->particles.size(); ++i) {
    const Mat<2> metric = sim->particles.symmetric(Field::smoothing_metric, i);
    EXPECT_LT((unimodular(metric) - unimodular(set.metric[2 * i])).norm(), 1e-10);
    EXPECT_NEAR(metric.determinant(), before.determinant(),
                1e-10 * before.determinant());  // sizes are not its business
    largest = std::max(largest, aspect<2>(metric));
  }
  EXPECT_GT(largest, 1.1);
  EXPECT_EQ(sim->shape_report.votes, static_cast<std::int64_t>(sim->particles.size()));
  EXPECT_EQ(sim->shape_report.few_neighbours, 0);
}

TEST(ShapeStage, SettlesShapesAndSizesAtTheStart) {
  auto sim = gas_box(0.1);
  for (double& x : sim->particles.column(Field::position, 0)) x *= 1.5;  // a stretch within what round lists reach
  sim->scene.boundary.min[0] = -0.75;
  sim->scene.boundary.max[0] = 0.75;
  sim->lists.invalidate();
  renew_lists(*sim);
  auto set = unfolded(*sim);
  set.box(0, 0) = 1.5;
  sim->clock.step = 0;
  vote_shapes<2>().run(*sim);
  vote(set, {.reach = 4}, 30);
  double mean = 0;
  for (std::size_t i = 0; i < sim->particles.size(); ++i) {
    const Mat<2> metric = sim->particles.symmetric(Field::smoothing_metric, i);
    EXPECT_LT((metric - set.metric[2 * i]).norm(), 1e-4 * metric.norm());
    const double h = sim->particles.column(Field::smoothing_length)[i];
    EXPECT_NEAR(h, std::pow(metric.determinant(), -0.25), 1e-12 * h);
    mean += aspect<2>(metric) / static_cast<double>(sim->particles.size());
  }
  EXPECT_NEAR(mean, 1.5, 0.09);  // measured: 1.557
}

TEST(ShapeStage, ActsOnlyWhenItIsTimeTo) {
  auto sim = gas_box(0.2);
  const auto before = by_id(sim->particles, Field::smoothing_metric, 2);
  sim->clock.step = sim->scene.numerics.shape_interval + 1;
  vote_shapes<2>().run(*sim);
  EXPECT_EQ(by_id(sim->particles, Field::smoothing_metric, 2), before);
  EXPECT_EQ(sim->shape_report.votes, 0);
}

TEST(ShapeStage, IsTheSameForEveryNumberOfThreads) {
  std::vector<std::vector<double>> results;
  for_thread_counts([&](int) {
    auto sim = gas_box(0.2);
    sim->clock.step = 0;
    vote_shapes<2>().run(*sim);
    sim->clock.step = sim->scene.numerics.shape_interval;
    vote_shapes<2>().run(*sim);
    results.emplace_back();
    for (int k = 0; k < 3; ++k)
      for (double value : by_id(sim->particles, Field::smoothing_metric, k)) results.back().push_back(value);
  });
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(ShapeStage, MaterialsVoteAmongThemselves) {
  // The same arrangement once as one material and once cut in two along x = 0: far from the cut nothing changes, and at
  // the cut each half is a block with a free surface, which votes for itself.
  auto whole = gas_box(0.2), halves = gas_box(0.2), alone = gas_box(0.2);
  for (auto* sim : {halves.get(), alone.get()})
    for (std::size_t i = 0; i < sim->particles.size(); ++i)
      if (sim->particles.column(Field::position, 0)[i] > 0) {
        sim->particles.label(Label::material)[i] = 1;
        if (sim == alone.get()) sim->particles.column(Field::position, 0)[i] = 0.25;  // out of reach of the cut
      }
  alone->lists.invalidate();
  renew_lists(*alone);
  for (auto* sim : {whole.get(), halves.get(), alone.get()}) {
    sim->clock.step = sim->scene.numerics.shape_interval;
    vote_shapes<2>().run(*sim);
  }
  int at_the_cut = 0, changed = 0;
  for (std::size_t i = 0; i < whole->particles.size(); ++i) {
    const double x = whole->particles.column(Field::position, 0)[i];
    if (x > 0 || x < -0.25) continue;
    const Mat<2> of_half = halves->particles.symmetric(Field::smoothing_metric, i);
    EXPECT_LT((of_half - alone->particles.symmetric(Field::smoothing_metric, i)).norm(), 1e-12 * of_half.norm());
    const Mat<2> of_whole = whole->particles.symmetric(Field::smoothing_metric, i);
    if (x > -1.2 * spacing) {
      ++at_the_cut;
      changed += (of_half - of_whole).norm() > 1e-3 * of_half.norm();
    }
  }
  EXPECT_GT(at_the_cut, 10);
  EXPECT_GT(changed, at_the_cut / 2);
}

}  // namespace
}  // namespace ejecta
