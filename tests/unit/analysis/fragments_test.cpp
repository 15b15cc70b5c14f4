#include "analysis/fragments.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

namespace ejecta {
namespace {

/// Owns the columns of a hand-made cloud.
struct Cloud {
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> mass, density, damage;
  std::array<std::vector<double>, 6> metric;  ///< empty: round
  std::vector<std::int32_t> id, body, material;
  int dimension = 3;
  std::array<PeriodicAxis, 3> box;
  std::vector<std::int32_t> piece_of_body{0, 1, 2};

  void add(Vec<3> position, Vec<3> velocity, double m = 1.0, double d = 1.0, double damaged = 0.0, int label = 0) {
    for (int a = 0; a < 3; ++a) {
      x[a].push_back(position[a]);
      v[a].push_back(velocity[a]);
    }
    mass.push_back(m);
    density.push_back(m / std::pow(d, dimension));
    damage.push_back(damaged);
    id.push_back(static_cast<std::int32_t>(id.size()));
    body.push_back(label);
    material.push_back(label);
  }
  /// Lattice of unit spacing within `radius`, turning rigidly at `spin` about its centre.
  void add_ball(Vec<3> centre, double radius, Vec<3> velocity, Vec<3> spin = Vec<3>::Zero(), int label = 0) {
    const int n = static_cast<int>(radius) + 1, nz = dimension == 3 ? n : 0;
    for (int k = -nz; k <= nz; ++k)
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i) {
          const Vec<3> r(i, j, k);
          if (r.norm() <= radius) add(centre + r, velocity + spin.cross(r), 1.0, 1.0, 0.0, label);
        }
  }
  FragmentInput input() const {
    FragmentInput in;
    for (int a = 0; a < dimension; ++a) {
      in.position[a] = x[a];
      in.velocity[a] = v[a];
    }
    for (std::size_t k = 0; k < 6; ++k) in.smoothing_metric[k] = metric[k];
    in.nodes_per_h = 1.3;
    in.mass = mass;
    in.density = density;
    in.damage = damage;
    in.id = id;
    in.body = body;
    in.material = material;
    in.box = box;
    in.piece_of_body = piece_of_body;
    return in;
  }
};

template <int Dim>
void add_metric(Cloud& cloud, const Mat<Dim>& g) {
  const Symmetric<Dim> s = symmetric_of<Dim>(g);
  for (int k = 0; k < symmetric_size<Dim>; ++k) cloud.metric[static_cast<std::size_t>(k)].push_back(s[k]);
}

/// Ellipsoids of any direction, aspect up to 8, about as large as the particles.
template <int Dim>
void add_random_metrics(Cloud& cloud, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t i = 0; i < cloud.mass.size(); ++i) {
    const double d = std::pow(cloud.mass[i] / cloud.density[i], 1.0 / Dim);
    const Mat<Dim> any = Mat<Dim>::NullaryExpr([&] { return uniform(random); });
    const Mat<Dim> turn = Eigen::HouseholderQR<Mat<Dim>>(any).householderQ();
    const Vec<Dim> length = Vec<Dim>::NullaryExpr([&] { return 1.3 * d * std::exp2(1.5 * uniform(random)); });
    add_metric<Dim>(cloud, turn * length.cwiseAbs2().cwiseInverse().asDiagonal() * turn.transpose());
  }
}

/// Mixed sizes, damage and clumps of chance.
Cloud random_cloud(int dimension, int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Cloud cloud;
  cloud.dimension = dimension;
  const double side = 1.35 * std::pow(n, 1.0 / dimension);
  for (int i = 0; i < n; ++i) {
    const Vec<3> position(side * uniform(random), side * uniform(random), dimension == 3 ? side * uniform(random) : 0);
    const Vec<3> velocity(uniform(random), uniform(random) - 2, dimension == 3 ? uniform(random) : 0);
    cloud.add(position, velocity, 0.5 + uniform(random), std::exp2(2.5 * uniform(random) - 2), uniform(random), i % 3);
  }
  return cloud;
}

