#include "base/timers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace ejecta {
namespace {

TEST(StageTimers, BookWallTimeByNameInOrderOfFirstUse) {
  StageTimers timers;
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  timers.time("second", wait);
  timers.time("first", [] {});
  timers.time("second", wait);
  ASSERT_EQ(timers.entries().size(), 2u);
  EXPECT_EQ(timers.entries()[0].name, "second");
  EXPECT_EQ(timers.entries()[0].calls, 2);
  EXPECT_GE(timers.seconds("second"), 0.004);
  EXPECT_LT(timers.seconds("first"), timers.seconds("second"));
  EXPECT_EQ(timers.seconds("never"), 0);
}

}  // namespace
}  // namespace ejecta
