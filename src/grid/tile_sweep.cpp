#include "grid/tile_sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "grid/reconstruction.hpp"
#include "grid/riemann_lanes.hpp"

namespace ejecta {

namespace grid_detail {

/// Calls body with std::integral_constant<int, a> of every axis: the loops over faces are compiled for theirs.
template <int Dim, class Body>
[[gnu::always_inline]] inline void for_axes(Body&& body) {
  [&]<int... a>(std::integer_sequence<int, a...>) __attribute__((always_inline)) {
    (body(std::integral_constant<int, a>{}), ...);
  }
  (std::make_integer_sequence<int, Dim>{});
}

/// The first lanes of a register from memory that ends there; the first value in the others.
inline V load_lanes(const double* p, int lanes) {
  if (lanes == width) return load(p);
  V v = V{} + p[0];
  for (int k = 0; k < lanes; ++k) v[k] = p[k];
  return v;
}

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
class Sweep final : public TileSweep<Dim> {
 public:
  Sweep(const Gas& gas, const Eos& eos, const GridSettings& settings)
      : gas_(gas), eos_(eos), flattening_(settings.flattening), smearing_(settings.smearing) {
    const auto shape = tile_shape<Dim>();
    pitch_ = shape[0] + 2 * halo + width;
    rows_ = Dim == 3 ? shape[1] + 2 * halo : 1;
    plane_ = static_cast<std::size_t>(pitch_ * rows_ + width);
    scratch_.assign(plane_ * (kept * cell_planes + kept_states * state_planes + 2 * flux_planes +
                              2 * static_cast<std::size_t>(C)) +
                        plane_ * static_cast<std::size_t>((Dim - 1) * C),
                    1.0);
    double* at = scratch_.data();
    const auto take = [&](std::size_t planes) {
      double* begin = at;
      at += planes * plane_;
      return begin;
    };
    for (auto& p : cells_) p = take(cell_planes);
    for (auto& p : states_) p = take(state_planes);
    for (auto& p : first_) p = take(flux_planes);
    for (auto& p : final_rolling_) p = take(C);
    final_ = take(static_cast<std::size_t>((Dim - 1) * C));
    row_.assign(static_cast<std::size_t>(C * pitch_), 1.0);
  }

  TileResult<Dim> sweep(const Box<Dim>& box, const Tile<Dim>& tile, double dt, const Conserved<Dim>& now,
                        Conserved<Dim>& next, std::span<const std::uint8_t> flagged) override {
    if (flagged.empty()) return sweep_with<false>(box, tile, dt, now, next, flagged);
    return sweep_with<true>(box, tile, dt, now, next, flagged);
  }
  TileResult<Dim> look(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now) override;
  std::size_t bytes() const override { return (scratch_.capacity() + row_.capacity()) * sizeof(double); }

 private:
  using Sides = Side<Dim, Gas>;
  static constexpr int C = conserved_count<Dim>, W = Sides::values, X = Gas::extras, P = pressure_at<Dim>;
  static constexpr int halo = 3, last = Dim - 1;  ///< the axis that the sweep runs along
  static constexpr std::size_t cell_planes = W + X + 1, state_planes = 2 * Dim * W + Dim, flux_planes = Dim * C;
  static constexpr std::size_t kept = 8, kept_states = 2;  ///< planes of cells; five are in use

  double* cells(int k) { return cells_[static_cast<std::size_t>(k + 8) % kept]; }
  double* cell_flag(int k) { return cell(k, W + X); }
  double* cell(int k, int value) { return cells(k) + static_cast<std::size_t>(value) * plane_; }
  /// Primitives at the upper (or lower) face across `axis` of the cells of plane k.
  double* state(int k, int axis, int upper, int value) {
    return states_[static_cast<std::size_t>(k + 2) % 2] +
           static_cast<std::size_t>((axis * 2 + upper) * W + value) * plane_;
  }
  /// 1 in the cells of plane k that a strong shock along `axis` runs through, else 0.
  double* strong(int k, int axis) {
    return states_[static_cast<std::size_t>(k + 2) % 2] + static_cast<std::size_t>(2 * Dim * W + axis) * plane_;
  }
  double* first(int k, int axis, int value) {
    return first_[static_cast<std::size_t>(k + 2) % 2] + static_cast<std::size_t>(axis * C + value) * plane_;
  }
  double* final_of(int k, int axis, int value) {
    if (axis == last) return final_rolling_[static_cast<std::size_t>(k + 2) % 2] + static_cast<std::size_t>(value) * plane_;
    return final_ + static_cast<std::size_t>(axis * C + value) * plane_;
  }
  std::ptrdiff_t step(int axis) const { return axis == 0 ? 1 : pitch_; }
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(x + halo + (Dim == 3 ? (y + halo) * pitch_ : 0));
  }
  /// Calls body(place) for all cells [x0, x1) x [y0, y1) of a plane, a register at a time.
  template <class Body>
  [[gnu::always_inline]] inline void for_cells(int x0, int x1, int y0, int y1, Body&& body) const {
    for (int y = Dim == 3 ? y0 : 0; y < (Dim == 3 ? y1 : 1); ++y)
      for (int x = x0; x < x1; x += width) body(place(x, y));
  }

