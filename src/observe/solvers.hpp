#pragma once
/// The solvers of a run, for those who look at one of them.
#include "grid/grid.hpp"
#include "simulation/simulation.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// Calls see(sph) if bodies of the simulation are particles; those of the gas in a hybrid are gone tomorrow.
template <class See>
void with_particles(const Simulation& sim, See&& see) {
  const auto show = [&](const auto* sph) {
    if (sph && sph->title != "gas") see(*sph);
  };
  show(find_package<Sph<2>>(sim));
  show(find_package<Sph<3>>(sim));
}

/// Calls see(grid) if the simulation has one.
template <class See>
void with_grid(const Simulation& sim, See&& see) {
  if (const auto* flat = find_package<Grid<2>>(sim)) see(*flat);
  if (const auto* full = find_package<Grid<3>>(sim)) see(*full);
}

}  // namespace ejecta
