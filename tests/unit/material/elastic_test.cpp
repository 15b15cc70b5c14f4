#include "material/elastic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>
#include <random>

namespace ejecta {
namespace {

template <int Dim>
Deviator<Dim> components_of(const Mat<3>& m) {
  Deviator<Dim> s;
  s[0] = m(0, 0), s[1] = m(1, 1), s[2] = m(0, 1);
  if constexpr (Dim == 3) s[3] = m(0, 2), s[4] = m(1, 2);
  return s;
}

template <int Dim>
Deviator<Dim> random_deviator(std::mt19937_64& random, double size) {
  std::normal_distribution<double> normal(0, size);
  Deviator<Dim> s;
  for (double& component : s) component = normal(random);
  return s;
}

/// Rotation about the out-of-plane axis in 2D, about an oblique one in 3D.
template <int Dim>
Mat<3> rotation(double angle) {
  const Vec<3> axis = Dim == 2 ? Vec<3>(0, 0, 1) : Vec<3>(1, -2, 0.5).normalized();
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}
template <int Dim>
Mat<3> spin() {
  const Vec<3> axis = Dim == 2 ? Vec<3>(0, 0, 1) : Vec<3>(1, -2, 0.5).normalized();
  Mat<3> w;
  w << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  return w;
}

/// A body that is stretched at a constant rate in its own frame while it spins: seen from the body the stress grows
/// linearly, so S(t) = R [S0 + 2 G dev(D0) t] R^T. Rigid rotation is the case D0 = 0.
template <int Dim>
double objectivity_error(double turns, bool strained) {
  const double shear_modulus = 3, end = 2 * std::numbers::pi * turns;
  std::mt19937_64 random(3);
  const Mat<3> start = full_tensor<Dim>(random_deviator<Dim>(random, 1.0));
  Mat<3> strain = Mat<3>::Zero();
  if (strained) strain.template topLeftCorner<Dim, Dim>() = 0.1 * Mat<Dim>{Mat<Dim>::Random()};
  strain = (0.5 * (strain + strain.transpose())).eval();
  const auto rate = [&](double t, const Deviator<Dim>& s) {
    const Mat<3> r = rotation<Dim>(t), gradient = spin<Dim>() + r * strain * r.transpose();
    return stress_rate<Dim>(Mat<Dim>{gradient.template topLeftCorner<Dim, Dim>()}, s, shear_modulus);
  };
  Deviator<Dim> s = components_of<Dim>(start);
  const int steps = 2000;
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    const double t = k * dt;
    const Deviator<Dim> k1 = rate(t, s), k2 = rate(t + dt / 2, s + dt / 2 * k1);
    const Deviator<Dim> k3 = rate(t + dt / 2, s + dt / 2 * k2), k4 = rate(t + dt, s + dt * k3);
    s += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const Mat<3> hooke = 2 * shear_modulus * end * (strain - strain.trace() / 3 * Mat<3>::Identity());
  const Mat<3> r = rotation<Dim>(end), exact = r * (start + hooke) * r.transpose();
  return (full_tensor<Dim>(s) - exact).norm() / exact.norm();
}

TEST(StressRate, TurnsWithTheBody) {
  for (const double turns : {0.13, 0.25, 0.5, 1.0}) {
    EXPECT_LT(objectivity_error<2>(turns, false), 1e-9) << turns;
    EXPECT_LT(objectivity_error<3>(turns, false), 1e-9) << turns;
    EXPECT_LT(objectivity_error<2>(turns, true), 1e-9) << turns;
    EXPECT_LT(objectivity_error<3>(turns, true), 1e-9) << turns;
  }
}

TEST(StressRate, IsHookesLawWithoutSpin) {
  const double shear_modulus = 2;
  // Uniaxial strain in 2D: S = 2 G (2/3, -1/3, -1/3), the last one out of plane.
  const Deviator<2> plane = stress_rate<2>(Mat<2>{{1, 0}, {0, 0}}, Deviator<2>::Zero(), shear_modulus);
  EXPECT_TRUE(plane.isApprox(Deviator<2>(8.0 / 3, -4.0 / 3, 0), 1e-15));
  EXPECT_NEAR(full_tensor<2>(plane)(2, 2), -4.0 / 3, 1e-15);
  Mat<3> gradient;
  gradient << 0.3, 1, 2, 1, -0.4, 3, 2, 3, 0.7;
  Deviator<3> s;
  s << 5, -1, 2, 0.5, 4;
  const Mat<3> expected = 2 * shear_modulus * (gradient - gradient.trace() / 3 * Mat<3>::Identity());
  EXPECT_TRUE(full_tensor<3>(stress_rate<3>(gradient, s, shear_modulus)).isApprox(expected, 1e-14));
}

TEST(Deviator, InvariantsIncludeTheOutOfPlaneStress) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000; ++k) {
    const Deviator<2> s2 = random_deviator<2>(random, 1e9);
    const Deviator<3> s3 = random_deviator<3>(random, 1e9);
    EXPECT_NEAR(second_invariant<2>(s2) / (0.5 * full_tensor<2>(s2).squaredNorm()), 1, 1e-13);
    EXPECT_NEAR(second_invariant<3>(s3) / (0.5 * full_tensor<3>(s3).squaredNorm()), 1, 1e-13);
    EXPECT_NEAR(full_tensor<3>(s3).trace(), 0, 1e-6);
  }
  // Uniaxial tension sigma has the equivalent stress sigma.
  Deviator<3> uniaxial = Deviator<3>::Zero();
  uniaxial[0] = 2.0 / 3, uniaxial[1] = -1.0 / 3;
  EXPECT_NEAR(equivalent_stress<3>(uniaxial), 1, 1e-15);
}

