#pragma once
#include <cmath>

#include "scene/scene.hpp"

namespace ejecta {

/// How far the blast of the charge will have come at the end, about [m]: a point source of its energy in gas of this
/// density [kg/m^3] [Sedov 1959]. For estimates and pictures.
inline double blast_reach(const Scene& scene, double density) {
  const int d = scene.dimension;
  return std::pow(scene.charge->energy_in(d) / density * scene.time_end * scene.time_end, 1.0 / (d + 2));
}

}  // namespace ejecta
