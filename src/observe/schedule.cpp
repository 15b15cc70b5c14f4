#include "observe/schedule.hpp"

#include <cmath>

namespace ejecta {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A step that was to end at a time may miss it by so much of it.
constexpr double rounding = 1e-11;

std::vector<double> frame_times(const Scene& scene) {
  const InSitu& insitu = scene.insitu;
  if (!insitu.times.list.empty()) {
    std::vector<double> times = insitu.times.list;
    times.push_back(0);
    std::ranges::sort(times);
    return times;
  }
  std::vector<double> times;
  for (int k = 0; k < insitu.frames; ++k) {
    const double share = static_cast<double>(k) / (insitu.frames - 1);
    times.push_back(scene.time_end * (insitu.times.dense_early ? share * share : share));
  }
  return times;
}

}  // namespace

RowTimes::RowTimes(double interval, const std::vector<double>& times, const std::optional<Clock>& resume_at)
    : interval_(interval), times_(times) {
  if (!resume_at) return;
  pass(resume_at->before);
  const bool due = pass(resume_at->time) || resume_at->step == 0;
  kept_until_ = due ? resume_at->time : std::nextafter(resume_at->time, 0);
  if (due) written_ = resume_at->step;
}

bool RowTimes::pass(double time) {
  const bool asked = times_.pass(time), due = time >= next_;
  while (next_ <= time) next_ += interval_;
  return asked || due;
}

bool RowTimes::take(const Clock& clock, bool last) {
  const bool due = pass(clock.time);
  if ((!due && !last) || clock.step == written_) return false;
  written_ = clock.step;
  return true;
}

Trigger::Trigger(std::vector<double> times, std::string reason) : times_(std::move(times)), reason_(std::move(reason)) {
  std::ranges::sort(times_);
}

Trigger::Trigger(const Every& every, std::string reason, double start)
    : every_(every), reason_(std::move(reason)), start_(start) {}

double Trigger::time_of(std::int64_t k) const {
  if (is_set(every_.time)) return start_ + static_cast<double>(k) * every_.time;
  return k < static_cast<std::int64_t>(times_.size()) ? times_[static_cast<std::size_t>(k)] : infinity;
}

double Trigger::next() const { return time_of(passed_); }

bool Trigger::take(const Moment& now) {
  if (every_.steps > 0) return now.step % every_.steps == 0;
  if (is_set(every_.wall)) {
    if (now.wall < next_wall_) return false;
    next_wall_ = now.wall + every_.wall;
    return true;
  }
  const std::int64_t before = passed_;
  const double reached = now.time * (1 + rounding);
  if (is_set(every_.time) && reached >= start_)
    passed_ = std::max(passed_, static_cast<std::int64_t>((reached - start_) / every_.time) + 1);
  while (time_of(passed_) <= reached) ++passed_;
  return passed_ > before;
}

FrameSchedule::FrameSchedule(const Scene& scene)
    : listed_(!scene.insitu.times.list.empty()), interval_(scene.time_end / (scene.insitu.frames - 1)) {
  frames_.emplace_back(frame_times(scene), listed_ ? "insitu.times" : "frame");
  if (!scene.output.times.empty()) always_.emplace_back(scene.output.times, "output.times");
  for (const std::string& text : scene.insitu.every) others_.emplace_back(parse_every(text), "every " + text);
}

double FrameSchedule::next() const {
  double least = infinity;
  for (const auto* triggers : {&frames_, &always_, &others_})
    for (const Trigger& trigger : *triggers) least = std::min(least, trigger.next());
  return least;
}

FrameSchedule::Due FrameSchedule::take(const Moment& now, bool last) {
  Due due;
  if (now.step == last_drawn_) return due;
  const auto look = [&](std::vector<Trigger>& triggers, bool always, bool on_credit = false) {
    for (Trigger& trigger : triggers) {
      if (!trigger.take(now)) continue;
      due.always |= always;
      due.on_credit |= on_credit;
      due.scheduled = true;
      if (due.reason.empty()) due.reason = trigger.reason();
    }
  };
  look(always_, true);
  look(loose_, false, true);
  look(others_, false);  // a movie of these must have no gap where a frame of the first kind falls on one
  look(frames_, listed_);
  due.always |= last || asked_;
  if (due.reason.empty() && asked_) due.reason = "asked for";
  if (due.reason.empty() && last) due.reason = end_of_run;
  asked_ = false;
  if (!due.reason.empty()) last_drawn_ = now.step;
  return due;
}

void FrameSchedule::resume(const Moment& now) {
  take(now, false);
  last_drawn_ = -1;
}

void FrameSchedule::change(double time, double interval) {
  interval_ = interval;
  listed_ = false;
  frames_ = {Trigger(Every{.time = interval}, "frame", time + interval)};
}

void FrameSchedule::add(std::vector<double> times, std::string reason) {
  loose_.emplace_back(std::move(times), std::move(reason));
}

bool FrameGovernor::affords(double insitu_seconds, double step_seconds) const {
  if (!begun_ || max_share_ >= 1) return true;
  const double insitu = insitu_seconds - insitu_before_ + cost_, steps = step_seconds - steps_before_;
  return insitu <= std::max(granted, max_share_ * (insitu + steps));
}

bool FrameGovernor::lends(double insitu_seconds, double all_step_seconds) const {
  if (!begun_ || max_share_ >= 1) return true;
  const double budget = max_share_ / (1 - max_share_) * (all_step_seconds - steps_before_);
  return insitu_seconds - insitu_before_ + cost_ <= 0.5 * std::max(granted, budget);
}

void FrameGovernor::drawn(double insitu_before, double insitu_after, double step_seconds) {
  if (begun_) {
    cost_ = insitu_after - insitu_before;
    return;
  }
  begun_ = true;
  insitu_before_ = insitu_after;
  steps_before_ = step_seconds;
}

}  // namespace ejecta