template <int Dim>
double principal_stress_error(double pressure, const Deviator<Dim>& s) {
  const Mat<3> sigma = full_tensor<Dim>(s) - pressure * Mat<3>::Identity();
  const double exact = Eigen::SelfAdjointEigenSolver<Mat<3>>(sigma, Eigen::EigenvaluesOnly).eigenvalues()[2];
  return std::abs(largest_principal_stress<Dim>(pressure, s) - exact);
}

TEST(LargestPrincipalStress, AgreesWithEigen) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 100000; ++k) {
    const Deviator<2> s2 = random_deviator<2>(random, 1);
    const Deviator<3> s3 = random_deviator<3>(random, 1);
    ASSERT_LT(principal_stress_error<2>(0.3, s2), 1e-13 * (1 + s2.norm()));
    ASSERT_LT(principal_stress_error<3>(0.3, s3), 1e-7 * std::sqrt(second_invariant<3>(s3)));
  }
  // Coinciding eigenvalues, turned at random: two largest, two smallest, all.
  for (int k = 0; k < 10000; ++k) {
    const Mat<3> r = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    for (const Vec<3>& values : {Vec<3>(1, 1, -2), Vec<3>(2, -1, -1), Vec<3>(0, 0, 0), Vec<3>(1e-90, 0, -1e-90)}) {
      const Mat<3> m = r * values.asDiagonal() * r.transpose();
      ASSERT_NEAR(largest_principal_stress<3>(0, components_of<3>(m)), values.maxCoeff(), 1e-7 * values.norm());
    }
  }
  EXPECT_TRUE(std::isfinite(largest_principal_stress<3>(0, Deviator<3>(Deviator<3>::Constant(1e150)))));
  // In plane strain the out-of-plane stress can be the largest.
  EXPECT_DOUBLE_EQ(largest_principal_stress<2>(10, Deviator<2>(-3, -4, 0.1)), -3);
}

TEST(Elastic, ModuliOfBasalt) {
  const Elastic basalt{22.7e9, 26.7e9};
  EXPECT_NEAR(basalt.young(), 53.1e9, 0.1e9);
  EXPECT_NEAR(basalt.longitudinal_speed(2700), 4590, 5);
}

}  // namespace
}  // namespace ejecta