/// |H_k (x_i - x_j)|.
double stretched_distance(const FragmentInput& in, std::size_t k, std::size_t i, std::size_t j) {
  std::array<double, 3> x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(in.dimension()); ++a)
    x[a] = in.position[a][i] - in.position[a][j];
  const auto& g = in.smoothing_metric;
  const double square = in.dimension() == 2
                            ? g[0][k] * x[0] * x[0] + g[1][k] * x[1] * x[1] + 2 * g[2][k] * x[0] * x[1]
                            : g[0][k] * x[0] * x[0] + g[1][k] * x[1] * x[1] + g[2][k] * x[2] * x[2] +
                                  2 * (g[3][k] * x[0] * x[1] + g[4][k] * x[0] * x[2] + g[5][k] * x[1] * x[2]);
  return std::sqrt(square);
}

/// Groups by comparing every pair and flooding labels; 0 is dust.
std::vector<int> brute_force(const FragmentInput& in, const FragmentSettings& settings) {
  const std::size_t n = in.size();
  const double power = 1.0 / in.dimension();
  std::vector<int> label(n, -1);
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (label[seed] != -1 || in.damage[seed] >= settings.damage_threshold) continue;
    std::vector<std::size_t> members{seed};
    label[seed] = static_cast<int>(seed) + 1;
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t i = members[k];
        if (label[j] != -1 || in.damage[j] >= settings.damage_threshold || in.piece(i) != in.piece(j)) continue;
        double r2 = 0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(in.dimension()); ++a) {
          const double x = in.position[a][i] - in.position[a][j], period = in.box[a].length;
          r2 += std::pow(period > 0 ? std::remainder(x, period) : x, 2);
        }
        const double d = std::pow(in.mass[i] / in.density[i], power) + std::pow(in.mass[j] / in.density[j], power);
        if (in.smoothing_metric[0].empty() && std::sqrt(r2) >= 0.5 * settings.linking_length * d) continue;
        if (!in.smoothing_metric[0].empty() &&
            in.nodes_per_h * std::min(stretched_distance(in, i, i, j), stretched_distance(in, j, i, j)) >=
                settings.linking_length)
          continue;
        label[j] = label[seed];
        members.push_back(j);
      }
    if (members.size() < static_cast<std::size_t>(settings.min_particles))
      for (const std::size_t i : members) label[i] = 0;
  }
  for (int& l : label) l = std::max(l, 0);
  return label;
}

void expect_groups_of_brute_force(const Cloud& cloud) {
  FragmentSettings settings;
  settings.min_particles = 3;
  settings.damage_threshold = 0.8;
  const std::vector<std::int32_t> groups = find_groups(cloud.input(), settings).number;
  const std::vector<int> expected = brute_force(cloud.input(), settings);
  std::set<std::pair<int, int>> pairs;
  std::set<int> mine, theirs;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    pairs.insert({groups[i], expected[i]});
    mine.insert(groups[i]);
    theirs.insert(expected[i]);
    EXPECT_EQ(groups[i] == 0, expected[i] == 0);
  }
  EXPECT_GT(mine.size(), 5u);  // the cloud must exercise several groups and dust
  EXPECT_TRUE(mine.count(0));
  EXPECT_EQ(pairs.size(), mine.size());  // one to one
  EXPECT_EQ(pairs.size(), theirs.size());
}

TEST(Fragments, AgreesWithComparingEveryPair) {
  for (const int dimension : {2, 3})
    expect_groups_of_brute_force(random_cloud(dimension, 1500, 7u + static_cast<unsigned>(dimension)));
}

TEST(Fragments, AcrossPeriodicFacesAgreesWithComparingEveryPair) {
  for (const int dimension : {2, 3}) {
    Cloud cloud = random_cloud(dimension, 1500, 7u + static_cast<unsigned>(dimension));
    const double side = 1.35 * std::pow(1500, 1.0 / dimension);
    cloud.box[0] = cloud.box[1] = {0, side};
    expect_groups_of_brute_force(cloud);
  }
}

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

