#pragma once
/// When frames are drawn, and how much of the wall time they may take.
#include <cstdint>
#include <optional>

namespace ejecta {

/// Times of frames: equally spaced, first and last included. Steps end at all of them, drawn or passed over, so that
/// the result of a run does not depend on the speed of the machine.
class FrameSchedule {
 public:
  /// `frames` of at least 2 in [0, time_end] [s].
  FrameSchedule(double time_end, int frames) : interval_(time_end / (frames - 1)) {}

  /// Time of the next frame, drawn or passed over [s].
  double next() const { return next_; }
  /// Is a frame to be drawn now, at the end of this step? `last`: of the run, which is always drawn. No step is drawn
  /// twice.
  bool take(std::int64_t step, double time, bool last);
  /// From now on half as many frames are drawn.
  void thin_out() { stride_ *= 2; }
  /// The next frame is the first one later than `time` [s].
  void resume(double time);

 private:
  double interval_, next_ = 0;        // s
  int stride_ = 1, passed_over_ = 0;  ///< every stride-th frame is drawn
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
