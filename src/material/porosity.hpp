#pragma once
/// P-alpha porosity: distension alpha = rho_s/rho >= 1 of a solid of density rho_s = alpha rho, after Herrmann (1969)
/// and Jutzi, Benz & Michel (2008, Icarus 198, 242), whose rate form the functions below follow.
#include <algorithm>
#include <cmath>

#include "base/cube_root.hpp"
#include "material/crush_curve.hpp"
#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

struct Porosity {
  CrushCurve curve;
  double sound_speed = unset;  ///< of the intact porous body [m/s]; not set: that of the solid
  bool stress_factor = true;   ///< deviatoric stress rates follow the solid (stress_factor() below)
  bool crush_damage = true;    ///< crushing pores damages the material (pore_damage() below)

  double initial_distension() const { return curve.initial_distension; }
};

/// Pressure of the porous body [Pa]: P = P_s(alpha rho, e)/alpha (Carroll & Holt 1972).
inline double bulk_pressure(const EosPoint& solid, double alpha) { return solid.pressure / alpha; }

/// alpha + d(alpha)/dP (P - rho dP_s/drho_s), the denominator of both rates below. It equals alpha (1 - d(alpha)/dP
/// dP/d(alpha)), thus alpha at least unless the pressure falls with growing alpha (strongly expanded hot solid). There
/// it may vanish or turn negative, which would make pores open without bound: alpha is its lower limit.
inline double crush_denominator(const EosPoint& solid, double rho, double alpha, double slope) {
  return std::max(alpha, alpha + slope * (bulk_pressure(solid, alpha) - rho * solid.dP_drho));
}

/// d(alpha)/dP [1/Pa] of a body in this state: that of the curve when it is being crushed, 0 when it lies below the
/// curve (elastic, unloaded, reloading). The elastic branch is rigid: pores neither shrink nor grow on it.
///
/// A body counts as on the curve if a change of alpha below any that matters would bring it there. Measured along alpha
/// at constant pressure the distance would be up to a thousand times as long, as P is stiff and the curve steep: a
/// solution within the tolerance of its solver would count as off the curve, and the solid see all or none of the
/// strain by chance.
inline double crush_slope(const CrushCurve& curve, const EosPoint& solid, double rho, double alpha) {
  constexpr double on_curve = 1e-6;  // above any solver tolerance, below any distension that matters
  const CrushPoint point = curve.evaluate(bulk_pressure(solid, alpha));
  const double steepness = crush_denominator(solid, rho, alpha, point.slope) / alpha;
  return point.alpha <= alpha + on_curve * steepness ? point.slope : 0;
}

/// Rate of distension [1/s] along the curve: d(alpha)/dP [alpha dP_s/drho_s drho/dt + dP_s/de de/dt] / denominator,
/// never positive: pores do not reopen.
inline double distension_rate(const CrushCurve& curve, const EosPoint& solid, double rho, double alpha,
                              double density_rate, double energy_rate) {
  const double slope = crush_slope(curve, solid, rho, alpha);
  const double drive = alpha * solid.dP_drho * density_rate + solid.dP_de * energy_rate;
  return std::min(0.0, slope * drive / crush_denominator(solid, rho, alpha, slope));
}

/// Share f of the strain rate that the solid sees: f = 1 + (rho/alpha) d(alpha)/drho with the adiabatic
/// d(alpha)/drho = d(alpha)/dP [P/rho^2 dP_s/de + alpha dP_s/drho_s] / denominator; 0 (all strain closes pores) to 1.
inline double stress_factor(const CrushCurve& curve, const EosPoint& solid, double rho, double alpha) {
  const double pressure = bulk_pressure(solid, alpha), slope = crush_slope(curve, solid, rho, alpha);
  const double drive = pressure / (rho * rho) * solid.dP_de + alpha * solid.dP_drho;
  const double dalpha_drho = slope * drive / crush_denominator(solid, rho, alpha, slope);
  return std::clamp(1 + dalpha_drho * rho / alpha, 0.0, 1.0);
}

/// Sound speed [m/s] between that of the solid at alpha = 1 and the porous body's at alpha0, linear in alpha; never
/// above the solid's (Wuennemann, Collins & Melosh 2006, Icarus 180, 514).
inline double porous_sound_speed(const Porosity& porosity, double solid_speed, double alpha) {
  const double pores = porosity.initial_distension() - 1;
  if (!(porosity.sound_speed < solid_speed) || pores <= 0) return solid_speed;
  return solid_speed + (porosity.sound_speed - solid_speed) * (alpha - 1) / pores;
}

/// Damage D_p by crushing pores from alpha0 down to alpha, 0 to 1.
///
/// The rate (Jutzi, Benz & Michel 2008, with delta = 0.01 keeping it finite at the start) is
///   d(D_p^(1/3))/dt = 1/3 (u + delta)^(-2/3) / [(1 + delta)^(1/3) - delta^(1/3)] du/dt,   u = 1 - (alpha - 1)/(alpha0
///   - 1),
/// the derivative of (u + delta)^(1/3). From D_p = 0 at u = 0 it integrates to
///   D_p^(1/3) = [(u + delta)^(1/3) - delta^(1/3)] / [(1 + delta)^(1/3) - delta^(1/3)],   1 at u = 1.
/// Being a function of alpha, it needs no integration in time and cannot drift.
inline double pore_damage(double alpha, double alpha0) {
  if (alpha >= alpha0) return 0;
  if (alpha <= 1) return 1;  // to the last bit: what is broken is left alone
  constexpr double delta = 0.01, root_of_delta = 0.21544346900318837, root_of_all = 1.0033222835420892;
  const double u = (alpha0 - alpha) / (alpha0 - 1);
  const double length = std::max(0.0, cube_root(u + delta) - root_of_delta) * (1 / (root_of_all - root_of_delta));
  return length * length * length;
}

}  // namespace ejecta
