#include "observe/events.hpp"

#include <gtest/gtest.h>

namespace ejecta {
namespace {

using Words = std::vector<std::string_view>;

EventWatch watch_all() { return EventWatch({event_words.begin(), event_words.end()}); }

TEST(EventWatch, FirstContactHappensOnce) {
  EventWatch watch = watch_all();
  Signs signs;
  signs.momentum_change = 1e-15;
  EXPECT_EQ(watch.look(signs), Words{});
  signs.momentum_change = 1e-3;
  EXPECT_EQ(watch.look(signs), Words{"first contact"});
  EXPECT_EQ(watch.look(signs), Words{});
}

TEST(EventWatch, PeakPressureHasPassedOnceItHasFallenAndWasOne) {
  EventWatch watch = watch_all();
  Signs signs;
  signs.noteworthy_pressure = 100;
  for (const double pressure : {10.0, 5.0, 1000.0, 900.0}) {
    signs.pressure = pressure;
    EXPECT_EQ(watch.look(signs), Words{}) << pressure;
  }
  signs.pressure = 700;
  EXPECT_EQ(watch.look(signs), Words{"peak pressure passed"});
}

TEST(EventWatch, FragmentsAreToldFromTheFirstLook) {
  EventWatch watch = watch_all();
  Signs signs;
  signs.fragments = 2;
  signs.largest_fragment = 1;
  EXPECT_EQ(watch.look(signs), Words{});
  EXPECT_EQ(watch.look(Signs{}), Words{});  // no search at this step
  signs.fragments = 3;
  signs.largest_fragment = 0.97;
  EXPECT_EQ(watch.look(signs), Words{"first fragment"});
  signs.largest_fragment = 0.94;
  EXPECT_EQ(watch.look(signs), Words{"largest fragment changed"});
  signs.largest_fragment = 0.90;
  EXPECT_EQ(watch.look(signs), Words{});
  signs.largest_fragment = 0.88;
  EXPECT_EQ(watch.look(signs), Words{"largest fragment changed"});
}

TEST(EventWatch, TheTimeStepCollapsesTenfold) {
  EventWatch watch = watch_all();
  Signs signs;
  for (const auto& [step, words] : {std::pair{1.0, Words{}},
                                    {0.2, Words{}},
                                    {0.09, Words{"time step collapsed"}},
                                    {0.5, Words{}},
                                    {0.01, Words{}},
                                    {0.008, Words{"time step collapsed"}}}) {
    signs.time_step = step;
    EXPECT_EQ(watch.look(signs), words) << step;
  }
}

TEST(EventWatch, SaysNothingOfWhatNobodyWants) {
  EventWatch watch({"peak pressure passed"});
  Signs signs;
  signs.momentum_change = 1;
  EXPECT_EQ(watch.look(signs), Words{});
}

TEST(EventWatch, GoesOnFromWhatItRemembered) {
  EventWatch before = watch_all(), after = watch_all();
  Signs signs;
  signs.momentum_change = 1;
  signs.pressure = 1000;
  before.look(signs);
  after.remember(before.memory());
  signs.pressure = 500;
  EXPECT_EQ(after.look(signs), Words{"peak pressure passed"});
}

}  // namespace
}  // namespace ejecta
