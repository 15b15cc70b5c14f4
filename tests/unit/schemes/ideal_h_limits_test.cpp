/// The ideal H where there is little to go by: surfaces, few neighbours, degenerate neighbourhoods, limits.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <limits>

#include "unit/schemes/node_set.hpp"

namespace ejecta {
namespace {

/// A block of nodes with spacing 1 in empty space, round metrics; `jitter` in spacings.
template <int Dim>
NodeSet<Dim> block(const std::array<int, 3>& count, double jitter = 0) {
  NodeSet<Dim> set;
  set.box = Mat<Dim>::Identity() * 1e4;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-jitter, jitter);
  for (int x = 0; x < count[0]; ++x)
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < (Dim == 3 ? count[2] : 1); ++z) {
        Vec<Dim> p;
        p[0] = x + uniform(random);
        p[1] = y + uniform(random);
        if constexpr (Dim == 3) p[2] = z + uniform(random);
        set.x.push_back(p);
      }
  set.metric.assign(set.x.size(), Mat<Dim>::Identity() / (1.5 * 1.5));
  return set;
}

TEST(IdealHAtSurfaces, BlocksStayRound) {
  auto square = block<2>({9, 9, 1});
  vote(square, {}, 10);
  EXPECT_LT(aspects(square).most, 1.0001);
  auto cube = block<3>({5, 5, 5});
  vote(cube, {}, 10);
  EXPECT_LT(aspects(cube).most, 1.0001);
  auto rough = block<2>({9, 9, 1}, 0.1);
  vote(rough, {}, 10);
  EXPECT_LT(aspects(rough).mean, 1.1);
  EXPECT_LT(aspects(rough).most, 1.4);
}

TEST(IdealHAtSurfaces, StretchedBlocksAreSeenAsStretchedUpToTheirFaces) {
  auto bar = block<3>({5, 5, 5});
  bar.deform(Vec<3>(4, 1, 1).asDiagonal(), true);
  vote(bar, {}, 10);
  EXPECT_NEAR(aspects(bar).least, 4, 0.04);
  EXPECT_NEAR(aspects(bar).most, 4, 0.04);
}

TEST(IdealHAtSurfaces, SheetsAndRowsLookTwiceAsFarWhereNobodyIs) {
  for (const auto& count : {std::array{7, 7, 1}, std::array{9, 1, 1}}) {
    auto set = block<3>(count);
    vote(set, {}, 10);
    EXPECT_NEAR(aspects(set).mean, 2, 0.01);
    EXPECT_LT(aspects(set).most, 2.01);
  }
  auto row = block<2>({9, 1, 1});
  vote(row, {}, 10);
  EXPECT_NEAR(aspects(row).mean, 2, 0.01);
  for (const auto& metric : row.metric) EXPECT_LT(metric(1, 1), metric(0, 0));  // longer across the row
  auto thick = block<3>({7, 7, 3});
  vote(thick, {}, 10);
  EXPECT_LT(aspects(thick).most, 1.001);
}

TEST(IdealHAtSurfaces, FewNeighboursKeepTheEvolvedShape) {
  for (const int nodes : {1, 2, 3}) {
    auto set = block<3>({nodes, 1, 1});
    for (auto& metric : set.metric) metric = Vec<3>(0.1, 0.2, 0.4).asDiagonal();
    const auto before = set.metric;
    for (const ShapeActions& actions : vote(set, {.fewest_neighbours = 6}, 1)) {
      EXPECT_TRUE(actions.kept);
      EXPECT_FALSE(actions.aspect || actions.change);
    }
    for (std::size_t i = 0; i < set.metric.size(); ++i) {  // the size may change
      const Mat<3> ratio = set.metric[i] * before[i].inverse();
      EXPECT_LT((ratio - ratio(0, 0) * Mat<3>::Identity()).norm(), 1e-12 * ratio.norm());
    }
  }
}

