#include "schemes/gradient_correction.hpp"

#include <gtest/gtest.h>

#include "unit/schemes/random_matter.hpp"

namespace ejecta {
namespace {

template <int Dim>
Mat<Dim> random_matrix(Uniform& uniform) {
  return Mat<Dim>::NullaryExpr([&] { return uniform(-1, 1); });
}
template <int Dim>
Mat<Dim> random_symmetric(Uniform& uniform) {
  const Mat<Dim> m = random_matrix<Dim>(uniform);
  return m + m.transpose();
}
template <int Dim>
Mat<Dim> random_spin(Uniform& uniform) {
  const Mat<Dim> m = random_matrix<Dim>(uniform);
  return m - m.transpose();
}

/// Moments of every kind: whole, faded in one or all directions, of neighbours in a plane, in a line, of none.
template <int Dim>
std::vector<Mat<Dim>> moments() {
  std::vector<Mat<Dim>> all;
  Uniform uniform(3);
  for (const double s : {1.0, 0.5, 0.201, 0.199, 0.05, 1e-3, 1e-9, 0.0})
    for (const double t : {1.0, 0.1, 0.0}) {
      Vec<Dim> stretches = Vec<Dim>::Constant(t);
      stretches[0] = 1.1 * t;
      stretches[Dim - 1] = s;
      const auto svd = svd_of<Dim>(Mat<Dim>::Identity() + 0.5 * random_matrix<Dim>(uniform));
      all.push_back(svd.matrixU() * stretches.asDiagonal() * svd.matrixV().transpose());
    }
  return all;
}

template <int Dim>
void expect_invariances() {
  Uniform uniform(4);
  for (const Mat<Dim>& M : moments<Dim>()) {
    const auto c = gradient_correction<Dim>(M);
    const Mat<Dim> sigma = random_symmetric<Dim>(uniform), spin = random_spin<Dim>(uniform),
                   R = random_matrix<Dim>(uniform) * M;
    const Mat<Dim> turned = c.gradient(spin * M), T = c.stress(sigma), L = c.gradient(R);
    EXPECT_LT((turned + turned.transpose()).norm(), 1e-13) << "rotation strains with moment\n" << M;
    EXPECT_LT((T * M.transpose() - M * T.transpose()).norm(), 1e-13) << "torque with moment\n" << M;
    EXPECT_NEAR(sigma.cwiseProduct(L).sum(), T.cwiseProduct(R).sum(), 1e-13) << "work is not heat with moment\n" << M;
    EXPECT_LT(L.norm(), 3 * std::pow(Dim, 1.5)) << "grows beyond limits with moment\n" << M;
  }
}

TEST(GradientCorrection, RotationHasNoStrainStressNoTorqueAndWorkIsHeat) {
  expect_invariances<2>();
  expect_invariances<3>();
}

TEST(GradientCorrection, IsExactWithEnoughNeighboursAndFadesWithFewer) {
  Uniform uniform(5);
  for (const Mat<3>& M : moments<3>()) {
    const double least = svd_of<3>(M).singularValues()[2];
    const Mat<3> A = random_matrix<3>(uniform);
    const auto c = gradient_correction<3>(M);
    EXPECT_EQ(c.whole, least >= least_moment);
    if (c.whole)
      EXPECT_LT((c.gradient(A * M) - A).norm(), 1e-13);
    else
      EXPECT_LT((c.gradient(A * M) - c.P * A * c.P.transpose()).norm() * least_moment, 1e-13);
  }
  EXPECT_EQ(gradient_correction<2>(Mat<2>::Zero()).stress(Mat<2>::Identity()), Mat<2>(Mat<2>::Zero()));
}

TEST(GradientCorrection, DoesNotJumpWhereItBeginsToFade) {
  const auto with = [](double s) {
    Mat<2> M;
    M << 1, 0.3, 0, s;
    return M;
  };
  // The least stretch crosses the limit between the two.
  double low = 0.1, high = 0.5;
  for (int k = 0; k < 60; ++k)
    (gradient_correction<2>(with(0.5 * (low + high))).whole ? high : low) = 0.5 * (low + high);
  const auto below = gradient_correction<2>(with(low - 1e-9)), above = gradient_correction<2>(with(high + 1e-9));
  EXPECT_LT((below.Q - above.Q).norm(), 1e-6);
  EXPECT_LT((below.P - above.P).norm(), 1e-6);
  EXPECT_FALSE(below.whole);
}

TEST(ContactStress, WorkIsHeatAndNoTorqueIsLeft) {
  Uniform uniform(6);
  for (const Mat<3>& own_moment : moments<3>()) {
    const Vec<3> normal = Vec<3>(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    const Mat<3> others_moment = 0.3 * normal * Vec<3>(normal + 0.2 * Vec<3>(1, 0, 0)).transpose(),
                 all_moment = own_moment + others_moment;
    const auto own = gradient_correction<3>(own_moment), all = gradient_correction<3>(all_moment);
    const Mat<3> R = random_matrix<3>(uniform) * own_moment, others = random_matrix<3>(uniform) * others_moment;
    const Mat<3> sigma = random_symmetric<3>(uniform) - 5 * Mat<3>::Identity();
    const auto t = contact_stress<3>(sigma, normal, own, all);
    const Mat<3> L = contact_gradient<3>(own.gradient(R), all.gradient(R + others), normal, true);
    EXPECT_NEAR(sigma.cwiseProduct(L).sum(), t.own.cwiseProduct(R).sum() + t.others.cwiseProduct(others).sum(), 1e-11);
    const Mat<3> torque = t.own * own_moment.transpose() + t.others * others_moment.transpose();
    EXPECT_LT((torque - torque.transpose()).norm(), 1e-12);
    const auto tension = contact_stress<3>(Mat<3>::Identity(), normal, own, all);
    EXPECT_TRUE(tension.others.isZero(0)) << "contact does not pull";
  }
}

TEST(ContactStress, OpeningStrainsNothingThatIsNotPressed) {
  const Vec<2> normal(1, 0);
  Mat<2> opening = Mat<2>::Zero();
  opening(0, 0) = 3;
  const Mat<2> none = Mat<2>::Zero();
  EXPECT_EQ(contact_gradient<2>(none, opening, normal, false), none);
  EXPECT_EQ(contact_gradient<2>(none, opening, normal, true), opening);
  EXPECT_EQ(contact_gradient<2>(none, Mat<2>(-opening), normal, false), Mat<2>(-opening));
  Mat<2> sliding = none;
  sliding(1, 0) = 7;
  EXPECT_EQ(contact_gradient<2>(none, sliding, normal, true), none) << "sliding does not shear";
}

/// A cloud whose supports are `share` of what a whole neighbourhood needs, moving as A x.
template <int Dim>
Particles<Dim> moving(const Mat<Dim>& A, double share) {
  auto p = random_matter<Dim>(500, 12, true);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.column(Field::smoothing_length)[i] *= share;
    p.set_vector(Field::velocity, i, A * p.vector(Field::position, i) + 10 * Vec<Dim>::Ones());
  }
  return p;
}

TEST(GradientCorrection, ARigidlyTurningCloudIsNotStrainedHoweverFewTheNeighbours) {
  Uniform uniform(7);
  const Mat<3> spin = 1e5 * random_spin<3>(uniform);
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const double share : {1.0, 0.7, 0.5, 0.35}) {
      auto p = moving<3>(spin, share);
      run_rates(p, settings_of(Kernel::wendland_c2, precision, true, true));
      double strain = 0, turn = 0;
      std::size_t alone = 0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Mat<3> L = velocity_gradient_of(p, i);
        strain = std::max(strain, (L + L.transpose()).norm());
        turn += (L - L.transpose()).norm() / static_cast<double>(p.size());
        alone += p.column(Field::zeroth_moment)[i] == 0;
      }
      EXPECT_LT(strain, (precision == Precision::mixed ? 1e-5 : 1e-12) * spin.norm()) << "supports of " << share;
      EXPECT_GT(turn, 0.02 * spin.norm());
      if (share < 0.4) {
        EXPECT_GT(alone, 5u);
      }
    }
}

