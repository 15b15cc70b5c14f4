#pragma once
/// Scratch of a sweep: those planes of a tile that are in use, for each value one.
///
/// Planes of cells reach `halo` cells beyond the tile. Those of states and fluxes reach one cell, and their rows
/// begin with it, at the begin of a register. What loops over whole registers read and write beyond either is not
/// used.
#include <array>
#include <cstddef>
#include <vector>

#include "grid/riemann_lanes.hpp"
#include "grid/tile_sweep.hpp"

namespace ejecta::grid_detail {

constexpr int whole_registers(int n) { return (n + width - 1) / width * width; }

template <int Dim, class Gas>
class SweepPlanes {
 public:
  static constexpr int C = conserved_count<Dim>, W = Side<Dim, Gas>::values, X = Gas::extras;
  static constexpr int halo = 3;
  static constexpr int last = Dim - 1;  ///< the axis that the sweep runs along
  static constexpr std::array<int, Dim> shape = tile_shape<Dim>();
  static constexpr std::ptrdiff_t pitch = whole_registers(shape[0] + 2);
  static constexpr std::ptrdiff_t cell_pitch = whole_registers(shape[0] + 2 * halo + width);

  SweepPlanes()
      : scratch_(static_cast<std::size_t>((front + cells_size + states_size + fluxes_size) / width), V{} + 1) {}

  /// Where a cell of the tile is in a plane of cells, in one of the others.
  static std::ptrdiff_t cell_place(int x, int y) { return x + 1 + width + (Dim == 3 ? (y + halo) * cell_pitch : 0); }
  static std::ptrdiff_t place(int x, int y) { return x + 1 + (Dim == 3 ? (y + 1) * pitch : 0); }
  /// From a cell to the next one along an axis of the plane.
  static constexpr std::ptrdiff_t cell_step(int axis) { return axis == 0 ? 1 : cell_pitch; }
  static constexpr std::ptrdiff_t step(int axis) { return axis == 0 ? 1 : pitch; }

  /// Primitives, extras and the flag of the cells of plane k.
  double* cell(int k, int value) {
    return at(front) + ((k + kept_cells) % kept_cells * cell_values + value) * cell_plane;
  }
  double* flag(int k) { return cell(k, W + X); }
  /// Primitives at the upper (or lower) face across `axis` of the cells of plane k.
  double* state(int k, int axis, int upper, int value) { return states(k) + ((axis * 2 + upper) * W + value) * plane; }
  /// 1 in the cells of plane k that a strong shock along another axis than this one runs through, else 0.
  double* beside(int k, int axis) { return states(k) + (2 * Dim * W + axis) * plane; }
  /// Through the lower faces of plane k across `axis`. Across the last axis those of two planes are kept, the first
  /// ones in slots 0 and 1, the final ones in 2 and 3; across the others one slot serves both.
  double* first(int k, int axis, int value) { return flux(axis == last ? k & 1 : 4 + axis, value); }
  double* final(int k, int axis, int value) { return flux(axis == last ? 2 + (k & 1) : 4 + axis, value); }
  /// What crosses the cells of plane k along `axis` within half a step.
  double* sideways(int k, int axis, int value) { return flux(flux_slots + (k & 1) * Dim + axis, value); }
  std::size_t bytes() const { return scratch_.capacity() * sizeof(V); }

 private:
  static constexpr std::ptrdiff_t front = width;
  static constexpr std::ptrdiff_t gap = 3 * width;  ///< keeps planes from the same lines of the cache
  static constexpr std::ptrdiff_t cell_plane = cell_pitch * (Dim == 3 ? shape[1] + 2 * halo : 1) + gap;
  static constexpr std::ptrdiff_t plane = pitch * (Dim == 3 ? shape[1] + 2 : 1) + gap;
  static constexpr int kept_cells = 5, cell_values = W + X + 1, state_values = 2 * Dim * W + Dim;
  static constexpr int flux_slots = 4 + Dim - 1;
  static constexpr std::ptrdiff_t cells_size = kept_cells * cell_values * cell_plane;
  static constexpr std::ptrdiff_t states_size = 2 * state_values * plane;
  static constexpr std::ptrdiff_t fluxes_size = (flux_slots + 2 * Dim) * C * plane;

  double* at(std::ptrdiff_t place) { return reinterpret_cast<double*>(scratch_.data()) + place; }
  double* states(int k) { return at(front + cells_size + (k & 1) * state_values * plane); }
  double* flux(int slot, int value) { return at(front + cells_size + states_size) + (slot * C + value) * plane; }

  std::vector<V> scratch_;  // of registers, so that it begins as they must
};

}  // namespace ejecta::grid_detail
