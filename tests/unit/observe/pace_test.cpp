#include "observe/pace.hpp"

#include <gtest/gtest.h>

namespace ejecta {
namespace {

TEST(Pace, IsThatOfLatelyAndNotOfTheWholeRun) {
  Pace pace;
  EXPECT_FALSE(pace.left(1.0, {}));
  // A thousand seconds at 1 ms of simulated time a second, then five times as slow: steps have become short.
  for (int second = 0; second <= 1000; ++second) pace.add(second, {1e-3 * second, 1e-3, second});
  EXPECT_NEAR(*pace.left(2.0, {}), 1000, 1e-6);
  for (int second = 1; second <= 200; ++second) pace.add(1000 + second, {1 + 2e-4 * second, 2e-4, 1000 + second});
  EXPECT_NEAR(*pace.left(2.0, {}), (2.0 - 1.04) / 2e-4, 1e-6);
  EXPECT_NEAR(*pace.left(2.0, 1250), 50, 1e-6);  // ended by the number of its steps
  EXPECT_EQ(*pace.left(1.0, {}), 0);
}

TEST(Pace, TakesHalfAMinuteAtLeast) {
  Pace pace;
  pace.add(0, {});
  pace.add(1, {1e-6, 1e-6, 1});
  pace.add(29, {29e-6, 1e-6, 2});
  pace.add(30, {32e-6, 1e-6, 3});
  EXPECT_NEAR(*pace.left(64e-6, {}), 30, 1e-6);
}

TEST(Pace, TakesATenthOfALongRun) {
  Pace pace;
  // Slow but for its last hundred seconds.
  for (int second = 0; second <= 900; ++second) pace.add(second, {1e-3 * second, 1e-3, second});
  for (int second = 1; second <= 100; ++second) pace.add(900 + second, {0.9 + 2e-3 * second, 2e-3, 900 + second});
  EXPECT_NEAR(*pace.left(2.1, {}), 500, 1e-6);
  for (int second = 1; second <= 40; ++second) pace.add(1000 + second, {1.1 + 1e-2 * second, 1e-2, 1000 + second});
  EXPECT_NEAR(*pace.left(2.5, {}), 1.0 * 104 / (2e-3 * 64 + 1e-2 * 40), 1e-6);
}

TEST(Pace, ARunThatStandsStillHasNone) {
  Pace pace;
  for (int second = 0; second < 100; ++second) pace.add(second, {1e-6, 1e-9, 7});
  EXPECT_FALSE(pace.left(1.0, {}));
}

}  // namespace
}  // namespace ejecta
