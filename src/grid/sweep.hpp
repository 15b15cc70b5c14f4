#pragma once
/// A sweep of tile_sweep.hpp: the order of its loops, which are in
///   sweep_cells.hpp    from the cells of the box to primitives, and from fluxes to new cells
///   sweep_fluxes.hpp   from primitives to fluxes
#include <algorithm>
#include <bit>
#include <utility>

#include "grid/reconstruction.hpp"
#include "grid/sweep_planes.hpp"

namespace ejecta::grid_detail {

/// Calls body with std::integral_constant<int, a> of every axis: the loops over faces are compiled for theirs.
template <int Dim, class Body>
[[gnu::always_inline]] inline void for_axes(Body&& body) {
  [&]<int... a>(std::integer_sequence<int, a...>) __attribute__((always_inline)) {
    (body(std::integral_constant<int, a>{}), ...);
  }
  (std::make_integer_sequence<int, Dim>{});
}

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
class Sweep final : public TileSweep<Dim> {
 public:
  Sweep(const Gas& gas, const GridSettings& settings)
      : gas_(gas), flattening_(settings.flattening), smearing_(settings.smearing) {}

  TileResult<Dim> sweep(const Box<Dim>& box, const Tile<Dim>& tile, double dt, const Conserved<Dim>& now,
                        Conserved<Dim>& next, std::span<const std::uint8_t> flagged) override {
    if (flagged.empty()) return sweep_with<false>(box, tile, dt, now, next, flagged);
    return sweep_with<true>(box, tile, dt, now, next, flagged);
  }
  TileResult<Dim> look(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now) override {
    TileResult<Dim> result;
    result.uniform = true;
    for (int k = 0; k < tile.count[last]; ++k) judge(box, tile, now, k, result);
    return result;
  }
  std::size_t bytes() const override { return planes_.bytes() + sizeof row_; }

 private:
  using Planes = SweepPlanes<Dim, Gas>;
  using Sides = Side<Dim, Gas>;
  static constexpr int C = Planes::C, W = Planes::W, X = Planes::X, P = pressure_at<Dim>;
  static constexpr int halo = Planes::halo, last = Planes::last;

  /// Where a cell is in planes of states and fluxes, and in planes of cells.
  struct Place {
    std::ptrdiff_t at, cell;
    /// Of the cell before it along an axis; across the last axis that is in the plane below, at the same place.
    Place before(int axis) const {
      return axis == last ? *this : Place{at - Planes::step(axis), cell - Planes::cell_step(axis)};
    }
  };

  // sweep_cells.hpp
  template <bool Flagged>
  void load_plane(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now,
                  std::span<const std::uint8_t> flagged, int k);
  void update(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now, Conserved<Dim>& next, int k);
  [[gnu::noinline]] void judge(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& cells, int k,
                               TileResult<Dim>& result) const;
  void book(const Box<Dim>& box, const Tile<Dim>& tile, int k, double scale, TileResult<Dim>& result);

  // sweep_fluxes.hpp
  void predict(const Tile<Dim>& tile, int k);
  template <int axis>
  void first_fluxes(const Tile<Dim>& tile, int k);
  template <int axis>
  void sideways(const Tile<Dim>& tile, int k);
  template <bool Flagged, int axis>
  void final_fluxes(const Tile<Dim>& tile, int k);
  Sides side(int k, int axis, int upper, Place place);
  void change(Sides& s, V density, V& volume, const V (&d)[C], int k, Place place);
  template <int axis>
  void flux(const OuterWaves& waves, const Sides& l, const Sides& r, int below, Place before, int k, Place here,
            V (&f)[C]);

  /// Calls body(place, place among cells) for the cells [x0, x1) x [y0, y1) of a plane, a register at a time.
  template <class Body>
  [[gnu::always_inline]] static inline void for_cells(int x0, int x1, int y0, int y1, Body&& body) {
    for (int y = Dim == 3 ? y0 : 0; y < (Dim == 3 ? y1 : 1); ++y)
      for (int x = x0; x < x1; x += width) body(Planes::place(x, y), Planes::cell_place(x, y));
  }
  static int rows(const Tile<Dim>& tile) { return Dim == 3 ? tile.count[1] : 1; }
  /// Index of the first cell of a row of the tile.
  static std::size_t row_index(const Box<Dim>& box, const Tile<Dim>& tile, int y, int k) {
    std::array<int, Dim> cell = tile.begin;
    cell[last] += k;
    if constexpr (Dim == 3) cell[1] += y;
    return box.index(cell);
  }

  template <bool Flagged>
  TileResult<Dim> sweep_with(const Box<Dim>& box, const Tile<Dim>& tile, double dt, const Conserved<Dim>& now,
                             Conserved<Dim>& next, std::span<const std::uint8_t> flagged) {
    TileResult<Dim> result;
    result.uniform = true;
    whole_ = dt / box.spacing;
    half_ = 0.5 * whole_;
    const int n = tile.count[last];
    for (int k = -halo; k < 1; ++k) load_plane<Flagged>(box, tile, now, flagged, k);
    for (int k = -1; k <= n; ++k) {
      // Plane k gets its states and first fluxes, the faces below it their final ones, and plane k - 1 is done.
      load_plane<Flagged>(box, tile, now, flagged, k + 2);
      predict(tile, k);
      for_axes<Dim>([&](auto axis) { first_fluxes<axis>(tile, k); });
      for_axes<last>([&](auto axis) { sideways<axis>(tile, k); });
      if (k < 0) continue;
      final_fluxes<Flagged, last>(tile, k);
      if (k < 1) continue;
      sideways<last>(tile, k - 1);
      for_axes<last>([&](auto axis) { final_fluxes<Flagged, axis>(tile, k - 1); });
      update(box, tile, now, next, k - 1);
      judge(box, tile, next, k - 1, result);
      book(box, tile, k - 1, dt * box.face_area(), result);
    }
    return result;
  }

  Gas gas_;
  bool flattening_, smearing_;
  double half_ = 0, whole_ = 0;  ///< dt/(2 dx), dt/dx
  Planes planes_;
  std::array<std::array<double, Planes::cell_pitch>, C> row_{};  ///< conserved values, from -halo
};

}  // namespace ejecta::grid_detail
