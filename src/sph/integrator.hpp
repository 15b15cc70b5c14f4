#pragma once
/// Time integration. It knows no physics: it advances (state, rate) pairs.
#include "particles/particles.hpp"

namespace ejecta {

/// Moves every state to the end of a step dt [s], and makes the rates at its start the previous ones:
///   x += dt v + dt^2/2 a,   v += dt a,   y += dt/2 (y'_0 + y'_e),   y'_e = y'_0 + min(2, dt/dt_p) (y'_0 - y'_p).
/// Energy, stress and the logarithm of density (y) go by the mean of the rate and of what it is expected to be at the
/// end if it goes on changing as it did in the step before, of length dt_p = previous_dt (0 at the start). With
/// `damped_density` y'_e = y'_0 of the density: Riemann problems level pressures by moving volumes, and what falls by a
/// share z a step is stable up to z = 1 so, and only up to 1/2 as above.
template <int Dim>
void predict(Particles<Dim>& particles, double dt, double previous_dt, bool damped_density = false);

/// Replaces, in what was predicted, the rates by the mean of those at both ends: v += dt/2 (a_1 - a_0) and
/// y += dt/2 (y'_1 - y'_e). Together with predict() this is second order with one evaluation of the rates a step; for x
/// and v it is the leapfrog in kick-drift-kick form.
///
/// Stability. In elastic waves v and y drive each other, with rates evaluated at what was predicted. Were y predicted
/// with y'_0 alone, v and y would make the steps of the second-order scheme of Adams and Bashforth, in which a wave of
/// frequency w grows by (w dt)^4/4 a step and takes its energy from the heat. As it is, it fades by (w dt)^4/8, its
/// frequency is off by 0.17 (w dt)^2 instead of 0.42, and steps are stable up to w dt = 0.75.
///
/// Energy. The heating w_i is evaluated with the predicted velocities v*, and sum m (w + a.v*) = 0 for any pair force.
/// A kick of length s takes v to v + s a, with mean velocity vbar; with u += s w - s a.(vbar - v*) the sum
/// m (u + v^2/2) is unchanged by every kick, to round-off. The second term is of third order in smooth flow.
template <int Dim>
void correct(Particles<Dim>& particles, double dt);

}  // namespace ejecta
