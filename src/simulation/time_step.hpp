#pragma once
#include "simulation/simulation.hpp"

namespace ejecta {

/// The smallest time step any particle asks for, with the reason. All votes are Galilean invariant.
///   Courant:      C h / (c + 0.6 (alpha c + beta max|mu|))   [Monaghan 1992, Annu. Rev. Astron. Astrophys. 30, 543]
///   acceleration: 0.6 C sqrt(h/|a|)                          [the same]
///   compression:  0.6 C / |(1/rho) drho/dt|
/// The default C = 0.4, and 0.6 C = 0.25, are Monaghan's. The fastest wave on a cubic lattice then has w dt = 0.29, or
/// 0.46 without viscosity, for any number of neighbours (integrator.hpp: stable up to 0.75). Errors of shocks and
/// elastic waves are those at C = 0.25 to a few per cent of themselves.
template <int Dim>
TimeStepVote vote_time_step(const Simulation<Dim>& sim);

/// Throws SimulationError if a particle's state is not finite or its density not positive; `stage` says where.
template <int Dim>
void check_health(const Simulation<Dim>& sim, std::string_view stage);

/// One line that identifies a particle: id, body, material, position, velocity, density, energy.
template <int Dim>
std::string describe_particle(const Simulation<Dim>& sim, std::size_t i);

}  // namespace ejecta
