#include "observe/schedule.hpp"

namespace ejecta {

bool FrameSchedule::take(std::int64_t step, double time, bool last) {
  const bool always = times_.pass(time) || last, due = time >= next_ - 1e-9 * interval_;
  if ((!due && !always) || step == last_drawn_) return false;
  while (next_ <= time * (1 + 1e-12)) next_ += interval_;
  if (!always && ++passed_over_ < stride_) return false;
  passed_over_ = 0;
  last_drawn_ = step;
  return true;
}

void FrameSchedule::resume(double time) {
  while (next_ <= time) next_ += interval_;
  times_.pass(time);
}

std::optional<double> FrameGovernor::excess(double insitu_seconds, double step_seconds) {
  constexpr int frames_before_judging = 5;
  if (frames_++ == 0) {
    insitu_before_ = insitu_seconds;
    steps_before_ = step_seconds;
    return {};
  }
  const double insitu = insitu_seconds - insitu_before_, steps = step_seconds - steps_before_;
  const double share = insitu / (insitu + steps);
  if (frames_ <= frames_before_judging || share <= max_share_) return {};
  frames_ = 0;
  return share;
}

}  // namespace ejecta
