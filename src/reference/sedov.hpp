#pragma once
/// The blast of a point source in an ideal gas at rest without pressure (Sedov 1959, Taylor 1950).
#include "reference/radial_flow.hpp"

namespace ejecta {

/// Self-similar: the shock is at R = (E t^2 / (alpha rho0))^(1/(nu+2)), nu = 1, 2, 3, and all profiles keep their shape
/// over r/R.
class Sedov {
 public:
  /// `gamma` > 1, and < 7 in spheres: beyond, the gas leaves an empty ball behind, which is not solved for. Where
  /// `exists` says no it must not be made.
  Sedov(Geometry geometry, double gamma);
  static bool exists(Geometry geometry, double gamma) { return geometry != Geometry::spherical || gamma < 7; }

  /// Of the formula above; the energy of planes counts both sides. Kamm & Timmes 2007: 1.077486, 0.984074, 0.851071 for
  /// gamma = 1.4. Relative error 1e-9.
  double alpha() const { return alpha_; }
  /// Of the shock at `time` [s] [m]; `energy` [J/m^2, J/m, J], `density` of the surroundings [kg/m^3].
  double radius(double energy, double density, double time) const;
  /// dR/dt of the same [m/s].
  double speed(double energy, double density, double time) const;

  /// Density over that of the surroundings; velocity over the speed of the shock; pressure over density of the
  /// surroundings times speed of the shock squared. `at` is r/R, from 0 to 1; behind the shock at 1.
  struct State {
    double density, velocity, pressure;
  };
  State state(double at) const;

 private:
  int nu_;
  double gamma_, alpha_ = 0;
  double core_;  ///< r/R within which the limits of r -> 0 hold
  State at_core_{};
};

}  // namespace ejecta
