#pragma once
/// Which bodies are one continuum.
#include <vector>

#include "material/material.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// The piece of each body. Ideal gases are one, number 0, and so are all other fluids: they share their pressure
/// wherever they meet. A solid body is a piece of its own and touches others, unless it is welded: to the body it
/// names, or, driven, to those of its material.
std::vector<int> pieces_of(const Scene& scene, const std::vector<Material>& materials,
                           const std::vector<int>& body_material);

/// Whether anything can touch: several pieces, or matter other than gas and a wall.
bool anything_touches(const Scene& scene, const std::vector<int>& pieces);

}  // namespace ejecta