TEST(IdealHLimits, ActAndSayso) {
  auto set = lattice<2>(12, 1.5);
  set.deform(Vec<2>(std::sqrt(10), 1 / std::sqrt(10)).asDiagonal(), false);
  for (const ShapeActions& actions : vote(set, {.reach = 4, .largest_change = 1.2})) {
    EXPECT_TRUE(actions.change);
    EXPECT_NEAR(actions.moved, std::log(1.2), 1e-12);
    EXPECT_FALSE(actions.aspect || actions.kept);
  }
  EXPECT_NEAR(aspects(set).mean, 1.44, 1e-9);
  for (const ShapeActions& actions : vote(set, {.reach = 4, .largest_aspect = 5}, 12)) {
    EXPECT_TRUE(actions.aspect);
    EXPECT_FALSE(actions.kept);
  }
  EXPECT_NEAR(aspects(set).least, 5, 1e-9);
  EXPECT_NEAR(aspects(set).most, 5, 1e-9);
  for (const ShapeActions& actions : vote(set, {.reach = 4, .largest_aspect = 20}, 12))
    EXPECT_FALSE(actions.aspect || actions.change || actions.kept);
}

TEST(IdealHLimits, TheShapeLeavesTheDeterminant) {
  const Mat<3> metric = Vec<3>(4, 9, 0.5).asDiagonal();
  ShapeActions actions;
  Symmetric<3> log_covariance;
  log_covariance << 0.4, -0.6, 0.2, 0.3, -0.2, 0.1;
  for (const double largest_aspect : {1.2, 10.0}) {
    const Mat<3> result = reshaped<3>(metric, log_covariance, false, {largest_aspect, 2, 0}, actions);
    EXPECT_NEAR(result.determinant(), metric.determinant(), 1e-12 * metric.determinant());
  }
}

TEST(IdealHLimits, CrowdsKeepTheNearest) {
  // A square of 8 neighbours amid many more than there is room for, farther out: any order gives the same vote.
  std::vector<Vec<2>> crowd{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < 200; ++k) {
    const double r = 1.45 + 0.5 * uniform(random), angle = 6.283 * uniform(random);
    crowd.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  const auto vote_of = [](const std::vector<Vec<2>>& nodes) {
    FirstShell<2> shell(Mat<2>::Identity() / 2.25, 1.5, 2);
    for (const auto& x : nodes) shell.add(x);
    EXPECT_EQ(shell.neighbours(), 208);
    return shell.vote(2);
  };
  for (int order = 0; order < 10; ++order) {
    std::ranges::shuffle(crowd, random);
    const ShapeVote<2> vote = vote_of(crowd);
    EXPECT_LT(vote.log_covariance.norm(), 1e-12);
    EXPECT_NEAR(vote.spacing, 1, 1e-12);
    EXPECT_EQ(vote.confidence, 1);
  }
}

TEST(IdealHLimits, ANeighbourOnTheSamePlaceHasNoSay) {
  const auto vote_of = [](std::vector<Vec<2>> nodes) {
    FirstShell<2> shell(Mat<2>::Identity() / 2.25, 1.5, 2);
    for (const auto& x : nodes) shell.add(x);
    return shell.vote(2);
  };
  const ShapeVote<2> without = vote_of({{1.2, 0}, {0, 1}, {-1.1, 0}, {0, -1}}),
                     with = vote_of({{1.2, 0}, {0, 1}, {-1.1, 0}, {0, -1}, {1e-9, 0}});
  EXPECT_EQ(with.log_covariance, without.log_covariance);
}

/// Neighbourhoods of all kinds, also such as no run should ever see.
template <int Dim>
struct Hazard {
  std::mt19937_64 random{7};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int pick(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); }
  Vec<Dim> vector() {
    Vec<Dim> v;
    for (int a = 0; a < Dim; ++a) v[a] = uniform(-1, 1);
    return v;
  }
  /// SPD, aspect up to 1e3, any size between 1e-40 and 1e40. `size`: its det^(1/Dim).
  Mat<Dim> metric(double& size) {
    Mat<Dim> axes = Mat<Dim>::Identity();
    for (int a = 0; a < Dim; ++a) axes.col(a) += 0.9 * vector();
    const Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver(axes * axes.transpose());
    Vec<Dim> values;
    for (int a = 0; a < Dim; ++a) values[a] = std::pow(10, uniform(-3, 3));
    values *= pick(4) == 0 ? std::pow(10, uniform(-40, 40)) : 1;
    size = std::exp(values.array().log().mean());
    return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
  }
  /// Offsets in units of h, of `kind`.
  std::vector<Vec<Dim>> neighbours(int kind) {
    std::vector<Vec<Dim>> found(static_cast<std::size_t>(pick(kind == 0 ? 80 : 12)));
    const Vec<Dim> direction = vector(), other = vector(), place = vector();
    constexpr double odd[] = {0, 5e-324, 1e-310, 1e-200, 1e-30, 1e30, 1e154, 1e300, 1e308};
    for (auto& x : found) switch (kind) {
        case 0:  // a cloud
          x = 2 * vector();
          break;
        case 1:  // a line
          x = uniform(-2, 2) * direction;
          break;
        case 2:  // a plane
          x = uniform(-2, 2) * direction + uniform(-1, 1) * other;
          break;
        case 3:  // all on one place
          x = place;
          break;
        case 4:  // nearly on one place
          x = place + 1e-9 * vector();
          break;
        case 5:  // nearly a line
          x = uniform(-2, 2) * direction + 1e-8 * vector();
          break;
        case 6:  // extreme numbers
          for (int a = 0; a < Dim; ++a) x[a] = (pick(2) ? 1 : -1) * odd[pick(9)];
          break;
        case 7:  // a cloud with some of those amid
          x = pick(3) ? Vec<Dim>(2 * vector()) : Vec<Dim>(odd[pick(9)] * vector());
          break;
        default:  // no numbers at all
          x = pick(3) ? Vec<Dim>(vector())
                      : Vec<Dim>::Constant(pick(2) ? std::numeric_limits<double>::quiet_NaN()
                                                   : std::numeric_limits<double>::infinity());
      }
    return found;
  }
};

