#pragma once
/// What bounds the time step of the particles. All criteria are Galilean invariant.
#include "sph/sph.hpp"

namespace ejecta {

/// The criteria of a scene:
///   Courant condition:  C h / (c + 0.6 (alpha c + 2 beta max|mu|))   [Monaghan 1992, eq. 3.4, but for the 2]
///   acceleration:       C sqrt(h/|a|)                                [Monaghan 1992, eq. 3.3]
///     (alpha = beta = 1 and the speed of closing for Godunov fluxes)
///   compression:        C / |(1/rho) drho/dt|
/// What the viscosity takes from a difference of velocities grows by alpha c + 2 beta mu: the quadratic term counts
/// twice. Monaghan counts it once; cold matter of low sound speed then overshoots, and loses its energy. h is the
/// shortest axis of a smoothing ellipsoid. Where gradients are exact it is no longer than at the start: a particle with
/// few neighbours widens h, but those that it has are as near as before, and as stiff.
template <int Dim>
std::vector<Criterion<Dim>> choose_criteria(const Scene& scene);

}  // namespace ejecta