/// The highest frequency of sound waves [c/h] in a cloud, by power iteration: velocities make gradients, gradients
/// pressures, and pressures accelerations.
double fastest_swing(Particles<2> p) {
  auto settings = settings_of(Kernel::wendland_c2, Precision::double_precision, true, true);
  settings.viscosity_alpha = settings.viscosity_beta = 0;
  constexpr double modulus = 1e9;
  double squared = 0;
  for (int k = 0; k < 40; ++k) {
    double speed2 = 0, acceleration2 = 0;
    for (std::size_t i = 0; i < p.size(); ++i) speed2 += p.vector(Field::velocity, i).squaredNorm();
    run_rates(p, settings);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.column(Field::pressure)[i] = -modulus * velocity_gradient_of(p, i).trace();
      for (int d = 0; d < deviator_size<2>; ++d) p.column(Field::deviatoric_stress, d)[i] = 0;
    }
    run_rates(p, settings);
    for (std::size_t i = 0; i < p.size(); ++i) acceleration2 += p.vector(Field::acceleration, i).squaredNorm();
    squared = std::sqrt(acceleration2 / speed2);
    for (std::size_t i = 0; i < p.size(); ++i)
      p.set_vector(Field::velocity, i, p.vector(Field::acceleration, i) / squared);
  }
  return std::sqrt(squared * p.column(Field::density)[0] / modulus) * p.column(Field::smoothing_length)[0];
}

/// The few of a torn clump, half a spacing from each other: with exact gradients they swing at up to 7.4 c/h. (Steps of
/// 0.4 crossings of h are stable up to 3 c/h without viscosity.)
TEST(GradientCorrection, AClumpIsNotMuchStifferThanALattice) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto p = random_matter<2>(6, 70 + seed, true);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.column(Field::mass)[i] = 2000 * spacing * spacing;
      p.column(Field::density)[i] = 2000;
      p.column(Field::smoothing_length)[i] = 1.3 * spacing;
      p.set_vector(Field::position, i, 0.5 * p.vector(Field::position, i));
      p.label(Label::material)[i] = 0;
    }
    p.set_material_ranges({{0, p.size()}, {p.size(), p.size()}});
    EXPECT_LT(fastest_swing(p), 5) << seed;
  }
}

}  // namespace
}  // namespace ejecta
