#pragma once
/// One step of a block of cells: fluxes through their faces, and what becomes of them.
///
/// Corner transport upwind [Colella 1990]: piecewise linear primitives are carried to the faces by half a step, first
/// along the normal alone; the fluxes of those states change the others by half a step of what crosses them sideways; a
/// second flux of the changed states carries the step. In 2D this is Colella's scheme, stable for steps of one crossing;
/// in 3D it leaves out what comes around edges (the six-solve form of Gardiner & Stone 2008), and is stable for half a
/// crossing.
///
/// A block is swept plane by plane along its last axis, and only the planes in use are kept, so that all of it stays in
/// the cache. Faces between two blocks are computed twice, with the same numbers.
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grid/box.hpp"
#include "grid/grid_settings.hpp"
#include "material/eos.hpp"

namespace ejecta {

/// Conserved quantities per volume, one column each: density, momentum, energy [kg/m^3, kg/(m^2 s), J/m^3].
template <int Dim>
using Conserved = std::array<std::vector<double>, Dim + 2>;

template <int Dim>
struct Tile {
  std::array<int, Dim> begin, count;
};

/// Largest extents of a tile. Its rows fill registers with one cell before them and one after.
template <int Dim>
constexpr std::array<int, Dim> tile_shape() {
  if constexpr (Dim == 2)
    return {126, 24};
  else
    return {30, 14, 32};
}

/// What a sweep found.
template <int Dim>
struct TileResult {
  double fastest = 0;       ///< largest |u| + c along an axis, at the end of the step [m/s]
  std::size_t where = 0;    ///< index of its cell
  bool uniform = false;     ///< whether all cells are the same state, bit for bit
  std::vector<std::size_t> bad;                  ///< cells whose density or energy is not positive
  std::array<double, Dim + 2> outflow{};         ///< through faces of the box: mass, momentum, energy [kg, kg m/s, J]
};

template <int Dim>
class TileSweep {
 public:
  virtual ~TileSweep() = default;
  /// Carries the cells of `tile` on by dt [s], from `now` into `next`. Cells that are `flagged` (by index; may be empty)
  /// pass fluxes of first order through all their faces.
  virtual TileResult<Dim> sweep(const Box<Dim>& box, const Tile<Dim>& tile, double dt, const Conserved<Dim>& now,
                                Conserved<Dim>& next, std::span<const std::uint8_t> flagged) = 0;
  /// The same of the cells as they are.
  virtual TileResult<Dim> look(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now) = 0;
  virtual std::size_t bytes() const = 0;
};

/// A sweep and its scratch, for one thread. Throws InputError if the equation of state cannot do what is asked.
template <int Dim>
std::unique_ptr<TileSweep<Dim>> make_tile_sweep(const Eos& eos, const GridSettings& settings);

/// Pressure [Pa] and sound speed [m/s] of one cell.
template <int Dim>
struct CellState {
  double density, pressure, sound_speed, specific_energy;
  Vec<Dim> velocity;
};
template <int Dim>
CellState<Dim> cell_state(const Eos& eos, const Conserved<Dim>& cells, std::size_t i);

}  // namespace ejecta
