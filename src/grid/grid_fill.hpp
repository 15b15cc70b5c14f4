#pragma once
/// The bodies of a scene as cells.
#include "grid/tile_sweep.hpp"
#include "material/matter_at.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// The box that a scene asks for: that of its boundary; where an open face has no place, around the bodies, to grow with
/// what happens if there is [gas]. A blast has room for `reached` [m] from the centre of its charge. Throws InputError if it is no whole number of cells, or cuts a charge.
template <int Dim>
Box<Dim> box_of(const Scene& scene, double reached = 0);

/// Cells of that box. Where several states meet in a cell it gets what sub-samples of it hold. `start` (may be null)
/// takes the place of what the scene says, where it reaches. Throws InputError if a cell is empty.
template <int Dim>
Conserved<Dim> fill_cells(const Scene& scene, const std::vector<Material>& materials, const Box<Dim>& box,
                          const RadialState* start);

/// State of [gas], that of nothing if there is none.
template <int Dim>
std::array<double, Dim + 2> ambient_of(const Scene& scene, const std::vector<Material>& materials);

/// The one material on the grid. Throws InputError with the reasons why bodies cannot be on a grid.
const Material& grid_material(const Scene& scene, const std::vector<Material>& materials);

}  // namespace ejecta
