#include "particles/smoothing_metric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

template <int Dim>
Mat<Dim> random_matrix(Uniform& uniform) {
  Mat<Dim> m;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) m(a, b) = uniform(-1, 1);
  return m;
}

template <int Dim>
Mat<Dim> random_metric(Uniform& uniform) {
  const Mat<Dim> m = random_matrix<Dim>(uniform);
  return m * m.transpose() + 0.05 * Mat<Dim>::Identity();
}

TEST(SmoothingMetric, ARoundOneHasItsLengthAndAxes) {
  const Mat<3> g = round_metric<3>(0.02);
  EXPECT_NEAR(smoothing_length_of<3>(g), 0.02, 1e-16);
  const Axes axes = axes_of<3>(g);
  EXPECT_NEAR(axes.shortest, 0.02, 1e-15);
  EXPECT_NEAR(axes.longest, 0.02, 1e-15);
}

template <int Dim>
void expect_axes_of_eigenvalues() {
  Uniform uniform(3);
  for (int k = 0; k < 200; ++k) {
    const Mat<Dim> g = random_metric<Dim>(uniform);
    const Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver(g);  // by iteration
    const Axes axes = axes_of<Dim>(g);
    EXPECT_NEAR(axes.shortest * std::sqrt(solver.eigenvalues()[Dim - 1]), 1, 1e-12);
    EXPECT_NEAR(axes.longest * std::sqrt(solver.eigenvalues()[0]), 1, 1e-9);
    EXPECT_NEAR(std::pow(smoothing_length_of<Dim>(g), -2 * Dim), g.determinant(), 1e-12 * g.determinant());
  }
}
TEST(SmoothingMetric, AxesAreThoseOfTheEigenvalues) {
  expect_axes_of_eigenvalues<2>();
  expect_axes_of_eigenvalues<3>();
}

TEST(SmoothingMetric, PointsOfTheFluidKeepTheirEta) {
  // v = A x for a time 1 in n steps: G must come to F^-T G F^-1 with F = exp(A), at second order.
  Uniform uniform(4);
  const Mat<3> a = 0.5 * random_matrix<3>(uniform), g0 = random_metric<3>(uniform);
  Mat<3> f = Mat<3>::Identity(), term = f;
  for (int k = 1; k < 30; ++k) f += term = (term * a / k).eval();
  const Mat<3> exact = f.inverse().transpose() * g0 * f.inverse();
  double before = 0;
  for (const int n : {20, 40}) {
    Mat<3> g = g0;
    for (int k = 0; k < n; ++k) g = carried_metric<3>(g, a, 1.0 / n);
    const double error = (g - exact).norm() / exact.norm();
    if (n == 40) {
      EXPECT_LT(error, 2e-4);
      EXPECT_NEAR(before / error, 4, 0.2);
    }
    before = error;
  }
}

TEST(SmoothingMetric, AFullTurnBringsItBack) {
  Uniform uniform(5);
  const Mat<2> g0 = random_metric<2>(uniform);
  const int n = 2000;
  const double angle = 2 * std::numbers::pi / n;
  Mat<2> spin;
  spin << 0, -1, 1, 0;
  Mat<2> g = g0;
  // The angle of a Cayley step is 2 atan(dt w/2): the rate that turns by exactly `angle` in a step.
  for (int k = 0; k < n; ++k) g = carried_metric<2>(g, 2 * std::tan(angle / 2) * spin, 1);
  EXPECT_LT((g - g0).norm(), 1e-12 * g0.norm());
}

TEST(SmoothingMetric, TheLimitCutsTheAspectAndKeepsTheVolume) {
  Uniform uniform(6);
  for (int k = 0; k < 500; ++k) {
    const Mat<3> g = random_metric<3>(uniform), limited = limited_metric<3>(g, 2);
    const Axes before = axes_of<3>(g), after = axes_of<3>(limited);
    EXPECT_LE(after.longest / after.shortest, std::min(2.0, before.longest / before.shortest) * (1 + 1e-7));
    EXPECT_NEAR(limited.determinant() / g.determinant(), 1, 1e-9);
    if (before.longest < 2 * before.shortest) {
      EXPECT_EQ(limited, g);
    }
  }
}

