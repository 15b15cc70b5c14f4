#pragma once
/// What a programmed burn asks of an explosive, whatever its equation of state.

namespace ejecta {

struct Explosive {
  double detonation_speed;  ///< D [m/s]
  double cj_compression;    ///< 1 - V of the state behind a steady detonation (Chapman & Jouguet)
  double energy;            ///< that burning sets free [J/kg]
};

}  // namespace ejecta
