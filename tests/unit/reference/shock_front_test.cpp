#include "model/shock_front.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ejecta {
namespace {

const std::vector<double> r{1, 2, 3, 4, 5, 6};

TEST(ShockFront, LiesHalfWayUp) {
  const auto front = find_shock_front(r, std::vector<double>{4, 6, 9, 3, 1, 1}, 1);
  ASSERT_TRUE(front);
  EXPECT_EQ(front->peak_pressure, 9);
  EXPECT_DOUBLE_EQ(front->radius, 3 + 4.0 / 6);  // half is 5
}

TEST(ShockFront, IsTheOutermostEvenIfMorePressureIsFurtherIn) {
  const auto front = find_shock_front(r, std::vector<double>{100, 50, 6, 9, 1, 1}, 1);
  ASSERT_TRUE(front);
  EXPECT_EQ(front->peak_pressure, 9);
  EXPECT_DOUBLE_EQ(front->radius, 4.5);
}

/// A dent of less than a tenth is noise behind the same shock, one of a tenth is its end.
TEST(ShockFront, PeakOutlastsSmallDents) {
  const auto peak = [](double dent) {
    return find_shock_front(r, std::vector<double>{5, 12, dent, 10, 1, 1}, 1)->peak_pressure;
  };
  EXPECT_EQ(peak(9.1), 12);
  EXPECT_EQ(peak(8.9), 10);
}

TEST(ShockFront, NothingIsThereInQuietGas) {
  EXPECT_FALSE(find_shock_front(r, std::vector<double>{1, 1.05, 1.1, 1.05, 1, 1}, 1));
  EXPECT_FALSE(find_shock_front({}, {}, 1));
  EXPECT_TRUE(find_shock_front(r, std::vector<double>{1, 1, 1.2, 1, 1, 1}, 1));
  EXPECT_TRUE(find_shock_front(r, std::vector<double>{0, 0, 1e-9, 0, 0, 0}, 0));
}

TEST(ShockFront, AtTheLastSample) {
  const auto front = find_shock_front(r, std::vector<double>{1, 1, 1, 1, 1, 7}, 1);
  ASSERT_TRUE(front);
  EXPECT_EQ(front->radius, 6);
  EXPECT_EQ(find_shock_front(r, std::vector<double>{7, 1, 1, 1, 1, 1}, 1)->radius, 1.5);
}

}  // namespace
}  // namespace ejecta