TEST(SmoothingMetric, OutgrowthBoundsHowFarTheNewEllipsoidSticksOut) {
  Uniform uniform(7);
  for (int k = 0; k < 200; ++k) {
    const Mat<3> then = random_metric<3>(uniform);
    Mat<3> strain = 0.1 * random_matrix<3>(uniform);
    const Mat<3> now = carried_metric<3>(then, strain, 1);
    const double bound = outgrowth<3>(then, now);
    double most = 0;
    for (int d = 0; d < 300; ++d) {
      Vec<3> x(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      most = std::max(most, std::sqrt(x.dot(then * x) / x.dot(now * x)));
    }
    EXPECT_GE(bound, most * (1 - 1e-12));
    EXPECT_LE(bound, 2);  // a useless bound would renew the lists at every step
    EXPECT_NEAR(outgrowth<3>(then, then), 1, 1e-6);
  }
}

template <int Dim>
int steps_until_invalid(const Boundary& boundary) {
  auto p = random_cloud<Dim>(Dim == 2 ? 300 : 400, 8, 0.06, 0.12,
                             {Field::smoothing_length, Field::smoothing_metric, Field::velocity_gradient});
  random_ellipsoids(p, 5, 9);
  sort_in_space(p, 8);
  PairLists<Dim> lists;
  lists.build(p, {2, 8, 0.01, boundary});
  Uniform uniform(10);
  const Mat<Dim> flow = random_matrix<Dim>(uniform);
  for (int step = 0; step < 1000; ++step) {
    if (!lists.valid(p, step * 0.001)) return step;
    EXPECT_EQ(missed_neighbours(p, lists, boundary, 2), 0u) << "after " << step << " steps";
    for (std::size_t i = 0; i < p.size(); ++i)
      p.set_symmetric(Field::smoothing_metric, i,
                      carried_metric<Dim>(p.symmetric(Field::smoothing_metric, i), flow, 0.001));
  }
  return 1000;
}

TEST(EllipsoidLists, MissNobodyThatEitherEllipsoidReachesWhileTheyAreValid) {
  const std::array<BoundaryKind, 3> kinds{BoundaryKind::reflecting, BoundaryKind::reflecting, BoundaryKind::open};
  const Boundary walls{kinds, kinds, {0, 0, 0}, {1, 1, 1}};
  for (const Boundary& boundary : {Boundary{}, walls}) {
    EXPECT_GE(steps_until_invalid<2>(boundary), 4);
    EXPECT_GE(steps_until_invalid<3>(boundary), 4);
  }
}

/// An ellipsoid that grows as a whole grows most along its longest axis.
template <int Dim>
void expect_growth_is_seen(double aspect) {
  auto p = random_cloud<Dim>(1500, 12, 0.05, 0.05, {Field::smoothing_length, Field::smoothing_metric});
  Vec<Dim> axes = Vec<Dim>::Constant(0.02);
  axes[0] *= aspect;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.set_symmetric(Field::smoothing_metric, i, axes.cwiseAbs2().cwiseInverse().asDiagonal().toDenseMatrix());
  sort_in_space(p, 8);
  PairLists<Dim> lists;
  lists.build(p, {2, 8, 0, {}});
  int steps = 0;
  for (; lists.valid(p, 0); ++steps) {
    EXPECT_EQ(missed_neighbours(p, lists, {}, 2), 0u) << "after " << steps << " steps";
    for (std::size_t i = 0; i < p.size(); ++i)
      p.set_symmetric(Field::smoothing_metric, i, 0.998 * p.symmetric(Field::smoothing_metric, i));
  }
  EXPECT_GT(steps, 10);
}

TEST(EllipsoidLists, MissNobodyWhileLongEllipsoidsGrow) {
  expect_growth_is_seen<2>(10);
  expect_growth_is_seen<3>(10);
}

TEST(EllipsoidLists, AreShorterThanThoseOfTheSpheresAround) {
  auto p = random_cloud<3>(3000, 11, 0.05, 0.05, {Field::smoothing_length, Field::smoothing_metric});
  for (std::size_t i = 0; i < p.size(); ++i)
    p.set_symmetric(Field::smoothing_metric, i, Vec<3>(1, 16, 16).asDiagonal().toDenseMatrix() / (0.126 * 0.126));
  sort_in_space(p, 8);
  PairLists<3> tensor, sphere;
  tensor.build(p, {2, 8, 0, {}});
  auto q = random_cloud<3>(3000, 11, 0.126, 0.126);
  sort_in_space(q, 8);
  sphere.build(q, {2, 8, 0, {}});
  EXPECT_LT(tensor.mean_candidates(), 0.4 * sphere.mean_candidates());
}

}  // namespace
}  // namespace ejecta
