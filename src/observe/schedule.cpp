#include "observe/schedule.hpp"

namespace ejecta {

RowTimes::RowTimes(double interval, const std::vector<double>& times, const std::optional<Clock>& resume_at)
    : interval_(interval), times_(times) {
  if (!resume_at) return;
  const auto [time, dt, step] = *resume_at;
  pass(time - dt * (1 - 1e-9));
  const bool due = pass(time) || step == 0;
  kept_until_ = due ? time : std::nextafter(time, 0);
}

bool RowTimes::pass(double time) {
  const bool asked = times_.pass(time), due = time >= next_;
  while (next_ <= time) next_ += interval_;
  return asked || due;
}

double row_interval(const Scene& scene) {
  return is_set(scene.output.history_interval) ? scene.output.history_interval : scene.time_end / 200;
}

bool FrameSchedule::take(std::int64_t step, double time, bool last) {
  const bool always = times_.pass(time) || last || asked_, due = time >= next_ - 1e-9 * interval_;
  if ((!due && !always) || step == last_drawn_) return false;
  asked_ = false;
  while (next_ <= time * (1 + 1e-12)) next_ += interval_;
  if (!always && ++passed_over_ < stride_) return false;
  passed_over_ = 0;
  last_drawn_ = step;
  return true;
}

void FrameSchedule::change(double time, double interval) {
  interval_ = interval;
  next_ = time + interval;
  stride_ = 1;
}

bool FrameSchedule::falls_on(double time) const {
  return times_.hold(time) || std::abs(std::remainder(time, interval_)) <= 1e-9 * interval_;
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
