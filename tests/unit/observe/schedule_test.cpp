#include "observe/schedule.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace ejecta {
namespace {

/// A run of ten seconds.
Scene scene_of(int frames) {
  Scene scene;
  scene.time_end = 10;
  scene.insitu.frames = frames;
  return scene;
}

/// Steps drawn of a run of ten steps of one second, each of which takes one second of wall time.
std::vector<int> drawn_steps(FrameSchedule& schedule, int first = 0) {
  std::vector<int> drawn;
  for (int step = first; step <= 10; ++step)
    if (!schedule.take({step, 1.0 * step, 1.0 * step}, step == 10).reason.empty()) drawn.push_back(step);
  return drawn;
}

std::vector<int> drawn_steps(const Scene& scene) {
  FrameSchedule schedule(scene);
  return drawn_steps(schedule);
}

TEST(FrameSchedule, DrawsFirstLastAndEquallySpacedBetween) {
  FrameSchedule schedule(scene_of(3));
  EXPECT_EQ(schedule.next(), 0);
  EXPECT_EQ(drawn_steps(schedule), (std::vector{0, 5, 10}));
}

TEST(FrameSchedule, AStepThatEndsAtTheTimeOfAFrameButForRoundingDrawsIt) {
  FrameSchedule schedule(scene_of(11));
  EXPECT_FALSE(schedule.take({0, 0, 0}, false).reason.empty());
  EXPECT_FALSE(schedule.take({1, 1 * (1 - 1e-15), 0}, false).reason.empty());
  EXPECT_EQ(schedule.next(), 2);
}

TEST(FrameSchedule, TimesMayBeListedOrDenseAtFirst) {
  Scene scene = scene_of(3);
  scene.insitu.times.list = {7, 2};
  EXPECT_EQ(drawn_steps(scene), (std::vector{0, 2, 7, 10}));
  scene = scene_of(3);
  scene.insitu.times.dense_early = true;
  FrameSchedule schedule(scene);
  schedule.take({0, 0, 0}, false);
  EXPECT_DOUBLE_EQ(schedule.next(), 2.5);
}

TEST(FrameSchedule, MoreFramesEverySoManyStepsOrSoMuchTime) {
  Scene scene = scene_of(2);
  scene.insitu.every = {"4 steps"};
  EXPECT_EQ(drawn_steps(scene), (std::vector{0, 4, 8, 10}));
  scene.insitu.every = {"3 s"};
  EXPECT_EQ(drawn_steps(scene), (std::vector{0, 3, 6, 9, 10}));
  scene.insitu.every = {"5 s wall", "9 steps"};
  EXPECT_EQ(drawn_steps(scene), (std::vector{0, 5, 9, 10}));
}

TEST(FrameSchedule, StepsEndAtTimesAndNeverBecauseOfTheWallClock) {
  Scene scene = scene_of(2);
  scene.insitu.every = {"3 s wall", "2 steps"};
  FrameSchedule schedule(scene);
  schedule.take({0, 0, 0}, false);
  EXPECT_EQ(schedule.next(), 10);
  schedule.add({1.5}, "after something");
  EXPECT_EQ(schedule.next(), 10);
}

TEST(FrameSchedule, SaysWhy) {
  Scene scene = scene_of(3);
  scene.output.times = {3};
  scene.insitu.every = {"2 steps"};
  FrameSchedule schedule(scene);
  const std::vector<std::string> expected{"every 2 steps", "",      "every 2 steps", "output.times",
                                          "every 2 steps", "frame", "every 2 steps", "",
                                          "every 2 steps", "",      "every 2 steps"};
  for (int step = 0; step <= 10; ++step) {
    const FrameSchedule::Due due = schedule.take({step, 1.0 * step, 0}, step == 10);
    EXPECT_EQ(due.reason, expected[static_cast<std::size_t>(step)]) << step;
    EXPECT_EQ(due.always, step == 3 || step == 10) << step;
  }
}

TEST(FrameSchedule, ABurstIsDrawnAtTheNextSteps) {
  FrameSchedule schedule(scene_of(2));
  schedule.take({0, 0, 0}, false);
  schedule.add({2.5, 2.7, 4.1}, "after first contact");
  const FrameSchedule::Due due = schedule.take({3, 3, 0}, false);
  EXPECT_TRUE(due.on_credit && !due.always);
  EXPECT_EQ(drawn_steps(schedule, 4), (std::vector{5, 10}));
}

TEST(FrameSchedule, GoesOnAfterARestartWithTheNextFrame) {
  FrameSchedule schedule(scene_of(6));
  schedule.resume({4, 4, 4});
  EXPECT_EQ(schedule.next(), 6);
}

TEST(FrameSchedule, NoStepIsDrawnTwice) {
  FrameSchedule schedule(scene_of(11));
  EXPECT_FALSE(schedule.take({3, 3, 0}, false).reason.empty());
  EXPECT_TRUE(schedule.take({3, 3, 0}, true).reason.empty());
}

TEST(FrameSchedule, DrawsWhatIsAskedForBesides) {
  FrameSchedule schedule(scene_of(3));
  EXPECT_TRUE(schedule.take({0, 0, 0}, false).scheduled);
  schedule.ask();
  const FrameSchedule::Due asked = schedule.take({1, 1, 0}, false);
  EXPECT_EQ(asked.reason, "asked for");
  EXPECT_TRUE(asked.always && !asked.scheduled);
  EXPECT_TRUE(schedule.take({2, 2, 0}, false).reason.empty());
  schedule.change(2, 1.5);
  EXPECT_EQ(schedule.next(), 3.5);
  EXPECT_TRUE(schedule.take({3, 3, 0}, false).reason.empty());
  EXPECT_FALSE(schedule.take({4, 3.5, 0}, false).reason.empty());
  EXPECT_EQ(schedule.next(), 5);
}

TEST(RowTimes, ARowThatOnlyAStopHasAddedIsDropped) {
  RowTimes whole(1, {2.5}, {});
  std::vector<double> due;
  for (const double time : {0.0, 0.75, 1.5, 2.25, 2.5, 3.25})
    if (whole.pass(time)) due.push_back(time);
  EXPECT_EQ(due, (std::vector{0.0, 1.5, 2.25, 2.5, 3.25}));
  EXPECT_FALSE(whole.kept_until());
  for (const double time : {1.5, 2.25}) {
    RowTimes resumed(1, {2.5}, Clock{time, 0.75, 3, time - 0.75});
    EXPECT_EQ(resumed.kept_until(), time);
    EXPECT_FALSE(resumed.pass(time));
  }
  RowTimes asked(1, {2.5}, Clock{2.5, 0.25, 4, 2.25});
  EXPECT_EQ(asked.kept_until(), 2.5);
  EXPECT_EQ(asked.next_time(), std::numeric_limits<double>::infinity());
  RowTimes between(1, {2.5}, Clock{0.75, 0.75, 1, 0});
  EXPECT_LT(*between.kept_until(), 0.75);
  EXPECT_TRUE(between.pass(1.5));
}

TEST(RowTimes, ARowIsWrittenOnceThoughTheRunIsRestarted) {
  const Clock end{3, 0.75, 4, 2.25};
  for (const double interval : {1.0, 0.7}) {  // due at the end, and not
    RowTimes whole(interval, {}, {});
    EXPECT_TRUE(whole.take(Clock{}, false));
    EXPECT_TRUE(whole.take(end, true));
    EXPECT_FALSE(whole.take(end, true));
    RowTimes resumed(interval, {}, end);
    EXPECT_EQ(resumed.take(end, true), resumed.kept_until() != end.time) << interval;
  }
  RowTimes resumed(1, {}, Clock{2.25, 0.75, 3, 1.5});
  EXPECT_FALSE(resumed.take(Clock{2.25, 0.75, 3, 1.5}, false));
  EXPECT_TRUE(resumed.take(end, true));
}

TEST(RowTimes, ARestartAgreesWithTheRunThatWentOnWhereverStepsEnd) {
  // Steps that end at, or next to, the times of rows: sums of 3e-6 are not multiples of it.
  const double interval = 3e-6;
  RowTimes whole(interval, {}, {});
  Clock clock;
  whole.pass(0);
  for (; clock.step < 4000; ++clock.step) {
    const double k = static_cast<double>(clock.step / 2) + 0.3 * static_cast<double>(clock.step % 2);
    const double dt = k * interval - clock.time;
    if (!(dt > 0)) continue;
    clock.before = clock.time;
    clock.dt = dt;
    clock.time += dt;
    const bool due = whole.pass(clock.time);
    const RowTimes resumed(interval, {}, clock);
    EXPECT_EQ(resumed.kept_until() == clock.time, due) << clock.step;
    EXPECT_EQ(resumed.next_row(), whole.next_row()) << clock.step;
  }
}

TEST(FrameGovernor, HoldsTheShareButForTheFirstFrame) {
  FrameGovernor governor(0.2);
  double insitu = 0;
  int drawn = 0;
  for (int step = 0; step < 1000; ++step) {  // of a second each; a frame takes half a second, the first one a hundred
    if (!governor.affords(insitu, step)) continue;
    const double before = insitu;
    insitu += drawn++ == 0 ? 100 : 0.5;
    governor.drawn(before, insitu, step);
  }
  const double after_first = insitu - 100;
  EXPECT_LE(after_first / (after_first + 1000), 0.2);
  EXPECT_GT(after_first / (after_first + 1000), 0.19);
}

TEST(FrameGovernor, LendsHalfOfWhatTheWholeRunWillEarn) {
  FrameGovernor governor(0.2);  // of a run of 1000 seconds, in which 250 may go to frames
  double insitu = 0;
  governor.drawn(0, insitu += 3, 0);
  int drawn = 0;
  for (; governor.lends(insitu, 1000); ++drawn) {
    EXPECT_FALSE(insitu > FrameGovernor::granted && governor.affords(insitu, 1));
    governor.drawn(insitu, insitu + 5, 1);
    insitu += 5;
  }
  EXPECT_EQ(drawn, 25);
}

TEST(FrameGovernor, LeavesNothingOutOfShortRuns) {
  FrameGovernor governor(0.1);  // steps take a second in all, and each frame another
  governor.drawn(0, 5, 0);
  double insitu = 5;
  for (int frame = 1; governor.affords(insitu, 1); ++frame) {
    ASSERT_LE(frame, FrameGovernor::granted);
    governor.drawn(insitu, insitu + 1, 1);
    insitu += 1;
  }
  EXPECT_EQ(insitu, 5 + FrameGovernor::granted);
}

TEST(FrameGovernor, LeavesNothingOutWithTheWholeShare) {
  FrameGovernor governor(1);
  governor.drawn(0, 5, 0);
  governor.drawn(5, 500, 1);
  EXPECT_TRUE(governor.affords(500, 1));
}

}  // namespace
}  // namespace ejecta
