#pragma once
#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Ideal gas of constant adiabatic index: P = (gamma - 1) rho e.
struct IdealGas {
  static constexpr bool gas = true;

  double gamma = unset;  ///< ratio of specific heats, > 1
  double rho0 = unset;   ///< density a body has unless the scene says otherwise [kg/m^3]

  /// State at density rho [kg/m^3] and specific energy e [J/kg].
  EosPoint evaluate(double rho, double e) const { return {(gamma - 1) * rho * e, (gamma - 1) * e, (gamma - 1) * rho}; }
  /// Specific energy [J/kg] at density rho [kg/m^3] and pressure [Pa].
  double specific_energy(double rho, double pressure) const { return pressure / ((gamma - 1) * rho); }
  double reference_density() const { return rho0; }
  double sound_speed_floor() const { return 0; }
};

}  // namespace ejecta
