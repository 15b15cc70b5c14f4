#pragma once
/// What the images of a run show.
#include <string>

#include "render/sampling.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Centre and width [m] of what the images show.
struct View {
  Triple center;
  double size;
};
/// What the scene says, or a frame about the body that moves least.
View choose_view(const Scene& scene);

/// Pixels of one panel out of `panels` in a picture of the scene's size.
PixelGrid panel_grid(const View& view, const Scene& scene, int panels);

/// Stands over every image.
std::string heading(const Scene& scene);

}  // namespace ejecta
