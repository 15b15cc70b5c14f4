#include <gtest/gtest.h>

#include <algorithm>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

TEST(HighestPressure, IsOfMatterAndNotOfWhatFliesAlone) {
  const auto sph = start<3>(porous_impact);
  const auto first_of = [&](std::int32_t body) {
    return static_cast<std::size_t>(std::ranges::find(sph->particles.label(Label::body), body) -
                                    sph->particles.label(Label::body).begin());
  };
  const auto highest_with = [&](std::size_t ball) {
    const auto pressure = sph->particles.column(Field::pressure);
    std::ranges::fill(pressure, 1e6);
    pressure[first_of(0)] = 5e6;
    pressure[ball] = 9e6;
    return highest_pressure(*sph);
  };
  EXPECT_EQ(highest_with(first_of(1)), 9e6);  // the ball is whole
  // One particle of the ball is left, among those of the target; the others are far from each other.
  const std::int32_t left = sph->particles.label(Label::id)[first_of(1)];
  Vec<3> far(1, 1, 1);
  for (std::size_t i = 0; i < sph->particles.size(); ++i) {
    if (sph->particles.label(Label::body)[i] != 1) continue;
    const bool stays = sph->particles.label(Label::id)[i] == left;
    sph->particles.set_vector(Field::position, i, stays ? Vec<3>(1e-3, 2e-3, 3e-3) : (far += Vec<3>(1, 0, 0)));
  }
  sph->lists.invalidate();
  sph->evaluate();
  const auto id = sph->particles.label(Label::id);
  EXPECT_EQ(highest_with(static_cast<std::size_t>(std::ranges::find(id, left) - id.begin())), 5e6);
}

}  // namespace
}  // namespace ejecta
