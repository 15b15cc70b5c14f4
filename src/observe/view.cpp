#include "observe/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ranges>
#include <utility>

namespace ejecta {

namespace {

double speed(const Body& body) { return std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]); }

/// Half of what a body takes up along an axis; of a round one half of its longest width.
double half_width(const Body& body, int dimension, std::size_t axis) {
  const std::vector<double> all = widths(body, dimension);
  return 0.5 * (info(body.shape).size && axis < all.size() ? all[axis] : std::ranges::max(all));
}

using Interval = std::pair<double, double>;

/// From where to where a body reaches along an axis, from a place [m], within the faces of a boundary: what is cut off
/// at a wall or a plane of symmetry takes no room, and what has come in at the other side of a periodic box all of it.
Interval extent(const Body& body, int dimension, const Boundary& box, std::size_t axis, double from) {
  const double middle = body.center[axis] - from;
  if (axis >= static_cast<std::size_t>(dimension)) return {middle, middle};
  const double half = half_width(body, dimension, axis);
  double low = middle - half, high = middle + half;
  const double box_low = box.min[axis] - from, box_high = box.max[axis] - from;
  if (box.periodic(axis) && (low < box_low || high > box_high)) return {box_low, box_high};
  if (box.lower[axis] != BoundaryKind::open) low = std::clamp(box_low, low, high);
  if (box.upper[axis] != BoundaryKind::open) high = std::clamp(box_high, low, high);
  return {low, high};
}

/// Of a view about a centre that holds every body as it begins [m].
double width_of_all(const Scene& scene, const Triple& center) {
  double half = 0;
  for (const Body& body : scene.bodies)
    for (const std::size_t a : {std::size_t{0}, scene.dimension == 3 ? std::size_t{2} : std::size_t{1}}) {
      const auto [low, high] = extent(body, scene.dimension, scene.boundary, a, center[a]);
      half = std::max({half, -low, high});
    }
  return 2 * half;
}

/// A view grows by so much for bodies that would begin beyond its edge, cut off by it, and leaves so much beside them.
constexpr double farthest = 1.5, margin = 1.05;

}  // namespace

View choose_view(const Scene& scene) {
  const double least_speed = std::ranges::min(scene.bodies | std::views::transform(speed));
  const Body& first = *std::ranges::find(scene.bodies, least_speed, speed);
  View view{scene.insitu.view_center, scene.insitu.view_size, scene.insitu.view_height};
  // Of those that move least, from the centre of the first.
  const auto reach = [&](std::size_t a, const Boundary& box) {
    Interval all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Body& body : scene.bodies) {
      if (speed(body) > least_speed) continue;
      const auto [low, high] = extent(body, scene.dimension, box, a, first.center[a]);
      all = {std::min(all.first, low), std::max(all.second, high)};
    }
    return all;
  };
  double longest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] = reach(a, scene.boundary);
    longest = std::max(longest, high - low);
    if (is_set(view.center[a])) continue;
    // Slices are laid through the middle of whole bodies: in one that is cut in half, the plane of symmetry.
    const bool across = scene.dimension == 3 && a == 1;
    const auto [from, to] = across ? reach(a, Boundary{}) : Interval{low, high};
    view.center[a] = first.center[a] + std::midpoint(from, to);
  }
  const double room = scene.detonators.empty() ? 1.6 : 3;  // an explosive throws what is around it
  if (!is_set(view.width)) {
    view.width = room * longest;
    const double all = margin * width_of_all(scene, view.center);
    if (all <= farthest * view.width) view.width = std::max(view.width, all);
  }
  if (!is_set(view.height)) view.height = view.width;
  return view;
}

Window View::window(int dimension) const {
  const double x = center[0], y = center[dimension == 3 ? 2 : 1];
  return {{x - 0.5 * width, y - 0.5 * height}, {x + 0.5 * width, y + 0.5 * height}};
}

std::string heading(const Scene& scene) { return scene.title.empty() ? scene.name : scene.title; }

}  // namespace ejecta
