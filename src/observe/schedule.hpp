#pragma once
/// When frames are drawn, and how much of the wall time they may take.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/clock.hpp"
#include "scene/every.hpp"
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
  /// When the next row of the interval is due [s].
  double next_row() const { return next_; }
  /// Whether a row is due at the end of a step [s].
  bool pass(double time);
  /// Whether to write a row at the end of a step: it is due, or the last one, and not there yet.
  bool take(const Clock& clock, bool last);
  /// Rows later than this belong to no schedule and are dropped after a restart [s]: they were written after the
  /// checkpoint, or because the run was cut short there. Nothing if there was no restart.
  const std::optional<double>& kept_until() const { return kept_until_; }

 private:
  double interval_, next_ = 0;  // s
  OutputTimes times_;
  std::optional<double> kept_until_;
  std::int64_t written_ = -1;  ///< step of the last row
};

/// Where a run is, for whoever waits for something.
struct Moment {
  std::int64_t step = 0;
  double time = 0, wall = 0;  ///< s
};

/// Says when something is due, and why: at given times, or every so much time, so many steps or so much wall time from
/// the start on.
class Trigger {
 public:
  Trigger(std::vector<double> times, std::string reason);
  /// From the time `start` [s] on.
  Trigger(const Every& every, std::string reason, double start = 0);

  /// Time at which steps are to end because of it [s]; infinity if there is none. It does not depend on the speed of
  /// the machine, nor does the result of a run.
  double next() const;
  /// Whether it has become due since the last call.
  bool take(const Moment& now);
  /// What has been due until now is past.
  void resume(const Moment& now) { take(now); }
  const std::string& reason() const { return reason_; }

 private:
  std::vector<double> times_;
  Every every_;
  std::string reason_;
  double start_ = 0;         // s
  std::int64_t passed_ = 0;  ///< number of times that are past
  double next_wall_ = 0;     // s
  double time_of(std::int64_t k) const;
};

/// Why a frame is drawn that only the end of the run, or of this part of it, has brought.
inline constexpr const char* end_of_run = "end";

/// The frames of a scene: insitu.frames or insitu.times, insitu.every, output.times, and the last step of the run.
class FrameSchedule {
 public:
  explicit FrameSchedule(const Scene& scene);

  double next() const;
  struct Due {
    std::string reason;      ///< empty: there is no frame
    bool always = false;     ///< whatever it costs
    bool on_credit = false;  ///< before it has been earned, if it will be
    bool scheduled = false;  ///< also where nobody stops the run or asks for a frame
  };
  /// `last`: of the run. No step is drawn twice.
  Due take(const Moment& now, bool last);
  /// The next frame is the first one later than now.
  void resume(const Moment& now);
  /// The end of this step is drawn, whatever its time.
  void ask() { asked_ = true; }
  /// In place of insitu.frames or insitu.times a frame every `interval` from now on, the first so long after `time`
  /// [s].
  void change(double time, double interval);
  /// More frames, which are drawn at the first step after each of these times [s]: steps do not end there.
  void add(std::vector<double> times, std::string reason);
  /// Mean time between two frames [s].
  double interval() const { return interval_; }

 private:
  std::vector<Trigger> frames_;  ///< one: insitu.frames or insitu.times
  std::vector<Trigger> always_, others_, loose_;
  bool listed_, asked_ = false;
  double interval_;
  std::int64_t last_drawn_ = -1;  ///< step
};

/// Keeps in-situ work to its share of the wall time: a frame has to be earned before it is drawn.
class FrameGovernor {
 public:
  /// In-situ work that every run may do, whatever its share [s]: short runs are there for their pictures.
  static constexpr double granted = 20;
  explicit FrameGovernor(double max_share) : max_share_(max_share) {}

  /// With the wall times so far [s]: whether a frame that costs as much as the one before keeps within the share.
  bool affords(double insitu_seconds, double step_seconds) const;
  /// Whether it does so with what all the run's steps will take [s], leaving half of the share to frames to come.
  bool lends(double insitu_seconds, double all_step_seconds) const;
  /// To be told of every frame. The first one pays for starting the renderer, and is not counted.
  void drawn(double insitu_before, double insitu_after, double step_seconds);

 private:
  double max_share_;
  bool begun_ = false;
  double insitu_before_ = 0, steps_before_ = 0;  ///< wall time of either after the first frame [s]
  double cost_ = 0;                              ///< of the frame before [s]
};

}  // namespace ejecta
