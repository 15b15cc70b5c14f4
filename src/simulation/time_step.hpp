#pragma once
#include "simulation/simulation.hpp"

namespace ejecta {

/// The smallest time step any particle asks for, with the reason. All votes are Galilean invariant.
///   Courant:      C h / (c + 0.6 (alpha c + beta max|mu|))   [Monaghan 1992, eq. 3.4]
///   acceleration: C sqrt(h/|a|)                              [Monaghan 1992, eq. 3.3]
///   compression:  C / |(1/rho) drho/dt|
template <int Dim>
TimeStepVote vote_time_step(const Simulation<Dim>& sim);

/// Throws SimulationError if a particle's state is not finite or its density not positive; `stage` says where.
template <int Dim>
void check_health(const Simulation<Dim>& sim, std::string_view stage);

/// One line that identifies a particle: id, body, material, position, velocity, density, energy.
template <int Dim>
std::string describe_particle(const Simulation<Dim>& sim, std::size_t i);

}  // namespace ejecta