  template <bool Flagged>
  void load_plane(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now,
                  std::span<const std::uint8_t> flagged, int k);
  void to_primitives(std::size_t begin, int count, int k);
  void predict(const Tile<Dim>& tile, int k);
  [[gnu::always_inline]] inline Sides side(int k, int axis, int upper, std::size_t at) {
    Sides s;
    for (int v = 0; v < W; ++v) s.w[v] = load(state(k, axis, upper, v) + at);
    for (int v = 0; v < X; ++v) s.x[v] = load(cell(k, W + v) + at);
    return s;
  }
  /// Through faces across an axis between the cells at `before` of plane `below` and at `at` of plane k. A flux that
  /// keeps contacts keeps apart the rows that a shock runs along, and they drift apart [Quirk 1994]: there, it is one
  /// that smears.
  template <int axis>
  [[gnu::always_inline]] inline void flux(const Sides& l, const Sides& r, int below, std::size_t before, int k,
                                          std::size_t at, V (&f)[C]) {
    if constexpr (solver == RiemannSolver::exact)
      exact_flux<Dim, axis>(gas_, l, r, f);
    else
      hllc<Dim, axis>(gas_, l, r, f);
    V along{};
    for (int other = 0; other < Dim; ++other)
      if (other != axis)
        along = simd::max(along, simd::max(load(strong(below, other) + before), load(strong(k, other) + at)));
    if (!simd::any_less(V{}, along)) return;
    V smeared[C];
    hll<Dim, axis>(gas_, l, r, smeared);
    for (int c = 0; c < C; ++c) f[c] = along > 0 ? smeared[c] : f[c];
  }
  template <int axis>
  void first_fluxes(const Tile<Dim>& tile, int k);
  template <bool Flagged, int axis>
  void final_fluxes(const Tile<Dim>& tile, int k);
  /// What crosses the faces of a cell sideways within half a step changes its states at the faces across `axis`.
  template <int axis>
  [[gnu::always_inline]] inline void change(Sides& s, int k, std::size_t at) {
    V d[C] = {};
    for_axes<Dim>([&](auto other) __attribute__((always_inline)) {
      if constexpr (other != axis)
        for (int c = 0; c < C; ++c) {
          const V in = load(first(k, other, c) + at);
          const V out = other == last ? load(first(k + 1, other, c) + at)
                                      : load(first(k, other, c) + at + step(other));
          d[c] -= half_ * (out - in);
        }
    });
    Sides after = s;
    gas_.template changed<Dim>(after.w, s.x, d);
    keep_positive(after.w, s.w);
    s = after;
  }
  /// `w` where it is possible, else `otherwise`.
  [[gnu::always_inline]] static inline void keep_positive(V* w, const V* otherwise) {
    auto possible = w[0] > 0;
    if constexpr (Gas::always_positive) possible = possible & (w[P] > 0);
    for (int v = 0; v < W; ++v) w[v] = possible ? w[v] : otherwise[v];
  }
  void update(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now, Conserved<Dim>& next, int k,
              TileResult<Dim>& result);
  /// Not inlined: a look at a restart must give the same bits as a step.
  [[gnu::noinline]] void judge(const V (&u)[C], int lanes, std::size_t index, TileResult<Dim>& result);
  void book(const Box<Dim>& box, const Tile<Dim>& tile, int k, double scale, TileResult<Dim>& result);
  template <bool Flagged>
  TileResult<Dim> sweep_with(const Box<Dim>& box, const Tile<Dim>& tile, double dt, const Conserved<Dim>& now,
                             Conserved<Dim>& next, std::span<const std::uint8_t> flagged);

