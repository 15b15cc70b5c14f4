#pragma once
/// Sums and extremes over particles.
#include "base/types.hpp"
#include "model/conserved.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Sums over all particles, the same for every number of threads. x_c is the centre of mass.
template <int Dim>
Totals totals(const Particles<Dim>& particles);

/// Force, torque and power that take away the acceleration the pair pass has given to the particles of driven bodies.
template <int Dim>
ExternalLoad holding_load(const Particles<Dim>& particles, const Scene& scene);

/// Pressures that the matter of a body has seen at their highest, from Field::pressure_peak [Pa]; half of the mass has
/// seen at least the median.
struct PeakPressures {
  double max, median;
};
template <int Dim>
PeakPressures peak_pressures(const Particles<Dim>& particles, std::int32_t body);

/// Which momenta are conserved between such faces.
Kept kept_between(const Boundary& boundary);

}  // namespace ejecta
