#include "base/cube_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ejecta {
namespace {

TEST(CubeRoot, IsThatOfTheLibraryToFourUnitsInTheLastPlace) {
  double worst = 0;
  for (double a = 1e-300; a < 1e300; a *= 1.0037) worst = std::max(worst, std::abs(cube_root(a) / std::cbrt(a) - 1));
  EXPECT_LT(worst, 9e-16);
  EXPECT_GT(worst, 0) << "the other one was compared with itself";
  EXPECT_EQ(cube_root(0), 0);
}

}  // namespace
}  // namespace ejecta