  Gas gas_;
  const Eos& eos_;
  bool flattening_, smearing_;
  int pitch_, rows_;
  std::size_t plane_;
  double half_ = 0, whole_ = 0;  ///< dt/(2 dx), dt/dx
  std::array<double, C> reference_{};  ///< the first cell of the tile, at the end of the step
  std::vector<double> scratch_, row_;
  std::array<double*, kept> cells_{};
  std::array<double*, 2> states_{}, first_{}, final_rolling_{};
  double* final_ = nullptr;
};

/// Conserved values of plane k with a halo, those beyond the box from where its faces say, as primitives.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <bool Flagged>
void Sweep<Dim, Gas, limiter, solver>::load_plane(const Box<Dim>& box, const Tile<Dim>& tile,
                                                  const Conserved<Dim>& now, std::span<const std::uint8_t> flagged,
                                                  int k) {
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
    for (int c = 0; c < C; ++c) {
      const double* from = now[static_cast<std::size_t>(c)].data() + source;
      double* to = row_.data() + c * pitch_ + halo;
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
    const std::size_t begin = place(-halo, y);
    to_primitives(begin, nx + 2 * halo, k);
    if constexpr (Flagged) {
      double* flag = cell_flag(k) + begin;
      for (int x = -halo; x < nx + halo; ++x)
        flag[x + halo] = flagged[source + static_cast<std::size_t>(source_along(box, 0, x_begin + x).cell)];
    }
  }
}

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::to_primitives(std::size_t begin, int count, int k) {
  if constexpr (!Gas::carries_energy) {
    for (int x = 0; x < count; x += width) {
      V u[C], w[W];
      for (int c = 0; c < C; ++c) u[c] = load(row_.data() + c * pitch_ + x);
      gas_.template from_conserved<Dim>(u, w);
      for (int v = 0; v < W; ++v) store(cell(k, v) + begin + x, w[v]);
    }
  } else {
    std::visit(
        [&](const auto& eos) {
          for (int x = 0; x < count; ++x) {
            const auto u = [&](int c) { return row_[static_cast<std::size_t>(c * pitch_ + x)]; };
            const std::size_t at = begin + static_cast<std::size_t>(x);
            const double density = u(0);
            double kinetic = 0;
            for (int a = 0; a < Dim; ++a) {
              const double velocity = u(1 + a) / density;
              cell(k, 1 + a)[at] = velocity;
              kinetic += 0.5 * u(1 + a) * velocity;
            }
            const double e = (u(Dim + 1) - kinetic) / density;
            const EosPoint point = eos.evaluate(density, e);
            const double c = sound_speed(point, density, eos.sound_speed_floor());
            cell(k, 0)[at] = density;
            cell(k, P)[at] = point.pressure;
            cell(k, Dim + 2)[at] = e;
            cell(k, W)[at] = c * c;
            cell(k, W + 1)[at] = point.dP_drho;
            cell(k, W + 2)[at] = point.dP_de;
          }
        },
        eos_);
  }
}

/// Primitives at both faces of each cell across each axis, half a step on, by what happens along that axis alone.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::predict(const Tile<Dim>& tile, int k) {
  for_cells(-1, tile.count[0] + 1, -1, Dim == 3 ? tile.count[1] + 1 : 1, [&](std::size_t at) __attribute__((always_inline)) {
    // A value of the cell n places along an axis.
    const auto neighbour = [&](int value, int axis, int n) {
      return axis == last ? load(cell(k + n, value) + at) : load(cell(k, value) + at + n * step(axis));
    };
    V w[W], x[X > 0 ? X : 1], flat = V{} + 1;
    for (int v = 0; v < W; ++v) w[v] = load(cell(k, v) + at);
    for (int v = 0; v < X; ++v) x[v] = load(cell(k, W + v) + at);
    for (int a = 0; a < Dim; ++a) {
      const Shock shock = shock_of(neighbour(P, a, -2), neighbour(P, a, -1), neighbour(P, a, 1), neighbour(P, a, 2),
                                   neighbour(1 + a, a, -1), neighbour(1 + a, a, 1));
      if (flattening_) flat = simd::min(flat, shock.flat);
      store(strong(k, a) + at, smearing_ ? shock.strong : V{});
    }
    const V volume = simd::reciprocal(w[0]), stiffness = w[0] * gas_.template sound2<Dim>(w, x, volume);
    for_axes<Dim>([&](auto axis) __attribute__((always_inline)) {
      constexpr int a = axis;
      V s[W], upper[W], lower[W];
      for (int v = 0; v < W; ++v) s[v] = flat * slope<limiter>(w[v] - neighbour(v, a, -1), neighbour(v, a, 1) - w[v]);
      const V u = w[1 + a], closing = s[1 + a];
      const auto put = [&](int v, V rate) {
        const V middle = w[v] - half_ * rate;
        upper[v] = middle + 0.5 * s[v];
        lower[v] = middle - 0.5 * s[v];
      };
      put(0, u * s[0] + w[0] * closing);
      for (int b = 0; b < Dim; ++b) put(1 + b, a == b ? u * closing + s[P] * volume : u * s[1 + b]);
      put(P, u * s[P] + stiffness * closing);
      if constexpr (Gas::carries_energy) put(Dim + 2, u * s[Dim + 2] + w[P] * volume * closing);
      keep_positive(upper, w);
      keep_positive(lower, w);
      for (int v = 0; v < W; ++v) {
        store(state(k, a, 1, v) + at, upper[v]);
        store(state(k, a, 0, v) + at, lower[v]);
      }
    });
  });
}

