#pragma once
/// How the fields of a run are shown, by Ejecta's own painter and by the pipelines. Fixed for a run so that frames do
/// not flicker.
#include <map>
#include <string>
#include <vector>

#include "material/material.hpp"
#include "render/field_style.hpp"
#include "scene/scene.hpp"
#include "sph/outset.hpp"

namespace ejecta {

/// Of all fields that have a style of their own or a range given by the scene. Ranges are the scene's, and where it
/// gives none what follows from what the run sets out with.
std::map<std::string, FieldStyle> field_styles(const Scene& scene, const std::vector<Material>& materials,
                                               const Outset& outset);

}  // namespace ejecta
