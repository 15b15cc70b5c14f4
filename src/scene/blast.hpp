#pragma once
/// A blast as people set it: a charge in a gas.
#include <string>

#include "scene/choices.hpp"

namespace ejecta {

struct Document;
class Problems;
struct Scene;

/// A ball, in 2D a disc, of hot dense gas.
struct Charge {
  static constexpr const char* name = "charge";  ///< of its body

  Triple center{0, 0, 0};            ///< m
  double radius = unset;             ///< m
  double density = unset;            ///< kg/m^3
  double energy_per_length = unset;  ///< J/m; in 2D, all of it internal
  double energy = unset;             ///< J; in 3D, all of it internal
  std::string material;              ///< empty: that of the gas
  double start = unset;              ///< until then its blast is solved in one dimension [s]

  /// Of the whole charge [J; J/m in 2D].
  double energy_in(int dimension) const { return dimension == 2 ? energy_per_length : energy; }
};

/// What fills the boundary box wherever no body is.
struct Gas {
  static constexpr const char* name = "gas";  ///< of its body

  std::string material = "air";
  double gamma = unset;     ///< in place of the material's own
  double density = unset;   ///< kg/m^3; not set: the material's own
  double pressure = unset;  ///< Pa
};

/// Adds the bodies that charge and gas stand for: the charge before and the gas after those of the file, and makes gamma
/// a value of the material. The gas has the size of the boundary box, `unset` along axes on which that has none.
void add_blast(Scene& scene, const Document& document, Problems& problems);

}  // namespace ejecta
