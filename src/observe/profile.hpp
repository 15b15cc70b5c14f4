#pragma once
/// What a scene in one dimension looks like: values along its longest axis.
#include <filesystem>

#include "grid/grid.hpp"
#include "output/monitor.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// The row of cells through the charge, or the middle of the box, along x.
template <int Dim>
std::vector<std::size_t> row_of_cells(const Grid<Dim>& grid, const Scene& scene);

/// Of a grid, density, velocity and pressure in that row; of particles, their means by mass over slabs across the
/// longest axis if they fill a strip, several times as long as it is wide. Empty for others.
MonitorProfile profile_of(const Simulation& sim);

/// A row a place, SI, units in the header. Throws OutputError.
void write_profile(const std::filesystem::path& file, const MonitorProfile& profile);

}  // namespace ejecta
