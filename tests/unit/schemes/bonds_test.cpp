#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "particles/smoothing_metric.hpp"
#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

PairPassSettings bonded_settings(Precision precision, bool asph) {
  auto s = settings_of(Kernel::wendland_c2, precision, true, true);
  s.bonded = s.contacts = true;
  s.asph = asph;
  s.rules.sizes = {spacing, spacing};
  return s;
}

/// A cloud, all of it bonded as it stands now, then moved to F x with velocities A x.
template <int Dim>
Particles<Dim> deformed(const Mat<Dim>& F, const Mat<Dim>& A, bool asph) {
  std::vector<Field> more{Field::start_position, Field::bond, Field::stretch};
  if (asph) more.push_back(Field::smoothing_metric);
  auto p = random_matter<Dim>(400, 61, true, 1.5, more);
  even_surroundings(p);
  if (asph) random_ellipsoids(p, 2, 62);
  const double longest = svd_of<Dim>(F).singularValues()[0];
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim> x = p.vector(Field::position, i);
    p.set_vector(Field::start_position, i, x);
    p.column(Field::bond)[i] = 1;
    p.column(Field::stretch)[i] = std::max(1.0, longest);  // the lists reach out for bonds so far
    p.set_vector(Field::position, i, F * x);
    p.set_vector(Field::velocity, i, A * F * x);
  }
  return p;
}

TEST(Bonds, AUniformStretchGivesTheExactGradientAndKeepsTheNeighbours) {
  Mat<3> A;
  A << 1, -2, 3, 0.5, -1.5, 2.5, -3, 0.25, 4;
  A *= 1e4;
  Mat<3> draw = Mat<3>::Identity();
  draw(0, 0) = 2.5;
  draw(0, 1) = 0.4;
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const bool asph : {false, true}) {
      const auto settings = bonded_settings(precision, asph);
      auto still = deformed<3>(Mat<3>::Identity(), A, asph), drawn = deformed<3>(draw, A, asph);
      run_rates(still, settings);
      run_rates(drawn, settings);
      const double tolerance = precision == Precision::mixed ? 3e-5 : 1e-12;
      std::size_t whole = 0;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        EXPECT_NEAR(drawn.column(Field::zeroth_moment)[i] / still.column(Field::zeroth_moment)[i], 1, tolerance);
        EXPECT_NEAR(still.column(Field::stretch)[i], 1, 1e-6);
        const Vec<3> cells = drawn.vector(Field::start_position, i) / spacing;
        if ((cells.array() < -0.5).any() || (cells.array() > 3.5).any()) continue;
        ++whole;
        EXPECT_LT((velocity_gradient_of(drawn, i) - A).norm(), tolerance * A.norm());
        EXPECT_GT(drawn.column(Field::stretch)[i], 2.2);  // of the bond nearest to the direction of the draw
        EXPECT_LT(drawn.column(Field::stretch)[i], 2.54);
      }
      EXPECT_GT(whole, 50u);
    }
}

TEST(Bonds, RatesAreTheFormulasAlsoWhereSomeHaveNone) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const bool asph : {false, true}) {
      SCOPED_TRACE(testing::Message() << "asph " << asph << ", precision " << static_cast<int>(precision));
      auto settings = bonded_settings(precision, asph);
      Mat<3> turned = Eigen::AngleAxisd(2.5, Vec<3>(1, 2, 3).normalized()).toRotationMatrix();
      turned.col(0) *= 1.3;
      auto p = deformed<3>(turned, Mat<3>::Zero(), asph);
      Uniform uniform(63);
      for (std::size_t i = 0; i < p.size(); ++i) {
        p.column(Field::bond)[i] = i % 5 != 0;
        p.set_vector(Field::velocity, i, Vec<3>(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) * 100);
        // Some have come from far away: they meet like strangers.
        if (i % 17 == 0) p.column(Field::start_position)[i] += 20 * spacing;
        // Bonded ones keep the round support of the start, whatever way they have turned since.
        if (asph && i % 5 != 0)
          p.set_symmetric(Field::smoothing_metric, i, round_metric<3>(p.column(Field::smoothing_length)[i]));
      }
      const Reference<3> reference(p, settings);
      run_rates(p, settings);
      const double tolerance = precision == Precision::mixed ? 2e-5 : 2e-13;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Sums<3> sums = reference.rates(i);
        EXPECT_LE((p.vector(Field::acceleration, i) - sums.acceleration).norm(), tolerance * sums.acceleration_scale);
        EXPECT_LE(std::abs(p.column(Field::specific_energy_rate)[i] - sums.heating), tolerance * sums.heating_scale);
        EXPECT_LE((velocity_gradient_of(p, i) - sums.gradient).norm(), 10 * tolerance * sums.gradient_scale);
        EXPECT_NEAR(p.column(Field::stretch)[i], sums.stretch, 1e-5 * sums.stretch);
      }
    }
}

/// No stress, and no velocity.
template <int Dim>
Particles<Dim> relaxed(const Mat<Dim>& F, bool asph) {
  auto p = deformed<Dim>(F, Mat<Dim>::Zero(), asph);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.column(Field::pressure)[i] = 0;
    for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::deviatoric_stress, k)[i] = 0;
  }
  return p;
}

TEST(Bonds, AnAlternatingPatternIsPushedBackAndAUniformDeformationIsNot) {
  for (const bool asph : {false, true}) {
    const auto settings = bonded_settings(Precision::double_precision, asph);
    Mat<2> F;
    F << 0.4, -1.2, 0.9, 0.3;
    auto uniform = relaxed<2>(F, asph), pattern = uniform;
    const auto away = [&](std::size_t i) -> Vec<2> {  // from where F takes it: every other column up, the rest down
      const Vec<2> start = pattern.vector(Field::start_position, i);
      return Vec<2>(0, std::lround(start[0] / spacing) % 2 == 0 ? 0.1 : -0.1) * spacing;
    };
    for (std::size_t i = 0; i < pattern.size(); ++i)
      pattern.set_vector(Field::position, i, pattern.vector(Field::position, i) + away(i));
    run_rates(uniform, settings);
    run_rates(pattern, settings);
    double work = 0, scale = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      const double c = pattern.column(Field::sound_speed)[i], stiff = hourglass_stiffness * c * c / spacing;
      EXPECT_LT(uniform.vector(Field::acceleration, i).norm(), 1e-11 * stiff);
      const double m = pattern.column(Field::mass)[i];
      work += m * pattern.vector(Field::acceleration, i).dot(away(i));
      scale += m * stiff * away(i).norm();
    }
    EXPECT_LT(work, -0.02 * scale);
  }
}

TEST(Bonds, ViscosityTakesEnergyFromMotionAlsoAfterATurn) {
  for (const bool asph : {false, true})
    for (const double angle : {0.0, 1.0, 2.0, 3.1}) {
      auto settings = bonded_settings(Precision::double_precision, asph);
      const Mat<2> turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
      auto p = relaxed<2>(turn, asph);  // no stress: all that is left is viscosity
      for (std::size_t i = 0; i < p.size(); ++i) p.set_vector(Field::velocity, i, -1e4 * p.vector(Field::position, i));
      run_rates(p, settings);
      for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_GT(p.column(Field::specific_energy_rate)[i], 0) << "asph " << asph << ", turned by " << angle;
    }
}

}  // namespace
}  // namespace ejecta
