#pragma once
/// What particles say cells hold.
#include <vector>

#include "hybrid/zone.hpp"
#include "particles/particles.hpp"

namespace ejecta {

/// A cell as its particles see it.
template <int Dim>
struct Restricted {
  std::array<double, Dim + 2> sum{};  ///< density, momentum and energy per volume, times the volume that is covered
  double volume = 0;                  ///< of the cell, covered by particles [m^3; m^2]
};

/// Of the active cells of a zone, one each in the order of `cells`. Every particle is a square (a cube) as large as its
/// volume m/rho, and counts where it overlaps, its images behind mirrors and one period away too: densities are means
/// over what is covered, so that uniform gas is uniform in the cells, however its particles lie.
template <int Dim>
std::vector<Restricted<Dim>> restrict_particles(const Particles<Dim>& particles, const Box<Dim>& box,
                                                const std::vector<std::int32_t>& place, std::size_t cells);

}  // namespace ejecta
