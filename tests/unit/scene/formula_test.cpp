#include "scene/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"

namespace ejecta {
namespace {

TEST(Formula, KnowsThePlaceTheRadiusAndTheSpacing) {
  const FormulaPoint point{.x = {1, 2, 3}, .r = 5, .spacing = 0.25};
  EXPECT_DOUBLE_EQ(Formula("x + 10*y + 100*z")(point), 321);
  EXPECT_DOUBLE_EQ(Formula("r/dx")(point), 20);
  EXPECT_DOUBLE_EQ(Formula("hypot(3*x, 2*y)")(point), 5);
  EXPECT_DOUBLE_EQ(Formula("r < 0.2 ? 5*r : (r < 6 ? sin(_pi*x/2) : 0)")(point), 1);
  EXPECT_DOUBLE_EQ(Formula("sin(pi*x/2)")(point), 1);
  EXPECT_DOUBLE_EQ(Formula("2.5e-3")(point), 2.5e-3);
}

TEST(Formula, IsNotFiniteWhereItIsNotDefined) {
  EXPECT_FALSE(std::isfinite(Formula("1/x")({})));
  EXPECT_FALSE(std::isfinite(Formula("sqrt(x)")({.x = {-1, 0, 0}})));
}

TEST(Formula, SurvivesBeingMoved) {
  Formula a("x");
  const Formula b = std::move(a);
  EXPECT_EQ(b({.x = {7, 0, 0}}), 7);
}

TEST(Formula, RefusesWhatItCannotRead) {
  for (const char* text : {"", "x +", "q", "sin(", "x = 3 y", "1, 2", "\"x\"", "x; y"})
    EXPECT_THROW(Formula{text}, InputError) << text;
}

TEST(Formula, CannotAssignToThePlace) { EXPECT_THROW(Formula{"x = 3"}, InputError); }

}  // namespace
}  // namespace ejecta