/// Of the states that know their own axis alone: through the lower faces of plane k.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <int a>
void Sweep<Dim, Gas, limiter, solver>::first_fluxes(const Tile<Dim>& tile, int k) {
  const int nx = tile.count[0], ny = Dim == 3 ? tile.count[1] : 1;
  if (a == last && k < 0) return;  // nobody asks
  const int below = a == last ? k - 1 : k;
  const std::ptrdiff_t back = a == last ? 0 : -step(a);
  for_cells(a == 0 ? 0 : -1, nx + 1, a == 1 && a != last ? 0 : -1, ny + 1,
            [&](std::size_t at) __attribute__((always_inline)) {
              V f[C];
              const std::size_t before = at + static_cast<std::size_t>(back);
              flux<a>(side(below, a, 1, before), side(k, a, 0, at), below, before, k, at, f);
              for (int c = 0; c < C; ++c) store(first(k, a, c) + at, f[c]);
            });
}

/// Through the lower faces across an axis of plane k.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <bool Flagged, int a>
void Sweep<Dim, Gas, limiter, solver>::final_fluxes(const Tile<Dim>& tile, int k) {
  const int nx = tile.count[0] + (a == 0 ? 1 : 0), ny = Dim == 3 ? tile.count[1] + (a == 1 ? 1 : 0) : 1;
  const int below = a == last ? k - 1 : k;
  const std::ptrdiff_t back = a == last ? 0 : -step(a);
  for_cells(0, nx, 0, ny, [&](std::size_t at) __attribute__((always_inline)) {
    const std::size_t before = at + static_cast<std::size_t>(back);
    Sides l = side(below, a, 1, before), r = side(k, a, 0, at);
    change<a>(l, below, before);
    change<a>(r, k, at);
    if constexpr (Flagged) {
      const auto flagged = simd::max(load(cell_flag(below) + before), load(cell_flag(k) + at)) > 0;
      for (int v = 0; v < W; ++v) {
        l.w[v] = flagged ? load(cell(below, v) + before) : l.w[v];
        r.w[v] = flagged ? load(cell(k, v) + at) : r.w[v];
      }
    }
    V f[C];
    flux<a>(l, r, below, before, k, at, f);
    for (int c = 0; c < C; ++c) store(final_of(k, a, c) + at, f[c]);
  });
}

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::update(const Box<Dim>& box, const Tile<Dim>& tile, const Conserved<Dim>& now,
                                              Conserved<Dim>& next, int k, TileResult<Dim>& result) {
  const int nx = tile.count[0], ny = Dim == 3 ? tile.count[1] : 1;
  for (int y = 0; y < ny; ++y) {
    std::array<int, Dim> first_cell = tile.begin;
    first_cell[last] += k;
    if constexpr (Dim == 3) first_cell[1] += y;
    const std::size_t row = box.index(first_cell);
    for (int x = 0; x < nx; x += width) {
      const int lanes = std::min(width, nx - x);
      const std::size_t at = place(x, y), index = row + static_cast<std::size_t>(x);
      V u[C];
      for (int c = 0; c < C; ++c) {
        u[c] = load_lanes(now[static_cast<std::size_t>(c)].data() + index, lanes);
        V change{};
        for (int a = 0; a < Dim; ++a) {
          const V in = load(final_of(k, a, c) + at);
          const V out = a == last ? load(final_of(k + 1, a, c) + at) : load(final_of(k, a, c) + at + step(a));
          change += out - in;
        }
        u[c] -= whole_ * change;
        double* to = next[static_cast<std::size_t>(c)].data() + index;
        if (lanes == width)
          store(to, u[c]);
        else
          for (int i = 0; i < lanes; ++i) to[i] = u[c][i];
      }
      if (k == 0 && y == 0 && x == 0)
        for (int c = 0; c < C; ++c) reference_[static_cast<std::size_t>(c)] = u[c][0];
      judge(u, lanes, index, result);
    }
  }
}

