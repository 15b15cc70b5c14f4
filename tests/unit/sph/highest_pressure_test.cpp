#include <gtest/gtest.h>

#include <limits>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

TEST(HighestPressure, IsOfMatterAndNotOfWhatFliesAlone) {
  const auto sph = start<3>(porous_impact);
  const auto pressure = sph->particles.column(Field::pressure);
  const auto body = sph->particles.label(Label::body);
  const auto first_of = [&](std::int32_t label) {
    return static_cast<std::size_t>(std::ranges::find(body, label) - body.begin());
  };
  std::ranges::fill(pressure, 1e6);
  const std::size_t inside = first_of(0), alone = first_of(1);
  pressure[inside] = 5e6;
  pressure[alone] = 9e6;
  EXPECT_EQ(highest_pressure(*sph), 9e6);  // the ball is whole
  // One particle of the ball is left there, among those of another piece; the others are far away.
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body[i] == 1 && i != alone)
      sph->particles.set_vector(Field::position, i, Vec<3>(1, 1, 1) * (1.0 + 1.0 * static_cast<double>(i)));
  sph->particles.set_vector(Field::position, alone,
                            sph->particles.vector(Field::position, inside) + Vec<3>(1e-3, 0, 0));
  sph->lists.invalidate();
  sph->evaluate();
  std::ranges::fill(pressure, 1e6);
  pressure[inside] = 5e6;
  pressure[alone] = 9e6;
  EXPECT_EQ(highest_pressure(*sph), 5e6);
}

}  // namespace
}  // namespace ejecta
