#pragma once
/// Air in thermal and chemical equilibrium, from statistical physics.

namespace ejecta {

struct AirState {
  double pressure;         ///< Pa
  double specific_energy;  ///< above that of N2 and O2 at 0 K [J/kg]
};

/// State of air of density rho [kg/m^3] and temperature [K]: ideal gases N2, O2, NO, N, O, every ion of N and O, and
/// electrons. Dissociation and ionisation follow the law of mass action (for ions Saha's equation), as in Zel'dovich &
/// Raizer 1967, Physics of Shock Waves, chapter III. Molecules are rigid rotors and harmonic oscillators in each of
/// their electronic states; atoms and ions have all terms of the shell n = 2, which is what neighbours leave of sums
/// that do not converge. Molecular ions, of which there are few, are left out; argon counts as N2.
///
/// What is left out besides: the attraction of charges (by Debye & Hueckel 3 % of the pressure at 0.1 kg/m^3, 5 to 20 %
/// at 1 to 10 kg/m^3, all between 2e4 and 2e5 K; ionisation made easier undoes a part of it), the volume of cold
/// molecules (air is a liquid at 1e3 kg/m^3), and radiation (at 1 kg/m^3 it holds 5 % of the energy at 1e6 K).
AirState air_in_equilibrium(double rho, double temperature);

}  // namespace ejecta
