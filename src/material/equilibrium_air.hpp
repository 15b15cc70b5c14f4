#pragma once
#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Air in chemical equilibrium, from cold molecules to bare nuclei (air_chemistry.hpp): P = g(rho, e) rho e.
/// g = gamma - 1 is 0.4 in cold air, 0.1 to 0.4 while molecules break and atoms lose their electrons, 2/3 in the end.
/// It is interpolated by cubics (Catmull & Rom 1974) in a table over ln rho and ln e, which is worked out when the
/// first state is asked for. From 1e-4 to 1e3 kg/m^3 the pressure is that of the chemistry within 0.5 %, elsewhere in
/// the table within 1 %; its derivatives are those of the interpolant, continuous everywhere.
///
/// The table covers 1e-6 to 1e4 kg/m^3 and 1e5 to 1e13 J/kg. Beyond, g is that of the nearest edge, at which it has no
/// slope. At the ends of the energy little is left to change: g is 0.4 within 1e-5, and 2/3 within 1e-3.
struct EquilibriumAir {
  static constexpr bool gas = true;

  double rho0 = unset;  ///< density a body has unless the scene says otherwise [kg/m^3]

  /// State at density rho > 0 [kg/m^3] and specific energy e [J/kg] above that of cold molecules.
  EosPoint evaluate(double rho, double e) const;
  /// Specific energy [J/kg] at density rho [kg/m^3] and pressure [Pa].
  double specific_energy(double rho, double pressure) const;
  double reference_density() const { return rho0; }
  double sound_speed_floor() const { return 0; }
};

}  // namespace ejecta
