#pragma once
#include <cmath>

#include "material/strength_state.hpp"

namespace ejecta {

struct PlasticFlow {
  double yield;           ///< yield stress when the flow is over [Pa]
  double plastic_strain;  ///< increment, >= 0
  int evaluations;        ///< of the yield stress
};

/// Plastic strain x of a step during which the metal hardens: the stress that is left lies on the surface that the flow
/// itself has moved,
///   q - 3 G x = Y(eps_p + x, x/dt).
/// The left side falls and the right side rises with x: one zero, between 0 and (q - Y(eps_p, 0))/(3 G). Newton's
/// method kept inside that bracket, which every evaluation shrinks; to 1e-13 of q.
/// @param state     at the beginning of the step
/// @param trial     q, equivalent stress if the step were elastic [Pa]
/// @param shear     G [Pa]; 0 (melted): the stress is gone, and no strain can be told from it
/// @param dt        duration of the step [s]; 0: the rate counts as 0
template <class Model>
PlasticFlow flow(const Model& model, StrengthState state, double trial, double shear, double dt) {
  const double before = state.plastic_strain, per_dt = dt > 0 ? 1 / dt : 0;
  state.strain_rate = 0;
  YieldPoint point = model.evaluate(state);
  if (trial <= point.stress || shear <= 0) return {point.stress, 0, 1};
  double low = 0, high = (trial - point.stress) / (3 * shear), x = high;
  for (int evaluations = 2;; ++evaluations) {
    state.plastic_strain = before + x;
    state.strain_rate = x * per_dt;
    point = model.evaluate(state);
    const double excess = trial - 3 * shear * x - point.stress;
    if (std::abs(excess) <= 1e-13 * trial || evaluations == 100) return {point.stress, x, evaluations};
    (excess > 0 ? low : high) = x;
    const double newton = x + excess / (3 * shear + point.by_strain + point.by_rate * per_dt);
    // The power law of the strain and the logarithm of the rate are steepest at 0, so that a step to the left may go
    // too far by orders of magnitude.
    x = newton <= low ? low + (high - low) / 16 : newton < high ? newton : 0.5 * (low + high);
  }
}

}  // namespace ejecta
