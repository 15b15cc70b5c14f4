#pragma once
/// Time integration. It knows no physics: it advances (state, rate) pairs.
#include "particles/particles.hpp"

namespace ejecta {

/// Moves every state to the end of a step dt [s] with the rates at its start, and makes these the previous rates:
///   x += dt v + dt^2/2 a,   y += dt y'.
/// previous_dt is the length of the step before (0 at the start).
template <int Dim>
void predict(Particles<Dim>& particles, double dt, double previous_dt);

/// Replaces, in what was predicted, the rates at the start by the mean of those at both ends: y += dt/2 (y'_new -
/// y'_old). Together with predict() this is second order with one evaluation of the rates a step; for x and v it is the
/// leapfrog in kick-drift-kick form.
///
/// Energy. The heating w_i is evaluated with the predicted velocities v*, and sum m (w + a.v*) = 0 for any pair force.
/// A kick of length s takes v to v + s a, with mean velocity vbar; with u += s w - s a.(vbar - v*) the sum
/// m (u + v^2/2) is unchanged by every kick, to round-off. The second term is of third order in smooth flow.
template <int Dim>
void correct(Particles<Dim>& particles, double dt);

}  // namespace ejecta
