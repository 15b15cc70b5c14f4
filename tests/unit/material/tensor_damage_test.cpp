#include "material/tensor_damage.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>
#include <random>

namespace ejecta {
namespace {

using Random = std::mt19937_64;

template <int Dim>
Mat<Dim> random_matrix(Random& random) {
  std::normal_distribution<double> normal;
  return Mat<Dim>::NullaryExpr([&] { return normal(random); });
}
template <int Dim>
Mat<Dim> symmetric_part(const Mat<Dim>& m) {
  return 0.5 * (m + m.transpose());
}
template <int Dim>
Mat<Dim> random_rotation(Random& random) {
  const Mat<Dim> gradient = random_matrix<Dim>(random);
  return rotation<Dim>(gradient, 3);
}
template <int Dim>
Mat<Dim> round_metric(double h) {
  return Mat<Dim>(Mat<Dim>::Identity()) / (h * h);
}
template <int Dim>
double least_eigenvalue(const Mat<Dim>& m) {
  return -largest_eigenvalue<Dim>(-m);
}
double uniform(Random& random) { return std::uniform_real_distribution<double>()(random); }

const OpenCracks ten_flaws = dealt_cracks({1e-3, 2, 10});

TEST(Rotation, IsThatOfAPointThatMovesWithTheGradient) {
  // v = omega x r about z turns x towards y.
  Mat<3> gradient = Mat<3>::Zero();
  gradient(0, 1) = -2, gradient(1, 0) = 2;
  const Mat<3> q = rotation<3>(gradient, 0.25);
  EXPECT_NEAR((q * Vec<3>::UnitX() - Vec<3>(std::cos(0.5), std::sin(0.5), 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((rotation<2>(gradient.topLeftCorner<2, 2>(), 0.25) - q.topLeftCorner<2, 2>()).norm(), 0, 1e-15);
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Mat<3> any = random_matrix<3>(random), turn = rotation<3>(any, 0.7);
    EXPECT_NEAR((turn * turn.transpose() - Mat<3>::Identity()).norm(), 0, 1e-14);
    EXPECT_NEAR(turn.determinant(), 1, 1e-14);
    const Mat<3> stretch = symmetric_part<3>(any);
    EXPECT_EQ(rotation<3>(stretch, 0.7), Mat<3>::Identity()) << "stretching turns nothing";
  }
}

/// Largest errors of D and strain after a full turn about a tilted axis while both are carried along.
template <int Dim>
void expect_a_full_turn_returns(int steps) {
  Random random(2);
  const Mat<Dim> some = random_matrix<Dim>(random);
  const Mat<Dim> start = symmetric_part<Dim>(some), spin = some - some.transpose();
  const double speed = Dim == 2 ? std::abs(spin(1, 0)) : std::sqrt(0.5) * spin.norm();
  Mat<Dim> tensor = start;
  for (int k = 0; k < steps; ++k) {
    const double dt = 2 * std::numbers::pi / (speed * steps);
    tensor = turned<Dim>(tensor, rotation<Dim>(spin, dt)) + dt * straining<Dim>(CrackStrain::strain_history, spin) +
             dt * straining<Dim>(CrackStrain::pseudo_plastic, spin);
  }
  EXPECT_LT((tensor - start).norm(), 1e-12 * start.norm()) << Dim << "D, " << steps << " steps";
}

TEST(Turned, AFullTurnReturnsEigenvaluesAndOrientation) {
  for (const int steps : {200, 2000}) {
    expect_a_full_turn_returns<2>(steps);
    expect_a_full_turn_returns<3>(steps);
  }
}

TEST(CrackStrains, OfUniaxialStraining) {
  Mat<3> gradient = Mat<3>::Zero();
  gradient(0, 0) = 6, gradient(0, 1) = 2, gradient(1, 0) = -2;
  EXPECT_NEAR((straining<3>(CrackStrain::pseudo_plastic, gradient) - Mat<3>(Vec<3>(4, -2, -2).asDiagonal())).norm(), 0,
              1e-15);
  EXPECT_NEAR((straining<3>(CrackStrain::strain_history, gradient) - Mat<3>(Vec<3>(6, 0, 0).asDiagonal())).norm(), 0,
              1e-14);
  EXPECT_EQ(straining<3>(CrackStrain::strain_history, -gradient).norm(), 0) << "pressing together opens nothing";
  const Mat<2> plane = gradient.topLeftCorner<2, 2>();
  EXPECT_NEAR((straining<2>(CrackStrain::pseudo_plastic, plane) - Mat<2>(Vec<2>(4, -2).asDiagonal())).norm(), 0, 1e-15);
  // Uniaxial stress sigma in 3D: P = -sigma/3, S = sigma (2, -1, -1)/3: strain sigma/E along it and nothing across.
  const Mat<3> strain = stress_strain<3>(-1e6, Deviator<3>(2e6, -1e6, 0, 0, 0), 60e9, 2);
  EXPECT_NEAR((strain - Mat<3>(Vec<3>(1e-4, 0, 0).asDiagonal())).norm(), 0, 1e-18);
  const Mat<2> sheared = stress_strain<2>(0, Deviator<2>(0, 0, 3e6), 60e9, 1);
  EXPECT_NEAR(largest_eigenvalue<2>(sheared), 5e-5, 1e-18);
}

TEST(CrackStrains, StrainHistoryIsThePositivePartOfAnyGradient) {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Mat<3> gradient = random_matrix<3>(random), rate = symmetric_part<3>(gradient),
                 positive = straining<3>(CrackStrain::strain_history, gradient), negative = positive - rate;
    EXPECT_GE(least_eigenvalue<3>(positive), -1e-13);
    EXPECT_GE(least_eigenvalue<3>(negative), -1e-13);
    EXPECT_NEAR((positive * negative).norm(), 0, 1e-12) << "the two parts share no direction";
  }
}

TEST(DamageLength, IsTheMeanSemiAxisOfTheSectionNormalToTheCrack) {
  EXPECT_NEAR(damage_length<3>(round_metric<3>(0.3), Vec<3>(0.6, 0, 0.8)), 0.3, 1e-15);
  EXPECT_NEAR(damage_length<2>(round_metric<2>(0.3), Vec<2>(0.6, 0.8)), 0.3, 1e-15);
  Random random(4);
  const Mat<3> q = random_rotation<3>(random);
  const Vec<3> axes(2, 3, 12);
  const Mat<3> metric = q * axes.cwiseInverse().cwiseAbs2().asDiagonal() * q.transpose();
  EXPECT_NEAR(damage_length<3>(metric, q.col(0)), 6, 1e-12);
  EXPECT_NEAR(damage_length<3>(metric, q.col(2)), std::sqrt(6), 1e-12);
  // Any normal: two conjugate radii in the plane span the area of the section.
  const Vec<3> n = Vec<3>(1, 2, -1).normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  const double uu = u.dot(metric * u), vv = v.dot(metric * v), uv = u.dot(metric * v);
  EXPECT_NEAR(damage_length<3>(metric, n), std::pow(uu * vv - uv * uv, -0.25), 1e-12);
  const Mat<2> plane = Vec<2>(1 / 4.0, 1 / 25.0).asDiagonal();
  EXPECT_NEAR(damage_length<2>(plane, Vec<2>::UnitX()), 5, 1e-14);
}

TEST(GrowCracks, OpenAcrossTheEigenvectorOfPositiveStrain) {
  Random random(5);
  for (int k = 0; k < 100; ++k) {
    const Mat<3> q = random_rotation<3>(random);
    const Mat<3> strain = q * Vec<3>(2e-3, -5e-3, 0.5e-3).asDiagonal() * q.transpose();
    Mat<3> damage = Mat<3>::Zero();
    const CrackGrowth<3> growth{ten_flaws, 3, round_metric<3>(0.5)};
    grow_cracks<3>(damage, strain, strain, growth, 1e-2);
    const double d = std::pow(4 * 3 / 0.5 * 1e-2, 3);  // (2e-3/1e-3)^2 flaws, c_g/R
    EXPECT_NEAR((damage - d * q.col(0) * q.col(0).transpose()).norm(), 0, 1e-12);
    grow_cracks<3>(damage, strain, strain, growth, 1);
    EXPECT_NEAR((damage - 0.4 * q.col(0) * q.col(0).transpose()).norm(), 0, 1e-12) << "four flaws of ten are open";
    const Mat<3> open = damage, pressed = -q * Vec<3>(2e-3, 5e-3, 0.5e-3).asDiagonal() * q.transpose();
    grow_cracks<3>(damage, pressed, pressed, growth, 1);
    EXPECT_EQ(damage, open);
  }
}

/// Strain that rises within the step opens the flaws one after the other, whatever the step.
TEST(GrowCracks, FollowTheStrainWithinTheStep) {
  const Mat<3> strain = Vec<3>(2e-3, -5e-3, 0.5e-3).asDiagonal(), none = Mat<3>::Zero();
  const CrackGrowth<3> growth{ten_flaws, 3, round_metric<3>(0.5)};
  Mat<3> once = none, often = none;
  grow_cracks<3>(once, none, strain, growth, 1e-2);
  for (int k = 0; k < 100; ++k) grow_cracks<3>(often, k / 100.0 * strain, (k + 1) / 100.0 * strain, growth, 1e-4);
  // Mean over the step of (strain/1e-3)^2 from 1e-3 to 2e-3: (8 - 1)/3/2.
  EXPECT_NEAR(once(0, 0), std::pow(7.0 / 6 * 3 / 0.5 * 1e-2, 3), 1e-15);
  EXPECT_NEAR(often(0, 0), once(0, 0), 1e-12);
}

TEST(GrowCracks, ReachTheDamageAskedForAcrossAnyDirection) {
  Random random(6);
  for (int k = 0; k < 1000; ++k) {
    const Mat<3> q = random_rotation<3>(random), p = random_rotation<3>(random);
    const Mat<3> start = p * Vec<3>(0.9, 0.3, 0.1).asDiagonal() * p.transpose();
    const Mat<3> strain = q * Vec<3>(1, -1, -1).asDiagonal() * q.transpose();
    Mat<3> damage = start;
    const Vec<3> n = q.col(0);
    const double before = std::cbrt(n.dot(start * n));
    grow_cracks<3>(damage, strain, strain, {ten_flaws, 0.5, round_metric<3>(1)}, 0.01);
    EXPECT_NEAR(std::cbrt(n.dot(damage * n)), std::min(before + 0.05, 1.0), 1e-12);
  }
}

template <int Dim>
void expect_neither_healing_nor_excess(int histories) {
  Random random(7);
  for (int history = 0; history < histories; ++history) {
    Mat<Dim> damage = Mat<Dim>::Zero();
    const Flaws flaws{1e-3 * uniform(random), 5 * uniform(random), 1 + std::floor(20 * uniform(random))};
    for (int k = 0; k < 8; ++k) {
      const Mat<Dim> q = random_rotation<Dim>(random), shape = random_matrix<Dim>(random);
      const Mat<Dim> carried = turned<Dim>(damage, q), metric = shape * shape.transpose() + round_metric<Dim>(1);
      const Mat<Dim> before = 2e-3 * symmetric_part<Dim>(random_matrix<Dim>(random)),
                     after = 2e-3 * symmetric_part<Dim>(random_matrix<Dim>(random));
      damage = carried;
      grow_cracks<Dim>(damage, before, after, {dealt_cracks(flaws), 1, metric}, std::pow(10, -4 + 6 * uniform(random)));
      ASSERT_GE(least_eigenvalue<Dim>(damage - carried), -1e-12) << "history " << history << ", step " << k;
      ASSERT_GE(least_eigenvalue<Dim>(damage), -1e-12);
      ASSERT_LE(largest_eigenvalue<Dim>(damage), 1 + 1e-12);
    }
  }
}

TEST(GrowCracks, NeverHealAndStayInBounds) {
  expect_neither_healing_nor_excess<2>(50000);
  expect_neither_healing_nor_excess<3>(50000);
}

template <int Dim>
void expect_the_same_in_a_turned_frame() {
  Random random(8);
  for (int k = 0; k < 1000; ++k) {
    const Mat<Dim> q = random_rotation<Dim>(random), shape = random_matrix<Dim>(random);
    const Mat<Dim> metric = shape * shape.transpose() + round_metric<Dim>(1);
    const Mat<Dim> first = 3e-3 * symmetric_part<Dim>(random_matrix<Dim>(random)),
                   second = 3e-3 * symmetric_part<Dim>(random_matrix<Dim>(random));
    Mat<Dim> damage = Mat<Dim>::Zero(), seen_turned = damage;
    Mat<Dim> before = Mat<Dim>::Zero();
    for (const Mat<Dim>& strain : {first, second}) {
      grow_cracks<Dim>(damage, before, strain, {ten_flaws, 0.1, metric}, 0.2);
      grow_cracks<Dim>(seen_turned, turned<Dim>(before, q), turned<Dim>(strain, q),
                       {ten_flaws, 0.1, turned<Dim>(metric, q)}, 0.2);
      before = strain;
    }
    // What is integrated is D^(1/3), in which round-off of D across a whole direction is a crack of length 6e-6.
    EXPECT_NEAR((turned<Dim>(damage, q) - seen_turned).norm(), 0, 3 * std::cbrt(2.2e-16));
  }
}

TEST(GrowCracks, DoNotDependOnTheFrame) {
  expect_the_same_in_a_turned_frame<2>();
  expect_the_same_in_a_turned_frame<3>();
}

}  // namespace
}  // namespace ejecta
