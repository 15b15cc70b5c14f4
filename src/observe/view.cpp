#include "observe/view.hpp"

#include <algorithm>
#include <cmath>

#include "render/image.hpp"

namespace ejecta {

namespace {

double speed(const Body& body) { return std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]); }

}  // namespace

View choose_view(const Scene& scene) {
  const Body& calmest = *std::min_element(scene.bodies.begin(), scene.bodies.end(),
                                          [](const Body& a, const Body& b) { return speed(a) < speed(b); });
  View view{scene.insitu.view_center, scene.insitu.view_size};
  for (std::size_t a = 0; a < 3; ++a)
    if (!is_set(view.center[a])) view.center[a] = calmest.center[a];
  if (!is_set(view.size)) view.size = 1.6 * std::ranges::max(widths(calmest, scene.dimension));
  return view;
}

PixelGrid panel_grid(const View& view, const Scene& scene, int panels) {
  const auto [width, height] = panel_pixels(scene.insitu.image_width, scene.insitu.image_height, panels);
  // The picture must hold the view in its smaller direction too.
  const double visible = view.size * std::max(1.0, static_cast<double>(width) / height);
  return centred_grid(width, height, {view.center[0], view.center[scene.dimension == 3 ? 2 : 1]}, visible);
}

std::string heading(const Scene& scene) { return scene.title.empty() ? scene.name : scene.title; }

}  // namespace ejecta
