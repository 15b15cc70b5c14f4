#include "sph/diagnostics.hpp"

#include <gtest/gtest.h>

#include "unit/base/thread_counts.hpp"
#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

TEST(Diagnostics, TotalsAddUpTwoParticles) {
  auto p = random_cloud<3>(2, 1, 1, 1, {Field::smoothing_length, Field::specific_energy});
  p.column(Field::mass)[0] = 2;
  p.column(Field::mass)[1] = 3;
  p.set_vector(Field::position, 0, Vec<3>(1, 0, 0));
  p.set_vector(Field::position, 1, Vec<3>(0, 2, 0));
  p.set_vector(Field::velocity, 0, Vec<3>(0, 5, 0));
  p.set_vector(Field::velocity, 1, Vec<3>(0, 0, -4));
  p.column(Field::specific_energy)[0] = 10;
  p.column(Field::specific_energy)[1] = -1;
  const Totals t = totals(p);
  EXPECT_EQ(t.mass, 5);
  EXPECT_EQ(t.momentum, Vec<3>(0, 10, -12));
  EXPECT_EQ(t.angular_momentum, Vec<3>(-24, 0, 10));
  EXPECT_EQ(t.momentum_scale, 22);
  // The centre of mass is at (0.4, 1.2): sqrt(1.8) and sqrt(0.8) away.
  EXPECT_NEAR(t.angular_scale, 10 * std::sqrt(1.8) + 12 * std::sqrt(0.8), 1e-13);
  EXPECT_EQ(t.kinetic, 49);
  EXPECT_EQ(t.internal, 17);
  EXPECT_EQ(t.energy(), 66);
}

TEST(Diagnostics, TotalsAreTheSameForEveryThreadCount) {
  auto p = random_cloud<2>(5000, 2, 1, 1, {Field::smoothing_length, Field::specific_energy});
  Uniform uniform(3);
  for (double& v : p.column(Field::velocity)) v = uniform(-1, 1);
  std::vector<double> energies;
  for_thread_counts([&](int) { energies.push_back(totals(p).energy()); });
  EXPECT_EQ(energies[0], energies[1]);
  EXPECT_EQ(energies[0], energies[2]);
}

TEST(Diagnostics, TheMedianPeakPressureHalvesTheMassOfTheBody) {
  auto p = random_cloud<2>(4, 1, 1, 1, {Field::smoothing_length, Field::pressure_peak});
  const std::array peaks{5.0, 1.0, 9.0, 3.0}, masses{1.0, 4.0, 1.0, 2.0};
  std::ranges::copy(peaks, p.column(Field::pressure_peak).begin());
  std::ranges::copy(masses, p.column(Field::mass).begin());
  std::ranges::fill(p.label(Label::body), 1);
  p.label(Label::body)[2] = 0;
  EXPECT_EQ(median_peak_pressure(p, 1), 1);
  p.column(Field::mass)[1] = 2.5;
  EXPECT_EQ(median_peak_pressure(p, 1), 3);
}

TEST(Diagnostics, FacesTakeMomentumAndTorque) {
  Boundary boundary;
  EXPECT_TRUE(kept_between(boundary).momentum && kept_between(boundary).angular_momentum);
  boundary.lower[1] = boundary.upper[1] = BoundaryKind::periodic;
  EXPECT_TRUE(kept_between(boundary).momentum);
  EXPECT_FALSE(kept_between(boundary).angular_momentum);
  for (const BoundaryKind mirror : {BoundaryKind::reflecting, BoundaryKind::symmetry}) {
    boundary.upper[0] = mirror;
    EXPECT_FALSE(kept_between(boundary).momentum || kept_between(boundary).angular_momentum);
  }
}

TEST(Diagnostics, ErrorsAreRelative) {
  Totals before, now;
  before.mass = 4;
  before.momentum = {0, 0, 8};
  before.momentum_scale = 10;
  before.kinetic = 100;
  before.internal = -50;
  now = before;
  now.mass = 5;
  now.momentum = {3, 4, 8};
  now.internal = -40;
  before.angular_scale = 4;
  now.angular_momentum = {0, 0, 5};
  ExternalLoad turned;
  turned.angular_impulse = {0, 0, 3};
  EXPECT_EQ(conservation_errors(before, now, turned).angular_momentum, 0.5);
  const ConservationErrors errors = conservation_errors(before, now);
  EXPECT_EQ(errors.mass, 0.25);
  EXPECT_EQ(errors.momentum, 0.5);
  EXPECT_EQ(errors.energy, 0.1);
}

}  // namespace
}  // namespace ejecta
