#include "observe/view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>

namespace ejecta {

namespace {

double speed(const Body& body) { return std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]); }

/// Half of what a body takes up along an axis; of a round one half of its longest width.
double half_width(const Body& body, int dimension, std::size_t axis) {
  const std::vector<double> all = widths(body, dimension);
  return 0.5 * (info(body.shape).size && axis < all.size() ? all[axis] : std::ranges::max(all));
}

}  // namespace

View choose_view(const Scene& scene) {
  const double least_speed = std::ranges::min(scene.bodies | std::views::transform(speed));
  const Body& first = *std::ranges::find(scene.bodies, least_speed, speed);
  View view{scene.insitu.view_center, scene.insitu.view_size, scene.insitu.view_height};
  double longest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    double low = 0, high = 0;  // from the centre of the first
    for (const Body& body : scene.bodies) {
      if (speed(body) > least_speed) continue;
      const double half = a < static_cast<std::size_t>(scene.dimension) ? half_width(body, scene.dimension, a) : 0;
      low = std::min(low, body.center[a] - first.center[a] - half);
      high = std::max(high, body.center[a] - first.center[a] + half);
    }
    if (!is_set(view.center[a])) view.center[a] = first.center[a] + std::midpoint(low, high);
    longest = std::max(longest, high - low);
  }
  const double room = scene.detonators.empty() ? 1.6 : 3;  // an explosive throws what is around it
  if (!is_set(view.width)) view.width = room * longest;
  if (!is_set(view.height)) view.height = view.width;
  return view;
}

Window View::window(int dimension) const {
  const double x = center[0], y = center[dimension == 3 ? 2 : 1];
  return {{x - 0.5 * width, y - 0.5 * height}, {x + 0.5 * width, y + 0.5 * height}};
}

std::string heading(const Scene& scene) { return scene.title.empty() ? scene.name : scene.title; }

}  // namespace ejecta