template <int Dim>
void any_neighbourhood(int times) {
  Hazard<Dim> hazard;
  ShapeVote<Dim> last;
  const ShapeLimits limits{10, 2, 0};
  int failures = 0;
  for (int k = 0; k < times; ++k) {
    double size;
    const Mat<Dim> metric = hazard.metric(size);
    FirstShell<Dim> shell(metric, 1.3, 2);
    for (const Vec<Dim>& x : hazard.neighbours(k % 9)) shell.add(x / std::sqrt(size));
    const ShapeVote<Dim> vote = shell.vote(k % 2 ? 2 : 4);
    VoteMean<Dim> mean;
    mean.add(1, vote);
    for (int other = hazard.pick(3); other > 0; --other) mean.add(hazard.uniform(0, 1), last);
    ShapeActions actions;
    const Mat<Dim> result = reshaped<Dim>(metric, mean.shrunk(), mean.empty(), limits, actions) / size;
    // Round-off in a matrix of aspect 1000 changes its smallest eigenvalue by 1e-10.
    const bool good = result.allFinite() && Eigen::LLT<Mat<Dim>>(result).info() == Eigen::Success &&
                      std::abs(result.determinant() - 1) < 1e-8 && aspect<Dim>(result) < 10 * (1 + 1e-9);
    failures += !good;
    last = vote;
  }
  EXPECT_EQ(failures, 0);
}
TEST(IdealHLimits, HalfAMillionNeighbourhoodsOfAllKindsStayPositiveDefiniteIn2D) { any_neighbourhood<2>(500000); }
TEST(IdealHLimits, HalfAMillionNeighbourhoodsOfAllKindsStayPositiveDefiniteIn3D) { any_neighbourhood<3>(500000); }

}  // namespace
}  // namespace ejecta
