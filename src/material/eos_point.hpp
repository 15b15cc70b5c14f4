#pragma once
/// What an equation of state says about one state of matter.
#include <algorithm>
#include <cmath>

namespace ejecta {

struct EosPoint {
  double pressure;  ///< Pa
  double dP_drho;   ///< at constant specific energy [Pa m^3/kg]
  double dP_de;     ///< at constant density [Pa kg/J]; may be negative between E_iv and E_cv of Tillotson
};

/// Adiabatic sound speed [m/s]: c^2 = dP/drho + (P/rho^2) dP/de, never below `floor` [m/s]. The floor is what is left
/// where the equation of state is mechanically unstable (c^2 < 0 in strong expansion).
inline double sound_speed(const EosPoint& point, double rho, double floor) {
  return std::sqrt(std::max(point.dP_drho + point.pressure * point.dP_de / (rho * rho), floor * floor));
}

}  // namespace ejecta