/// Whether new states make sense, how fast signals are in them, and whether they differ from the first one.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::judge(const V (&u)[C], int lanes, std::size_t index, TileResult<Dim>& result) {
  const unsigned all = (1u << lanes) - 1;
  V differs{};
  for (int c = 0; c < C; ++c) differs = simd::max(differs, simd::magnitude(V(u[c] - reference_[static_cast<std::size_t>(c)])));
  if (simd::lanes_less(V{}, differs) & all) result.uniform = false;
  V w[W], x[X > 0 ? X : 1];
  V squares{};
  for (int a = 0; a < Dim; ++a) squares += u[1 + a] * u[1 + a];
  const V inner = u[Dim + 1] * u[0] - 0.5 * squares;  // times the density
  unsigned good = simd::lanes_less(V{}, u[0]) & all;
  if constexpr (Gas::always_positive) good &= simd::lanes_less(V{}, inner);
  else good &= simd::lanes_less(V{} - 1e300, inner);  // a number at all
  for (unsigned bad = all & ~good; bad != 0; bad &= bad - 1)
    result.bad.push_back(index + static_cast<std::size_t>(std::countr_zero(bad)));
  if (good != all) return;
  V sound;
  if constexpr (!Gas::carries_energy) {
    gas_.template from_conserved<Dim>(u, w);
    sound = simd::square_root(gas_.template sound2<Dim>(w, x, simd::reciprocal(w[0])));
  } else {
    for (int a = 0; a < Dim; ++a) w[1 + a] = u[1 + a] * simd::reciprocal(u[0]);
    sound = V{};
    std::visit(
        [&](const auto& eos) {
          for (int i = 0; i < lanes; ++i) {
            const EosPoint point = eos.evaluate(u[0][i], inner[i] / (u[0][i] * u[0][i]));
            sound[i] = ejecta::sound_speed(point, u[0][i], eos.sound_speed_floor());
          }
        },
        eos_);
  }
  V speed{};
  for (int a = 0; a < Dim; ++a) speed = simd::max(speed, simd::magnitude(w[1 + a]));
  speed += sound;
  if (!(simd::lanes_less(V{} + result.fastest, speed) & all)) return;
  for (int i = 0; i < lanes; ++i)
    if (speed[i] > result.fastest) {
      result.fastest = speed[i];
      result.where = index + static_cast<std::size_t>(i);
    }
}

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
TileResult<Dim> Sweep<Dim, Gas, limiter, solver>::look(const Box<Dim>& box, const Tile<Dim>& tile,
                                                       const Conserved<Dim>& now) {
  TileResult<Dim> result;
  result.uniform = true;
  const std::size_t begin = box.index(tile.begin);
  for (int c = 0; c < C; ++c) reference_[static_cast<std::size_t>(c)] = now[static_cast<std::size_t>(c)][begin];
  for (int k = 0; k < tile.count[last]; ++k)
    for (int y = 0; y < (Dim == 3 ? tile.count[1] : 1); ++y) {
      std::array<int, Dim> cell = tile.begin;
      cell[last] += k;
      if constexpr (Dim == 3) cell[1] += y;
      const std::size_t row = box.index(cell);
      for (int x = 0; x < tile.count[0]; x += width) {
        V u[C];
        const int lanes = std::min(width, tile.count[0] - x);
        for (int c = 0; c < C; ++c) u[c] = load_lanes(now[static_cast<std::size_t>(c)].data() + row + x, lanes);
        judge(u, lanes, row + static_cast<std::size_t>(x), result);
      }
    }
  return result;
}

