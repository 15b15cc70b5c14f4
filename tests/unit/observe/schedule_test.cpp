#include "observe/schedule.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ejecta {
namespace {

/// Steps drawn of a run of ten steps of one second.
std::vector<int> drawn_steps(FrameSchedule& schedule, int first = 0) {
  std::vector<int> drawn;
  for (int step = first; step <= 10; ++step)
    if (schedule.take(step, step, step == 10)) drawn.push_back(step);
  return drawn;
}

TEST(FrameSchedule, DrawsFirstLastAndEquallySpacedBetween) {
  FrameSchedule schedule(10, 3);
  EXPECT_EQ(schedule.next(), 0);
  EXPECT_EQ(drawn_steps(schedule), (std::vector{0, 5, 10}));
}

TEST(FrameSchedule, NoStepIsDrawnTwice) {
  FrameSchedule schedule(10, 11);
  EXPECT_TRUE(schedule.take(3, 3, false));
  EXPECT_FALSE(schedule.take(3, 3, true));
}

TEST(FrameSchedule, AStepThatEndsAtTheTimeOfAFrameButForRoundingDrawsIt) {
  FrameSchedule schedule(1, 11);
  EXPECT_TRUE(schedule.take(0, 0, false));
  EXPECT_TRUE(schedule.take(1, 0.1 * (1 - 1e-15), false));
  EXPECT_NEAR(schedule.next(), 0.2, 1e-15);
}

TEST(FrameSchedule, ThinnedOutItStillEndsStepsAtEveryFrameAndDrawsTheLast) {
  FrameSchedule schedule(10, 11);
  schedule.thin_out();
  schedule.thin_out();
  EXPECT_FALSE(schedule.take(0, 0, false));
  EXPECT_EQ(schedule.next(), 1);
  EXPECT_EQ(drawn_steps(schedule, 1), (std::vector{3, 7, 10}));
}

TEST(FrameSchedule, GoesOnAfterARestartWithTheNextFrame) {
  FrameSchedule schedule(10, 6);
  schedule.resume(4);
  EXPECT_EQ(schedule.next(), 6);
}

TEST(FrameSchedule, DrawsWhatIsAskedForBesides) {
  FrameSchedule schedule(10, 3);
  EXPECT_TRUE(schedule.take(0, 0, false));
  schedule.ask();
  EXPECT_TRUE(schedule.take(1, 1, false));
  EXPECT_FALSE(schedule.take(2, 2, false));
  schedule.change(2, 1.5);
  EXPECT_EQ(schedule.next(), 3.5);
  EXPECT_FALSE(schedule.take(3, 3, false));
  EXPECT_TRUE(schedule.take(4, 3.5, false));
  EXPECT_EQ(schedule.next(), 5);
}

TEST(FrameSchedule, KnowsTheTimesOfItsFrames) {
  const FrameSchedule schedule(1, 11, {0.25});
  for (const double time : {0.0, 0.1, 0.3, 0.7 * (1 + 1e-14), 1.0, 0.25}) EXPECT_TRUE(schedule.falls_on(time)) << time;
  for (const double time : {0.05, 0.1001, 0.26}) EXPECT_FALSE(schedule.falls_on(time)) << time;
}

TEST(RowTimes, ARowThatOnlyAStopHasAddedIsDropped) {
  RowTimes whole(1, {2.5}, {});
  std::vector<double> due;
  for (const double time : {0.0, 0.75, 1.5, 2.25, 2.5, 3.25})
    if (whole.pass(time)) due.push_back(time);
  EXPECT_EQ(due, (std::vector{0.0, 1.5, 2.25, 2.5, 3.25}));
  EXPECT_FALSE(whole.kept_until());
  for (const double time : {1.5, 2.25}) {
    RowTimes resumed(1, {2.5}, Clock{time, 0.75, 3});
    EXPECT_EQ(resumed.kept_until(), time);
    EXPECT_FALSE(resumed.pass(time));
  }
  RowTimes asked(1, {2.5}, Clock{2.5, 0.25, 4});
  EXPECT_EQ(asked.kept_until(), 2.5);
  EXPECT_EQ(asked.next_time(), std::numeric_limits<double>::infinity());
  RowTimes between(1, {2.5}, Clock{0.75, 0.75, 1});
  EXPECT_LT(*between.kept_until(), 0.75);
  EXPECT_TRUE(between.pass(1.5));
}

TEST(FrameGovernor, PassesOverTheFirstFrameAndJudgesFromTheSixthOn) {
  FrameGovernor governor(0.15);
  EXPECT_FALSE(governor.excess(100, 0));  // what it takes to start the renderer
  for (int frame = 1; frame < 5; ++frame) EXPECT_FALSE(governor.excess(100 + frame, frame)) << frame;
  const std::optional<double> share = governor.excess(105, 5);
  ASSERT_TRUE(share);
  EXPECT_DOUBLE_EQ(*share, 0.5);
}

TEST(FrameGovernor, BeginsAnewOnceItHasSpoken) {
  FrameGovernor governor(0.15);
  for (int frame = 0; frame < 5; ++frame) governor.excess(frame, frame);
  ASSERT_TRUE(governor.excess(5, 5));
  for (int frame = 6; frame < 11; ++frame) EXPECT_FALSE(governor.excess(frame, frame)) << frame;
  EXPECT_TRUE(governor.excess(11, 11));
}

TEST(FrameGovernor, IsSilentWithinTheShareAllowed) {
  FrameGovernor governor(0.15);
  for (int frame = 0; frame < 20; ++frame) EXPECT_FALSE(governor.excess(frame, 9 * frame)) << frame;
}

}  // namespace
}  // namespace ejecta
