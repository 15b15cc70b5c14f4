#pragma once
/// What the images of a run show.
#include <string>

#include "render/sheet.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Centre, width and height [m] of what the images show at least.
struct View {
  Triple center;
  double width, height;

  /// In the picture plane, which is x-z in space.
  Window window(int dimension) const;
};
/// What the scene says, or a frame about the bodies that move least, wider where something is to explode.
View choose_view(const Scene& scene);

/// Stands over every image.
std::string heading(const Scene& scene);

}  // namespace ejecta
