#pragma once
/// Bodies as clouds of points: a lattice cut by a shape, or a glass that fills it.
#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// What of a shell belongs to a particle.
template <int Dim>
struct ShellCell {
  double volume;     ///< m^3; m^2 in plane strain
  double thickness;  ///< of the shell [m]
  Vec<Dim> normal;   ///< of the shell
};

template <int Dim>
struct PointCloud {
  std::vector<Vec<Dim>> points;  ///< m
  double volume = 0;             ///< of one point's cell [m^3; m^2 in plane strain]; those of shells have their own
  std::vector<ShellCell<Dim>> cells;  ///< of shells, one a point

  void add(const Vec<Dim>& point, const ShellCell<Dim>& cell) {
    points.push_back(point);
    cells.push_back(cell);
  }
  double volume_of(std::size_t point) const { return cells.empty() ? volume : cells[point].volume; }
};

/// Particles of a body at about the given spacing [m] (edge of a cube of equal volume). The volumes of all points add
/// up to that of the body: a box gets a whole number of cells along each edge, the cloud of a round shape is scaled
/// from its centre or its hole,
/// and the points of a glass share the volume. The seed is that of the glass.
template <int Dim>
PointCloud<Dim> fill(const Body& body, double spacing, Lattice lattice, std::uint64_t seed = 0);

/// Whether a point lies in the body.
template <int Dim>
bool inside(const Body& body, const Vec<Dim>& x);

/// Distance from the nearest face of the body [m], negative outside of it.
template <int Dim>
double depth(const Body& body, const Vec<Dim>& x);

/// Volume of the body [m^3]; in plane strain its area [m^2].
double volume(const Body& body, int dim);

}  // namespace ejecta
