#pragma once
/// When frames are drawn, and how much of the wall time they may take.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "model/clock.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// The times of output.times [s], one after the other.
class OutputTimes {
 public:
  explicit OutputTimes(std::vector<double> times) : times_(std::move(times)) { std::ranges::sort(times_); }
  /// Whether this is one of them, but for rounding [s].
  bool hold(double time) const {
    return std::ranges::any_of(times_, [&](double t) { return std::abs(t - time) <= 1e-12 * time; });
  }
  /// Infinity after the last one.
  double next() const { return passed_ < times_.size() ? times_[passed_] : std::numeric_limits<double>::infinity(); }
  /// Whether some have been reached since the last call.
  bool pass(double time) {
    const std::size_t before = passed_;
    while (next() <= time * (1 + 1e-12)) ++passed_;
    return passed_ > before;
  }

 private:
  std::vector<double> times_;
  std::size_t passed_ = 0;
};

/// Times of the rows of a table: the first step of each interval, and output.times.
class RowTimes {
 public:
  /// `interval` [s]; `resume_at`: where a restart goes on.
  RowTimes(double interval, const std::vector<double>& times, const std::optional<Clock>& resume_at);
  double next_time() const { return times_.next(); }
  /// Whether a row is due at the end of a step [s].
  bool pass(double time);
  /// Rows later than this belong to no schedule and are dropped after a restart [s]: they were written after the
  /// checkpoint, or because the run was cut short there. Nothing if there was no restart.
  const std::optional<double>& kept_until() const { return kept_until_; }

 private:
  double interval_, next_ = 0;  // s
  OutputTimes times_;
  std::optional<double> kept_until_;
};

/// output.history_interval or its default [s].
double row_interval(const Scene& scene);

/// Times of frames: equally spaced, first and last included. Steps end at all of them, drawn or passed over, so that
/// the result of a run does not depend on the speed of the machine.
class FrameSchedule {
 public:
  /// `frames` of at least 2 in [0, time_end] [s], and one at each of the times [s] that are given, which is always drawn.
  FrameSchedule(double time_end, int frames, const std::vector<double>& times = {})
      : interval_(time_end / (frames - 1)), times_(times) {}

  /// Time of the next frame, drawn or passed over [s].
  double next() const { return std::min(next_, times_.next()); }
  /// Is a frame to be drawn now, at the end of this step? `last`: of the run, which is always drawn. No step is drawn
  /// twice.
  bool take(std::int64_t step, double time, bool last);
  /// The end of this step is drawn, whatever its time.
  void ask() { asked_ = true; }
  /// From now on a frame every `interval`, and the first so long after `time` [s].
  void change(double time, double interval);
  /// From now on half as many frames are drawn.
  void thin_out() { stride_ *= 2; }
  /// Whether a frame belongs at this time [s], not counting the last of the run.
  bool falls_on(double time) const;
  /// The next frame is the first one later than `time` [s].
  void resume(double time);

 private:
  double interval_, next_ = 0;        // s
  OutputTimes times_;
  int stride_ = 1, passed_over_ = 0;  ///< every stride-th frame is drawn
  bool asked_ = false;
  std::int64_t last_drawn_ = -1;      ///< step
};

/// Watches over the share of in-situ work in the wall time.
class FrameGovernor {
 public:
  explicit FrameGovernor(double max_share) : max_share_(max_share) {}

  /// To be called after every frame with the wall times so far [s]. Returns the share of in-situ work if it is more
  /// than allowed, and begins anew. The first frame pays for starting the renderer: what comes after it is judged, once
  /// there are a few frames.
  std::optional<double> excess(double insitu_seconds, double step_seconds);

 private:
  double max_share_;
  int frames_ = 0;
  double insitu_before_ = 0, steps_before_ = 0;  ///< wall time of either at the first frame [s]
};

}  // namespace ejecta
