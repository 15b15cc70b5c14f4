#pragma once
/// Sweep: from the cells of the box to primitives, and from fluxes to new cells.
#include "grid/sweep.hpp"

namespace ejecta::grid_detail {

/// Calls body(x, lanes) for a row of n cells, a register at a time. The last one may overlap with the one before,
/// which does no harm where the same is read and written twice; only a row shorter than a register has less lanes.
template <class Body>
[[gnu::always_inline]] inline void for_row(int n, Body&& body) {
  for (int x = 0; x + width <= n; x += width) body(x, width);
  if (n % width != 0) body(std::max(0, n - width), std::min(n, width));
}

/// The first lanes of a register from memory that ends there; the first value in the others.
inline V load_lanes(const double* p, int lanes) {
  if (lanes == width) return load(p);
  V v = V{} + p[0];
  for (int k = 0; k < lanes; ++k) v[k] = p[k];
  return v;
}

/// Asks for a row of memory that will be needed: rows of tiles are too short for the processor to see that they go
/// on.
template <bool writes>
inline void prefetch(const double* begin, int count) {
  constexpr int line = 64 / sizeof(double);
  for (int k = 0; k < count + line - 1; k += line) __builtin_prefetch(begin + k, writes, 2);
}

/// Conserved values of plane k with a halo, those beyond the box from where its faces say, as primitives.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <bool Flagged>
void Sweep<Dim, Gas, limiter, solver>::load_plane(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now,
                                                  std::span<const std::uint8_t> flagged, int k) {
  const CellSource along = source_along(box, last, tile.begin[last] + k);
  const int nx = tile.count[0], x_begin = tile.begin[0];
  const int inside_from = std::max(-halo, -x_begin), inside_to = std::min(nx + halo, box.cells[0] - x_begin);
  const int y_from = Dim == 3 ? -halo : 0, y_to = Dim == 3 ? tile.count[1] + halo : 1;
  for (int y = y_from; y < y_to; ++y) {
    std::array<int, Dim> cell{};
    cell[last] = along.cell;
    double sign[C];
    std::fill_n(sign, C, 1.0);
    if (along.mirrored) sign[1 + last] = -1;
    if constexpr (Dim == 3) {
      const CellSource across = source_along(box, 1, tile.begin[1] + y);
      cell[1] = across.cell;
      if (across.mirrored) sign[2] = -1;
    }
    const std::size_t source = box.index(cell);  // of the first cell of the row
    cell[last] = std::min(cell[last] + 1, box.cells[last] - 1);
    const std::size_t ahead = box.index(cell);
    for (int c = 0; c < C; ++c) {
      const double* column = now[static_cast<std::size_t>(c)].data();
      prefetch<false>(column + ahead + x_begin + inside_from, inside_to - inside_from);
      const double* from = column + source;
      double* to = row_[static_cast<std::size_t>(c)].data() + halo;
      if (sign[c] == 1)
        std::copy(from + x_begin + inside_from, from + x_begin + inside_to, to + inside_from);
      else
        for (int x = inside_from; x < inside_to; ++x) to[x] = -from[x_begin + x];
      const auto beyond = [&](int x) {
        const CellSource s = source_along(box, 0, x_begin + x);
        to[x] = (c == 1 && s.mirrored ? -sign[c] : sign[c]) * from[s.cell];
      };
      for (int x = -halo; x < inside_from; ++x) beyond(x);
      for (int x = inside_to; x < nx + halo; ++x) beyond(x);
    }
    const std::ptrdiff_t begin = Planes::cell_place(-halo, y);
    for (int i = 0; i < nx + 2 * halo; i += width) {
      V u[C], w[W], x[X];
      for (int c = 0; c < C; ++c) u[c] = load(row_[static_cast<std::size_t>(c)].data() + i);
      gas_.template primitives<Dim>(u, w, x);
      for (int v = 0; v < W; ++v) store(planes_.cell(k, v) + begin + i, w[v]);
      for (int v = 0; v < X; ++v) store(planes_.cell(k, W + v) + begin + i, x[v]);
    }
    if constexpr (Flagged) {
      double* flag = planes_.flag(k) + begin;
      for (int x = -halo; x < nx + halo; ++x)
        flag[x + halo] = flagged[source + static_cast<std::size_t>(source_along(box, 0, x_begin + x).cell)];
    }
  }
}

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::update(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now,
                                              Conserved<Dim>& next, int k) {
  const int nx = tile.count[0];
  for (int y = 0; y < rows(tile); ++y) {
    const std::size_t row = row_index(box, tile, y, k);
    const std::ptrdiff_t place = Planes::place(0, y);
    const std::size_t ahead = row_index(box, tile, y, std::min(k + 1, tile.count[last] - 1));
    for (int c = 0; c < C; ++c) {
      prefetch<true>(next[static_cast<std::size_t>(c)].data() + ahead, nx);
      const double* from = now[static_cast<std::size_t>(c)].data() + row;
      double* to = next[static_cast<std::size_t>(c)].data() + row;
      const auto renew = [&](int x, int lanes) __attribute__((always_inline)) {
        V change{};
        for (int a = 0; a < Dim; ++a) {
          const double* in = planes_.final(k, a, c) + place + x;
          change += load(a == last ? planes_.final(k + 1, a, c) + place + x : in + Planes::step(a)) - load(in);
        }
        const V u = load_lanes(from + x, lanes) - whole_ * change;
        if (lanes == width)
          store(to + x, u);
        else
          for (int i = 0; i < lanes; ++i) to[x + i] = u[i];
      };
      for_row(nx, renew);
    }
  }
}

/// Whether states of plane k make sense, how fast signals are in them, and whether they differ from the first of the
/// tile. Not inlined: a look at a restart must give the same bits as a step.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::judge(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& cells,
                                             int k, TileResult<Dim>& result) const {
  const int nx = tile.count[0];
  const std::size_t first = box.index(tile.begin);
  V differs{};
  for (int y = 0; y < rows(tile); ++y) {
    const auto one = [&](int x, int lanes) __attribute__((always_inline)) {
      const unsigned all = (1u << lanes) - 1;
      const std::size_t index = row_index(box, tile, y, k) + static_cast<std::size_t>(x);
      V u[C], w[W], extra[X], squares{};
      for (int c = 0; c < C; ++c) {
        const double* column = cells[static_cast<std::size_t>(c)].data();
        u[c] = load_lanes(column + index, lanes);
        differs = simd::max(differs, simd::magnitude(V(u[c] - column[first])));
      }
      for (int a = 0; a < Dim; ++a) squares += u[1 + a] * u[1 + a];
      const V inner = u[Dim + 1] * u[0] - 0.5 * squares;           // times the density
      constexpr double least = Gas::always_positive ? 0 : -1e300;  // a number at all
      const unsigned good = simd::lanes_less(V{}, u[0]) & simd::lanes_less(V{} + least, inner) & all;
      for (unsigned bad = all & ~good; bad != 0; bad &= bad - 1)
        result.bad.push_back(index + static_cast<std::size_t>(std::countr_zero(bad)));
      if (good != all) return;
      gas_.template primitives<Dim>(u, w, extra);
      V speed{};
      for (int a = 0; a < Dim; ++a) speed = simd::max(speed, simd::magnitude(w[1 + a]));
      speed += simd::square_root(extra[0]);
      if (!(simd::lanes_less(V{} + result.fastest, speed) & all)) return;
      for (int i = 0; i < lanes; ++i)
        if (speed[i] > result.fastest) {
          result.fastest = speed[i];
          result.where = index + static_cast<std::size_t>(i);
        }
    };
    for_row(nx, one);
  }
  // Lanes beyond the row hold its first value.
  if (simd::any_less(V{}, differs)) result.uniform = false;
}

