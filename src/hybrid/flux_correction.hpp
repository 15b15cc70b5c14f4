#pragma once
/// How a grid follows what particles have found without losing anything: by fluxes between its cells, on top of its
/// own.
///
/// After a step of its own the grid holds U*, and particles say that active cells hold D. Whatever is added to one cell
/// is taken from the next one through the face that they share: of all fluxes f that lead from U* to D in every active
/// cell,
///     sum over its faces of f = V (U* - D),
/// those are taken for which the sum of (f/s)^2 over all faces is least. s is 1 within the wave, and falls with
/// pressure times sound speed of the quieter cell beside a face where gas is at rest: corrections stay near what they
/// correct, and leave gas ahead of a shock alone. (With s as what may pass a face anyway, corrections follow dense
/// shells for long ways, and mass and energy wander along a front.) The cells next to the active ones get what comes
/// through their common faces, which is what makes the whole conservative [the refluxing of adaptive meshes, Berger &
/// Colella 1989, with fluxes that are not known but by what they did].
///
/// With one number phi a cell, 0 outside of the active ones, f = s^2 (phi_a - phi_b) from a to b [Lagrange's
/// multipliers]: a sparse, symmetric, positive definite system for all quantities.
#include "hybrid/zone.hpp"

namespace ejecta {

/// Cells that change, and what they hold afterwards [per volume].
template <int Dim>
struct CellChanges {
  std::vector<std::size_t> cells;
  std::vector<std::array<double, Dim + 2>> values;
};

/// What solids have taken from cells, and cells that have part of one.
template <int Dim>
struct SolidShare {
  std::array<double, Dim + 2> taken{};  ///< since the step began [per volume of the cell]
  bool there = false;
};

/// `active`: indices of the active cells; `place`: their places in it, by cell, -1 elsewhere; `wanted`: per volume, one
/// for each of `active`, as is `solids`. Where density or energy would not stay positive beside the zone the
/// corrections shrink.
///
/// Cells inside a solid hold gas at rest, whose pressure passes from one side of it to the other; the solid gets what
/// acts on each side. That these agree must not take its way around the solid: fluxes between its cells cost little.
template <int Dim>
CellChanges<Dim> correct_by_fluxes(const Grid<Dim>& grid, const std::vector<std::size_t>& active,
                                   const std::vector<std::int32_t>& place, const std::vector<SolidShare<Dim>>& solids,
                                   const std::vector<std::array<double, Dim + 2>>& wanted);

}  // namespace ejecta
