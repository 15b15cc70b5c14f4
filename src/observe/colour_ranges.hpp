#pragma once
/// Colour ranges of the images, fixed for a run so that frames do not flicker.
#include <map>
#include <string>
#include <vector>

#include "material/material.hpp"
#include "scene/scene.hpp"
#include "sph/outset.hpp"

namespace ejecta {

/// The scene's, and where it gives none what follows from what the run sets out with.
std::map<std::string, ColourRange> colour_ranges(const Scene& scene, const std::vector<Material>& materials,
                                                 const Outset& outset);

}  // namespace ejecta
