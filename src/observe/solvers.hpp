#pragma once
/// The solvers of a run, for those who look at one of them.
#include "grid/grid.hpp"
#include "simulation/simulation.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// Calls see(sph) if the matter of the simulation is particles: those of a hybrid are gone tomorrow.
template <class See>
void with_particles(const Simulation& sim, See&& see) {
  if (sim.scene.numerics.on_grid()) return;
  if (const auto* flat = find_package<Sph<2>>(sim)) see(*flat);
  if (const auto* full = find_package<Sph<3>>(sim)) see(*full);
}

/// Calls see(grid) if the simulation has one.
template <class See>
void with_grid(const Simulation& sim, See&& see) {
  if (const auto* flat = find_package<Grid<2>>(sim)) see(*flat);
  if (const auto* full = find_package<Grid<3>>(sim)) see(*full);
}

}  // namespace ejecta
