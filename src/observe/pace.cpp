#include "observe/pace.hpp"

#include <algorithm>

namespace ejecta {

namespace {
constexpr double least_window = 30, share_of_all = 0.1;
}

void Pace::add(double wall, const Clock& clock) {
  if (marks_.empty()) first_wall_ = wall;
  marks_.push_back({wall, clock.time, clock.step});
  const double window = std::max(least_window, share_of_all * (wall - first_wall_));
  while (marks_.size() > 2 && marks_[1].wall <= wall - window) marks_.pop_front();
}

std::optional<double> Pace::left(double time_end, const std::optional<std::int64_t>& max_steps) const {
  if (marks_.size() < 2) return {};
  const Mark &then = marks_.front(), &now = marks_.back();
  const double wall = now.wall - then.wall, time = now.time - then.time;
  if (!(wall > 0 && time > 0)) return {};
  double left = (time_end - now.time) * wall / time;
  if (max_steps)
    left =
        std::min(left, static_cast<double>(*max_steps - now.step) * wall / static_cast<double>(now.step - then.step));
  return std::max(left, 0.0);
}

}  // namespace ejecta
