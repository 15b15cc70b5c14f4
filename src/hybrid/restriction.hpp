#pragma once
/// What particles say cells hold.
#include <vector>

#include "hybrid/zone.hpp"
#include "particles/particles.hpp"

namespace ejecta {

/// A cell as its particles see it.
template <int Dim>
struct Restricted {
  std::array<double, Dim + 2> sum{};  ///< density, momentum and energy per volume
  double volume = 0;                  ///< share of the cell that particles cover
  double solid = 0;                   ///< that of the images of solids among them, which are not in the sum
};

/// Of the active cells of a zone, one each in the order of `cells`. Every particle is a square (a cube) as large as its
/// volume m/rho, and brings each cell what it overlaps with, its images behind mirrors and one period away too. What
/// the particles have is in the cells, no more and no less. Means over what is covered would be smoother (a stream
/// through a zone is disturbed by two thirds), and wrong: in a shock, volumes by number overlap or leave gaps as the
/// lattice lies, and what means then add or take away comes out of the neighbours: of 1 kt at 20 cm a sector of 10
/// degrees along the axes then had a fifth more mass than the mean at 1 ms, and has 4 % so.
template <int Dim>
std::vector<Restricted<Dim>> restrict_particles(const Particles<Dim>& particles, const Box<Dim>& box,
                                                const std::vector<std::int32_t>& place, std::size_t cells);

}  // namespace ejecta
