#pragma once
/// How long a run still takes, from how fast it has been lately.
#include <deque>
#include <optional>

#include "model/clock.hpp"

namespace ejecta {

class Pace {
 public:
  /// Where the run is after `wall` seconds of work, before restarts too.
  void add(double wall, const Clock& clock);
  /// Wall time [s] until `time_end` [s] or `max_steps`, whichever comes first, at the rates of the last tenth of the
  /// wall time since the first mark, but of half a minute at least. Nothing before there is a rate.
  std::optional<double> left(double time_end, const std::optional<std::int64_t>& max_steps) const;

 private:
  struct Mark {
    double wall, time;
    std::int64_t step;
  };
  std::deque<Mark> marks_;
  double first_wall_ = 0;
};

}  // namespace ejecta