/// What passes through the faces of plane k that are faces of the box.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::book(const Box<Dim>& box, const Tile<Dim>& tile, int k, double scale,
                                            TileResult<Dim>& result) {
  const int nx = tile.count[0], ny = rows(tile);
  const auto add = [&](int plane, int axis, int x0, int x1, int y0, int y1, double sign) {
    for (int c = 0; c < C; ++c) {
      const double* f = planes_.final(plane, axis, c);
      double sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += f[Planes::place(x, y)];
      result.outflow[static_cast<std::size_t>(c)] += sign * scale * sum;
    }
  };
  for (int a = 0; a < Dim; ++a) {
    const auto i = static_cast<std::size_t>(a);
    if (box.lower[i] == BoundaryKind::periodic) continue;
    const bool at_lower = tile.begin[i] == 0, at_upper = tile.begin[i] + tile.count[i] == box.cells[i];
    if (a == last) {
      if (at_lower && k == 0) add(0, a, 0, nx, 0, ny, -1);
      if (at_upper && k == tile.count[last] - 1) add(k + 1, a, 0, nx, 0, ny, 1);
    } else if (a == 0) {
      if (at_lower) add(k, a, 0, 1, 0, ny, -1);
      if (at_upper) add(k, a, nx, nx + 1, 0, ny, 1);
    } else {
      if (at_lower) add(k, a, 0, nx, 0, 1, -1);
      if (at_upper) add(k, a, 0, nx, ny, ny + 1, 1);
    }
  }
}

}  // namespace ejecta::grid_detail
