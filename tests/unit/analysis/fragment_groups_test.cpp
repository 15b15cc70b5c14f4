/// Who belongs to which fragment.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "unit/analysis/fragment_cloud.hpp"

namespace ejecta {
namespace {

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

TEST(FragmentGroups, AgreesWithComparingEveryPair) {
  for (const int dimension : {2, 3})
    expect_groups_of_brute_force(random_cloud(dimension, 1500, 7u + static_cast<unsigned>(dimension)));
}

TEST(FragmentGroups, AcrossPeriodicFacesAgreesWithComparingEveryPair) {
  for (const int dimension : {2, 3}) {
    Cloud cloud = random_cloud(dimension, 1500, 7u + static_cast<unsigned>(dimension));
    const double side = 1.35 * std::pow(1500, 1.0 / dimension);
    cloud.box[0] = cloud.box[1] = {0, side};
    expect_groups_of_brute_force(cloud);
  }
}

/// Half a spacing between them is less than a link.
TEST(FragmentGroups, BodiesThatTouchAreTwoPiecesUnlessWelded) {
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

TEST(FragmentGroups, LinksByEllipsoidsAgreeWithComparingEveryPair) {
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

TEST(FragmentGroups, AStretchedBodyIsOnePieceToItsEllipsoidsAndManyToSpheres) {
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

TEST(FragmentGroups, ABrokenMetricOfAFailedRunIsHarmless) {
  Cloud cloud = stretched_block(0);
  cloud.metric[0][5] = std::nan("");
  for (auto& component : cloud.metric) component[9] = 0;
  EXPECT_EQ(describe_groups(cloud.input(), find_groups(cloud.input(), {})).fragments.size(), 1u);
}

TEST(FragmentGroups, BridgeJoinsAndLinkingLengthDecides) {
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

}  // namespace
}  // namespace ejecta
