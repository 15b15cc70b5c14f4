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

/// The pressure that half of the mass of a body has seen at least, from Field::pressure_peak [Pa].
template <int Dim>
double median_peak_pressure(const Particles<Dim>& particles, std::int32_t body);

/// Which momenta are conserved between such faces.
Kept kept_between(const Boundary& boundary);

}  // namespace ejecta
