#pragma once
#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// P = rho0 c0^2 mu + gamma0 rho0 e, mu = rho/rho0 - 1: Hooke's law of volume, for bodies that are little compressed
/// (rubber balls: Monaghan 2000, J. Comput. Phys. 159, 290). Nothing limits its tension.
struct LinearEos {
  static constexpr bool gas = false;

  double rho0 = unset;  ///< reference density [kg/m^3]
  double c0 = unset;    ///< sound speed [m/s]
  double gamma0 = 0;    ///< Grueneisen parameter; 0: no heat in the pressure

  /// State at density rho > 0 [kg/m^3] and specific energy e [J/kg].
  EosPoint evaluate(double rho, double e) const {
    return {c0 * c0 * (rho - rho0) + gamma0 * rho0 * e, c0 * c0, gamma0 * rho0};
  }
  double reference_density() const { return rho0; }
  /// One per cent of c0 [m/s]; used where c^2 < 0.
  double sound_speed_floor() const { return 0.01 * c0; }
};

}  // namespace ejecta
