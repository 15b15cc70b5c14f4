/// The aims of the ideal H, on sets whose best H is known: no dynamics.
#include "schemes/ideal_h.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "unit/schemes/node_set.hpp"

namespace ejecta {
namespace {

constexpr Kernel all_kernels[] = {Kernel::cubic_spline, Kernel::quintic_spline, Kernel::wendland_c2,
                                  Kernel::wendland_c4};
constexpr int to_rest = 12;  ///< rounds of votes after which nothing changes any more

/// Stretches along x to this aspect, at constant volume.
template <int Dim>
Mat<Dim> stretch(double aspect) {
  Vec<Dim> factors = Vec<Dim>::Constant(std::pow(aspect, -1.0 / Dim));
  factors[0] *= aspect;
  return factors.asDiagonal();
}

template <int Dim>
Mat<Dim> some_rotation() {
  if constexpr (Dim == 2) return Eigen::Rotation2Dd(0.7).toRotationMatrix();
  if constexpr (Dim == 3) return Eigen::AngleAxisd(0.7, Vec<3>(1, -2, 3).normalized()).toRotationMatrix();
}

/// The longest axis of the ellipsoid of a metric.
template <int Dim>
Vec<Dim> longest_axis(const Mat<Dim>& metric) {
  return Eigen::SelfAdjointEigenSolver<Mat<Dim>>(metric).eigenvectors().col(0);
}

template <int Dim>
constexpr int cells = Dim == 2 ? 12 : 6;

template <int Dim>
void perfect_lattices() {
  for (const Kernel kernel : all_kernels)
    for (const double nodes_per_h : {1.3, 1.5})
      for (const double wanted : {1.0, 2.0, 4.0, 10.0}) {
        auto set = lattice<Dim>(cells<Dim>, nodes_per_h);
        set.deform(stretch<Dim>(wanted), false);
        vote(set, {.kernel = kernel, .nodes_per_h = nodes_per_h, .reach = 4}, to_rest);
        // All nodes are alike: eigenvalues (n_h spacing)^-2 along each axis.
        for (const Mat<Dim>& metric : set.metric) {
          const Mat<Dim> expected = (nodes_per_h * stretch<Dim>(wanted)).cwiseAbs2().inverse();
          ASSERT_NEAR(aspect<Dim>(metric), wanted, 0.01 * wanted);
          for (int a = 0; a < Dim; ++a) ASSERT_NEAR(metric(a, a), expected(a, a), 0.015 * expected(a, a));
          ASSERT_LT((metric - Mat<Dim>(metric.diagonal().asDiagonal())).norm(), 1e-9 * metric.norm());
        }
      }
}
TEST(IdealH, PerfectLatticesIn2DFromRound) { perfect_lattices<2>(); }
TEST(IdealH, PerfectLatticesIn3DFromRound) { perfect_lattices<3>(); }

template <int Dim>
void close_packed() {
  std::vector<Vec<Dim>> basis;
  Vec<Dim> cell = Vec<Dim>::Ones();
  if constexpr (Dim == 2) {
    basis = {Vec<2>(0, 0), Vec<2>(0.5, 0.5)};
    cell[1] = std::sqrt(3.0);
  } else {
    basis = {Vec<3>(0, 0, 0), Vec<3>(0.5, 0.5, 0), Vec<3>(0.5, 0, 0.5), Vec<3>(0, 0.5, 0.5)};
  }
  for (const double wanted : {1.0, 2.0, 4.0}) {
    auto set = lattice<Dim>(cells<Dim> - 2, 1.5, 0, basis, cell);
    set.deform(stretch<Dim>(wanted), true);
    vote(set, {}, to_rest);
    const Spread spread = aspects(set);
    EXPECT_NEAR(spread.least, wanted, 0.01 * wanted);
    EXPECT_NEAR(spread.most, wanted, 0.01 * wanted);
  }
}
TEST(IdealH, HexagonalLatticesFollowTheFlow) { close_packed<2>(); }
TEST(IdealH, FaceCentredLatticesFollowTheFlow) { close_packed<3>(); }

template <int Dim>
void jittered() {
  for (const Kernel kernel : all_kernels)
    for (const double nodes_per_h : {1.3, 1.5, 2.0}) {
      const VoteSettings settings{.kernel = kernel, .nodes_per_h = nodes_per_h, .reach = 4};
      auto round = lattice<Dim>(cells<Dim>, nodes_per_h, 0.1);
      vote(round, settings, to_rest);
      // Measured: mean at most 1.04, worst node 1.43 (2D, Wendland C4, n_h 1.3); asked for: mean below 1.3.
      EXPECT_LT(aspects(round).mean, 1.06);
      EXPECT_LT(aspects(round).most, 1.5);

      auto stretched = lattice<Dim>(cells<Dim>, nodes_per_h, 0.1);
      stretched.deform(stretch<Dim>(4), true);
      vote(stretched, settings, to_rest);
      const Spread spread = aspects(stretched);
      EXPECT_NEAR(spread.mean, 4, 0.08);
      EXPECT_GT(spread.least, 3.5);
      EXPECT_LT(spread.most, 4.5);
      for (const Mat<Dim>& metric : stretched.metric) EXPECT_GT(std::abs(longest_axis<Dim>(metric)[0]), 0.99);
    }
}
TEST(IdealH, DisorderIn2DIsNotTakenForShape) { jittered<2>(); }
TEST(IdealH, DisorderIn3DIsNotTakenForShape) { jittered<3>(); }

TEST(IdealH, StrongDisorderIsNotTakenForShapeEither) {
  const auto after = [](auto set) {
    vote(set, {}, to_rest);
    return aspects(set);
  };
  EXPECT_LT(after(lattice<2>(12, 1.5, 0.2)).mean, 1.1);
  EXPECT_LT(after(lattice<3>(6, 1.5, 0.2)).mean, 1.06);
  auto stretched = lattice<2>(12, 1.5, 0.2);
  stretched.deform(stretch<2>(4), true);
  EXPECT_NEAR(after(stretched).mean, 3.85, 0.25);
}

template <int Dim>
void turned_inputs_turn_the_result(bool periodic) {
  auto set = lattice<Dim>(cells<Dim> - 1, 1.5, 0.15);
  set.deform(stretch<Dim>(3), false);
  if (!periodic) set.box *= 100;  // free surfaces
  auto turned = set;
  const Mat<Dim> Q = some_rotation<Dim>();
  turned.deform(Q, true);
  vote(set, {}, to_rest);
  vote(turned, {}, to_rest);
  for (std::size_t i = 0; i < set.metric.size(); ++i)
    EXPECT_LT((Q * set.metric[i] * Q.transpose() - turned.metric[i]).norm(), 1e-10 * set.metric[i].norm());
}
TEST(IdealH, IsRotationCovariant) {
  for (const bool periodic : {true, false}) {
    turned_inputs_turn_the_result<2>(periodic);
    turned_inputs_turn_the_result<3>(periodic);
  }
}

TEST(IdealH, StaysBoundedInEndlessShearWhereTheEvolvedHDoesNot) {
  constexpr double shear_per_step = 0.02, end = 20;
  Mat<2> F = Mat<2>::Identity();
  F(0, 1) = shear_per_step;
  for (const double jitter : {0.0, 0.1}) {
    auto ideal = lattice<2>(8, 1.5, jitter);
    auto evolved = ideal;
    double largest_mean = 0, largest = 0;
    for (int k = 1; k <= static_cast<int>(end / shear_per_step); ++k) {
      ideal.deform(F, true);
      evolved.deform(F, true);
      ideal.box.col(1) -= std::round(ideal.box(0, 1) / ideal.box(0, 0)) * ideal.box.col(0);  // the same periodic set
      if (k % 5 == 0) vote(ideal, {});
      const Spread spread = aspects(ideal);
      largest_mean = std::max(largest_mean, spread.mean);
      largest = std::max(largest, spread.most);
    }
    // Exact: the singular values of a shear by gamma have the ratio ((gamma + sqrt(gamma^2 + 4))/2)^2 = 401.998.
    EXPECT_NEAR(aspects(evolved).mean, 401.998, 0.01);
    // Measured: 6.2 and 6.2 on the perfect lattice; 6.8 and 15.7 on the other, whose disorder the shear amplifies.
    EXPECT_LT(largest_mean, jitter == 0 ? 6.5 : 7.5);
    EXPECT_LT(largest, jitter == 0 ? 6.5 : 20);
  }
}

TEST(IdealH, FollowsAMovingStretchAndKeepsIt) {
  auto set = lattice<2>(12, 1.5, 0.1);
  vote(set, {}, 5);
  const double factor = std::pow(4, 0.005);
  const Mat<2> F = Vec<2>(factor, 1 / factor).asDiagonal();
  for (int k = 1; k <= 100; ++k) {
    set.deform(F, true);
    if (k % 5 == 0) vote(set, {});
    EXPECT_NEAR(aspects(set).mean, std::pow(4, 0.01 * k), 0.03 * std::pow(4, 0.01 * k));
  }
  vote(set, {}, 10);
  EXPECT_NEAR(aspects(set).mean, 4, 0.05);
}

}  // namespace
}  // namespace ejecta