/// Half a spacing between them is less than a link.
TEST(Fragments, BodiesThatTouchAreTwoPiecesUnlessWelded) {
  Cloud cloud;
  cloud.add_ball({0, 0, 0}, 4, Vec<3>::Zero(), Vec<3>::Zero(), 0);
  const double first = static_cast<double>(cloud.mass.size());
  cloud.add_ball({8.5, 0, 0}, 4, Vec<3>::Zero(), Vec<3>::Zero(), 1);
  const auto pieces = [&] { return describe_groups(cloud.input(), find_groups(cloud.input(), {})); };
  EXPECT_EQ(pieces().fragments.size(), 2u);
  cloud.piece_of_body[1] = cloud.piece_of_body[0];
  const FragmentTable welded = pieces();
  ASSERT_EQ(welded.fragments.size(), 1u);
  EXPECT_EQ(welded.largest_mass(0), first);
  cloud.piece_of_body = {-1, 1};  // the first is a gas
  EXPECT_EQ(pieces().fragments.size(), 1u);
  EXPECT_EQ(pieces().largest_mass(0), 0);
  EXPECT_EQ(pieces().dust_mass_by_body[0], first);
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

TEST(Fragments, LinksByEllipsoidsAgreeWithComparingEveryPair) {
  Cloud flat = random_cloud(2, 1500, 11), solid = random_cloud(3, 1500, 12);
  for (Cloud* cloud : {&flat, &solid})  // thinner, so that there are several groups
    for (auto& x : cloud->x)
      for (double& value : x) value *= cloud == &flat ? 1.6 : 1.35;
  add_random_metrics<2>(flat, 3);
  add_random_metrics<3>(solid, 4);
  expect_groups_of_brute_force(flat);
  expect_groups_of_brute_force(solid);
}

/// Spacings 3^(2/3), 3^(-1/3), 3^(-1/3) in a frame turned against the axes, H following them; the second half of it
/// moved away by `gap` spacings along the stretch.
Cloud stretched_block(double gap) {
  Cloud cloud;
  const Mat<3> turn = Eigen::AngleAxisd(0.6, Vec<3>(1, 1, 2).normalized()).toRotationMatrix();
  const Vec<3> spacing(std::cbrt(9.0), 1 / std::cbrt(3.0), 1 / std::cbrt(3.0));
  const Mat<3> h = turn * (1.3 * spacing).cwiseInverse().asDiagonal() * turn.transpose();
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 12; ++i) {
        const Vec<3> lattice((i + (i < 6 ? 0 : gap)) * spacing[0], j * spacing[1], k * spacing[2]);
        cloud.add(turn * lattice, Vec<3>::Zero());
        add_metric<3>(cloud, h * h);
      }
  return cloud;
}

TEST(Fragments, AStretchedBodyIsOnePieceToItsEllipsoidsAndManyToSpheres) {
  const auto pieces = [](const Cloud& cloud, FragmentLink link) {
    FragmentSettings settings;
    settings.link = link;
    return describe_groups(cloud.input(), find_groups(cloud.input(), settings)).fragments.size();
  };
  const Cloud whole = stretched_block(0), broken = stretched_block(0.5);
  EXPECT_EQ(pieces(whole, FragmentLink::support), 1u);
  EXPECT_EQ(pieces(whole, FragmentLink::automatic), 1u);
  EXPECT_EQ(pieces(whole, FragmentLink::spacing), 12u);  // sheets: 2.08 apart, 1.4 long links
  EXPECT_EQ(pieces(broken, FragmentLink::support), 2u);
}

TEST(Fragments, ABrokenMetricOfAFailedRunIsHarmless) {
  Cloud cloud = stretched_block(0);
  cloud.metric[0][5] = std::nan("");
  for (auto& component : cloud.metric) component[9] = 0;
  EXPECT_EQ(describe_groups(cloud.input(), find_groups(cloud.input(), {})).fragments.size(), 1u);
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

TEST(Fragments, BridgeJoinsAndLinkingLengthDecides) {
  Cloud cloud;
  cloud.add_ball({0, 0, 0}, 2, Vec<3>::Zero());
  cloud.add_ball({7, 0, 0}, 2, Vec<3>::Zero());
  EXPECT_EQ(describe_groups(cloud.input(), find_groups(cloud.input(), {})).fragments.size(), 2u);
  cloud.add({3.25, 0, 0}, Vec<3>::Zero());
  cloud.add({3.75, 0, 0}, Vec<3>::Zero());
  EXPECT_EQ(describe_groups(cloud.input(), find_groups(cloud.input(), {})).fragments.size(), 1u);
  const auto sensitivity = fragment_sensitivity(cloud.input(), {});
  EXPECT_EQ(sensitivity[0].fragments, 2u);  // 1.12 does not span the gaps of 1.25: the two in the middle are dust
  EXPECT_EQ(sensitivity[1].fragments, 1u);
  EXPECT_EQ(sensitivity[2].fragments, 1u);
  EXPECT_DOUBLE_EQ(sensitivity[1].largest_mass_fraction, 1.0);
  EXPECT_DOUBLE_EQ(sensitivity[0].dust_mass_fraction, 2.0 / static_cast<double>(cloud.mass.size()));
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