/// What passes through the faces of plane k that are faces of the box.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::book(const Box<Dim>& box, const Tile<Dim>& tile, int k, double scale,
                                            TileResult<Dim>& result) {
  const int nx = tile.count[0], ny = Dim == 3 ? tile.count[1] : 1;
  const auto add = [&](int plane, int axis, int x0, int x1, int y0, int y1, double sign) {
    for (int c = 0; c < C; ++c) {
      const double* f = final_of(plane, axis, c);
      double sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += f[place(x, y)];
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

template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <bool Flagged>
TileResult<Dim> Sweep<Dim, Gas, limiter, solver>::sweep_with(const Box<Dim>& box, const Tile<Dim>& tile, double dt,
                                                             const Conserved<Dim>& now, Conserved<Dim>& next,
                                                             std::span<const std::uint8_t> flagged) {
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
    if (k >= 0) final_fluxes<Flagged, last>(tile, k);
    if (k < 1) continue;
    for_axes<last>([&](auto axis) { final_fluxes<Flagged, axis>(tile, k - 1); });
    update(box, tile, now, next, k - 1, result);
    book(box, tile, k - 1, dt * box.face_area(), result);
  }
  return result;
}

template <int Dim, class Gas, SlopeLimiter limiter>
std::unique_ptr<TileSweep<Dim>> with_solver(const Gas& gas, const Eos& eos, const GridSettings& settings) {
  if (settings.riemann == RiemannSolver::hllc)
    return std::make_unique<Sweep<Dim, Gas, limiter, RiemannSolver::hllc>>(gas, eos, settings);
  if constexpr (Gas::carries_energy)
    throw InputError("grid.riemann: expected hllc, got exact, which is known for ideal gases alone");
  else
    return std::make_unique<Sweep<Dim, Gas, limiter, RiemannSolver::exact>>(gas, eos, settings);
}

template <int Dim, class Gas>
std::unique_ptr<TileSweep<Dim>> with_gas(const Gas& gas, const Eos& eos, const GridSettings& settings) {
  if (settings.limiter == SlopeLimiter::none) return with_solver<Dim, Gas, SlopeLimiter::none>(gas, eos, settings);
  if (settings.limiter == SlopeLimiter::minmod) return with_solver<Dim, Gas, SlopeLimiter::minmod>(gas, eos, settings);
  return with_solver<Dim, Gas, SlopeLimiter::monotonised_central>(gas, eos, settings);
}

}  // namespace grid_detail

template <int Dim>
std::unique_ptr<TileSweep<Dim>> make_tile_sweep(const Eos& eos, const GridSettings& settings) {
  using namespace grid_detail;
  return std::visit(
      [&](const auto& e) {
        if constexpr (requires { IdealLanes(e); })
          return with_gas<Dim>(IdealLanes(e), eos, settings);
        else
          return with_gas<Dim>(GeneralLanes(eos), eos, settings);
      },
      eos);
}

template <int Dim>
CellState<Dim> cell_state(const Eos& eos, const Conserved<Dim>& cells, std::size_t i) {
  CellState<Dim> s{};
  s.density = cells[0][i];
  for (int a = 0; a < Dim; ++a) s.velocity[a] = cells[static_cast<std::size_t>(1 + a)][i] / s.density;
  s.specific_energy = cells[Dim + 1][i] / s.density - 0.5 * s.velocity.squaredNorm();
  std::visit(
      [&](const auto& e) {
        const EosPoint point = e.evaluate(s.density, s.specific_energy);
        s.pressure = point.pressure;
        s.sound_speed = sound_speed(point, s.density, e.sound_speed_floor());
      },
      eos);
  return s;
}

template std::unique_ptr<TileSweep<2>> make_tile_sweep<2>(const Eos&, const GridSettings&);
template std::unique_ptr<TileSweep<3>> make_tile_sweep<3>(const Eos&, const GridSettings&);
template CellState<2> cell_state<2>(const Eos&, const Conserved<2>&, std::size_t);
template CellState<3> cell_state<3>(const Eos&, const Conserved<3>&, std::size_t);

}  // namespace ejecta
