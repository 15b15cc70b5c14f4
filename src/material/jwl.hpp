#pragma once
#include <algorithm>
#include <cmath>

#include "material/eos_point.hpp"
#include "material/explosive.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// The state behind a steady plane detonation whose products move at the speed of sound relative to it: of Chapman and
/// Jouguet.
struct ChapmanJouguet {
  double speed;     ///< D [m/s]
  double pressure;  ///< Pa
  double volume;    ///< V = rho0/rho
  double velocity;  ///< of the products, D (1 - V) [m/s]
};

/// An explosive whose products have the equation of state of Jones, Wilkins and Lee [Lee, Hornig & Kury 1968,
/// UCRL-50422; recalled]. With V = rho0/rho and the energy per volume of explosive E = rho0 e:
///   P = A (1 - w/(R1 V)) exp(-R1 V) + B (1 - w/(R2 V)) exp(-R2 V) + w E / V.
/// The energy begins at E0: that of the bonds is in it from the start, and burning needs no source. Pressure is that of
/// the products times the burnt fraction, so matter that has not burnt has none, nor has it strength. Products do not
/// pull: no pressure below zero. The form says nothing of much denser matter (at V = w/R1 the first term vanishes):
/// below V = densest what does not depend on the energy goes on along its tangent in the density.
struct Jwl {
  static constexpr bool gas = true;
  static constexpr double densest = 0.35;  ///< V; a detonation that meets another one comes to about half

  double rho0 = unset;              ///< density of the explosive [kg/m^3]
  double A = unset, B = unset;      ///< Pa
  double R1 = unset, R2 = unset;    ///< 1
  double omega = unset;             ///< w, Grueneisen parameter of the products
  double E0 = unset;                ///< energy per volume of explosive [J/m^3]
  double detonation_speed = unset;  ///< D, measured [m/s]; what the constants say must agree with it
  double cj_pressure = unset;       ///< measured [Pa]; the same, if it is given

  /// State at density rho > 0 [kg/m^3], specific energy e [J/kg] and burnt fraction. The derivatives are those of the
  /// products whatever has burnt: sound speed, viscosity and time step do not jump when the front arrives.
  EosPoint evaluate(double rho, double e, double burnt = 0) const {
    const double held = std::min(rho, rho0 / densest), V = rho0 / held;
    const double a = A * std::exp(-R1 * V), b = B * std::exp(-R2 * V);
    const double dP_dV = a * (omega / V * (1 + 1 / (R1 * V)) - R1) + b * (omega / V * (1 + 1 / (R2 * V)) - R2);
    const double cold_slope = -dP_dV * V / held;
    const double cold = a * (1 - omega / (R1 * V)) + b * (1 - omega / (R2 * V)) + cold_slope * (rho - held);
    const double pressure = cold + omega * rho * e;
    if (pressure <= 0) return {0, 0, 0};
    return {burnt * pressure, cold_slope + omega * e, omega * rho};
  }
  double reference_density() const { return rho0; }
  /// One per cent of D [m/s]; of cold products that would pull.
  double sound_speed_floor() const { return 0.01 * detonation_speed; }

  /// Energy of matter as it is made [J/kg].
  double energy_at_rest() const { return E0 / rho0; }
  /// The slowest steady detonation on the Hugoniot of the products, from the explosive at rest without pressure.
  ChapmanJouguet chapman_jouguet() const;
  Explosive explosive() const { return {detonation_speed, 1 - chapman_jouguet().volume, energy_at_rest()}; }
};

}  // namespace ejecta
