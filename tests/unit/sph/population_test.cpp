#include "sph/population.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

template <int Dim>
void expect_balanced(const Sph<Dim>& sph) {
  const ConservationErrors errors = conservation_errors(sph.initial, sph.conserved(), sph.external);
  EXPECT_LT(errors.mass, 1e-14);
  EXPECT_LT(errors.momentum, 1e-13);
  EXPECT_LT(errors.angular_momentum, 1e-13);
  EXPECT_LT(std::abs(errors.energy), 1e-12);
}

TEST(Population, ParticlesComeAndGoWithABalancedLedger) {
  const auto sph = start<3>(porous_impact);
  advance(*sph, 20);
  const std::size_t n = sph->particles.size();
  std::vector<char> doomed(n, 0);
  for (std::size_t i = 0; i < n; i += 7) doomed[i] = 1;
  remove_particles<3>(*sph, doomed);
  EXPECT_EQ(sph->particles.size(), n - (n + 6) / 7);
  EXPECT_LT(sph->external.mass, 0);
  advance(*sph, 20);
  expect_balanced(*sph);

  const std::vector<std::size_t> originals{3, 100, sph->particles.size() - 1};
  add_particles<3>(*sph, originals, [&](std::size_t i) {
    sph->particles.column(Field::position, 2)[i] += 0.2;
    sph->particles.column(Field::velocity, 1)[i] = 50;
  });
  advance(*sph, 20);
  expect_balanced(*sph);
  const auto material = sph->particles.label(Label::material);
  EXPECT_TRUE(std::ranges::is_sorted(material));
  auto ids = std::vector<std::int32_t>(sph->particles.label(Label::id).begin(), sph->particles.label(Label::id).end());
  std::ranges::sort(ids);
  EXPECT_TRUE(std::ranges::adjacent_find(ids) == ids.end());
}

TEST(Population, WhatIsTakenOutIsWhatIsMissing) {
  const auto sph = start<2>(gas_tube);
  advance(*sph, 5);
  const Totals before = sph->conserved();
  std::vector<char> doomed(sph->particles.size(), 0);
  doomed[10] = doomed[300] = 1;
  remove_particles<2>(*sph, doomed);
  EXPECT_NEAR(sph->conserved().mass - before.mass, sph->external.mass, 1e-15 * before.mass);
  EXPECT_NEAR(sph->conserved().energy() - before.energy(), sph->external.work, 1e-14 * before.energy());
}

}  // namespace
}  // namespace ejecta
