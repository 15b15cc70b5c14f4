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

/// Largest values to be expected in a run [SI]; `unset` where nothing is known.
struct Extremes {
  double pressure = unset, density = unset, speed = unset, distension = unset, aspect = unset, mach = unset;
  double least_density = 0;
  double tension = unset;  ///< that the strongest matter bears [Pa]; fluids bear none
  double onset =
      unset;  ///< pressure or tension at which the weakest matter yields, cracks or begins to be crushed [Pa]
};
/// What particles lead one to expect that set out like this, of these materials, or what a plane impact does if that is
/// more. What solids bear follows from their moduli and strengths: the tension that opens the weakest flaw of a
/// particle, else the yield stress, else a hundredth of the bulk modulus. At least three times that is expected of the
/// pressure, or what motion alone can bring about if that is less and nothing else loads them.
Extremes extremes(const Scene& scene, const std::vector<Material>& materials, const Outset& outset);

/// Of all fields that have a style of their own or a range given by the scene. Ranges are the scene's, and where it
/// gives none what follows from the extremes.
std::map<std::string, FieldStyle> field_styles(const Scene& scene, const Extremes& expected);

}  // namespace ejecta
