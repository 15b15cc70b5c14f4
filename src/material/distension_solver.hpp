#pragma once
/// The distension of a porous body of given density and energy: the zero in [1, alpha_old] of
///   F(alpha) = alpha - min(curve(P_s(alpha rho, e)/alpha), alpha_old).
/// The minimum with the distension so far makes crushing irreversible; alpha_old is returned exactly when the pressure
/// does not reach the curve. F(1) <= 0 <= F(alpha_old), so there always is a zero.
#include <algorithm>
#include <cmath>

#include "material/crush_curve.hpp"
#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// How the distension is looked for.
struct DistensionSearch {
  DistensionSolver method = DistensionSolver::safe_newton;
  double tolerance = 1e-12;  ///< of alpha; above 1e-7 the pressure shows it (kPa and more)
};

struct DistensionResult {
  double alpha;
  EosPoint solid;   ///< at (alpha rho, e); the pressure of the body is solid.pressure/alpha
  int evaluations;  ///< of the equation of state
  bool converged;   ///< false only for plain Newton, which may cycle between the branches of the curve
};

namespace distension {

/// F and what its zero finders need, at one alpha.
struct Trial {
  double alpha;
  EosPoint solid;
  double pressure;   ///< of the body [Pa]
  double dP_dalpha;  ///< at constant rho and e [Pa]
  double residual;   ///< F
  double slope;      ///< dF/d(alpha) = 1 - d(alpha)/dP dP/d(alpha) on the curve, 1 off it
};

template <class EosT>
struct Problem {
  const CrushCurve& curve;
  const EosT& eos;
  double rho, e, alpha_old, tolerance;
  int evaluations = 0;

  Trial evaluate(double alpha) {
    ++evaluations;
    const double per_alpha = 1 / alpha;
    Trial t{alpha, eos.evaluate(alpha * rho, e), 0, 0, 0, 1};
    t.pressure = t.solid.pressure * per_alpha;
    t.dP_dalpha = (rho * t.solid.dP_drho - t.pressure) * per_alpha;
    const CrushPoint crush = curve.evaluate(t.pressure);
    t.residual = alpha - std::min(crush.alpha, alpha_old);
    if (crush.alpha < alpha_old) t.slope = 1 - crush.slope * t.dP_dalpha;
    return t;
  }
  /// The zero is within the tolerance of t.
  bool accepts(const Trial& t) const { return std::abs(t.residual) <= tolerance * std::max(t.slope, 1.0); }
  DistensionResult result(const Trial& t, bool converged = true) const {
    return {t.alpha, t.solid, evaluations, converged};
  }
};

/// Halves [low, high], F(low) <= 0 <= F(high), down to the tolerance (or to neighbouring numbers).
template <class EosT>
DistensionResult bisect(Problem<EosT>& problem, double low, double high) {
  for (;;) {
    const double middle = 0.5 * (low + high);
    const Trial t = problem.evaluate(middle);
    if (high - low <= problem.tolerance || middle <= low || middle >= high || t.residual == 0) return problem.result(t);
    (t.residual > 0 ? high : low) = middle;
  }
}

/// Largest zero of F also where F is not monotone: looks from alpha_old down for the first change of sign.
template <class EosT>
DistensionResult search_from_above(Problem<EosT>& problem) {
  constexpr int intervals = 64;
  const double width = (problem.alpha_old - 1) / intervals;
  for (int k = intervals - 1; k > 0; --k) {
    const double alpha = 1 + k * width;
    if (problem.evaluate(alpha).residual <= 0) return bisect(problem, alpha, alpha + width);
  }
  const Trial solid = problem.evaluate(1);
  return solid.residual == 0 ? problem.result(solid) : bisect(problem, 1, 1 + width);
}

/// Newton's method kept inside a bracket that every evaluation shrinks; a step that leaves it becomes a bisection.
///
/// Its step intersects the tangent of P(alpha) with the curve itself (CrushCurve::meet) rather than with the curve's
/// tangent. P(alpha) is stiff and nearly straight where the curve is soft and kinked, hence two or three steps suffice
/// and the kinks at P_e and P_s, where the ordinary step ping-pongs, are never felt.
///
/// Where P grows with alpha, F grows too (d(curve)/dP <= 0): one zero, no choice. This covers every cold or compressed
/// state of Tillotson with A >= B. In an expanded solid, hot or with A < B, P may fall with alpha and F have several
/// zeros; the largest is the one reached from alpha_old without a jump. Meeting such a slope above P_e sends the search
/// to search_from_above(); so does running out of steps. Only a step across a whole hollow of P goes unnoticed, which
/// takes a change of alpha no time step makes (tests/unit/material counts them).
template <class EosT>
DistensionResult safe_newton(Problem<EosT>& problem, Trial t) {
  constexpr int max_steps = 60;
  constexpr double close_enough =
      1e-4;  // of the range: the curve is as good as straight, so its tangent serves as well
  double low = 1, high = problem.alpha_old;
  bool low_known = false;
  for (int step = 0; step < max_steps; ++step) {
    const bool falling = t.dP_dalpha * t.alpha < -1e-6 * std::abs(t.pressure);  // not just by rounding, as in vapour
    if (falling && t.pressure > problem.curve.elastic_pressure) break;
    const double ordinary = t.alpha - t.residual / t.slope;
    const bool close = t.slope > 1 && std::abs(ordinary - t.alpha) < close_enough * (problem.alpha_old - 1);
    double next = falling ? high
                  : close ? ordinary
                          : problem.curve.meet(t.alpha, t.pressure, std::max(t.dP_dalpha, 0.0));
    if (next <= low && !low_known) {
      next = low;
      low_known = true;
    } else if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    t = problem.evaluate(next);
    if (problem.accepts(t) || high - low <= problem.tolerance) return problem.result(t);
    (t.residual > 0 ? high : low) = next;
  }
  return search_from_above(problem);
}

/// Newton's method with nothing but the physical range [1, alpha_old] to hold it: the method that fails at the kinks,
/// for comparison.
template <class EosT>
DistensionResult plain_newton(Problem<EosT>& problem, Trial t) {
  constexpr int max_steps = 60;
  for (int step = 0; step < max_steps; ++step) {
    t = problem.evaluate(std::clamp(t.alpha - t.residual / t.slope, 1.0, problem.alpha_old));
    if (problem.accepts(t)) return problem.result(t);
  }
  return problem.result(t, false);
}

}  // namespace distension

/// @param rho        density of the body [kg/m^3], > 0
/// @param e          specific energy [J/kg]
/// @param alpha_old  distension so far, the smallest in the body's history
/// @return 1 <= alpha <= alpha_old; always in double, since (alpha - 1) of a nearly compacted body cancels
template <class EosT>
DistensionResult solve_distension(const CrushCurve& curve, const EosT& eos, double rho, double e, double alpha_old,
                                  const DistensionSearch& search) {
  distension::Problem<EosT> problem{curve, eos, rho, e, alpha_old, search.tolerance};
  const distension::Trial start = problem.evaluate(alpha_old);
  if (alpha_old <= 1 || problem.accepts(start)) return problem.result(start);
  switch (search.method) {
    case DistensionSolver::bisection:
      return distension::bisect(problem, 1.0, alpha_old);
    case DistensionSolver::newton:
      return distension::plain_newton(problem, start);
    case DistensionSolver::safe_newton:
      break;
  }
  return distension::safe_newton(problem, start);
}

}  // namespace ejecta
