#include "observe/view.hpp"

#include <algorithm>
#include <cmath>

namespace ejecta {

namespace {

double speed(const Body& body) { return std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]); }

}  // namespace

View choose_view(const Scene& scene) {
  const Body& calmest = *std::min_element(scene.bodies.begin(), scene.bodies.end(),
                                          [](const Body& a, const Body& b) { return speed(a) < speed(b); });
  View view{scene.insitu.view_center, scene.insitu.view_size, scene.insitu.view_height};
  for (std::size_t a = 0; a < 3; ++a)
    if (!is_set(view.center[a])) view.center[a] = calmest.center[a];
  if (!is_set(view.width)) view.width = 1.6 * std::ranges::max(widths(calmest, scene.dimension));
  if (!is_set(view.height)) view.height = view.width;
  return view;
}

Window View::window(int dimension) const {
  const double x = center[0], y = center[dimension == 3 ? 2 : 1];
  return {{x - 0.5 * width, y - 0.5 * height}, {x + 0.5 * width, y + 0.5 * height}};
}

std::string heading(const Scene& scene) { return scene.title.empty() ? scene.name : scene.title; }

}  // namespace ejecta
