#pragma once
/// Sweep: from primitives to fluxes.
#include "grid/sweep.hpp"

namespace ejecta::grid_detail {

/// What is not possible of `w` becomes `otherwise`.
template <int Dim, class Gas>
[[gnu::always_inline]] inline void keep_positive(V* w, const V* otherwise) {
  const V least = Gas::always_positive ? simd::min(w[0], w[pressure_at<Dim>]) : w[0];
  if (simd::lanes_less(V{}, least) == (1u << width) - 1) return;
  for (int v = 0; v < Side<Dim, Gas>::values; ++v) w[v] = least > 0 ? w[v] : otherwise[v];
}

/// `value` where it is positive.
[[gnu::always_inline]] inline V positive(V value, V otherwise) { return value > 0 ? value : otherwise; }

/// Primitives at both faces of each cell across each axis, half a step on, by what happens along that axis alone.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
void Sweep<Dim, Gas, limiter, solver>::predict(const Tile<Dim>& tile, int k) {
  const auto states = [&](std::ptrdiff_t at, std::ptrdiff_t cell) __attribute__((always_inline)) {
    // A value of the cell n places along an axis.
    const auto neighbour = [&](int value, int axis, int n) {
      return axis == last ? load(planes_.cell(k + n, value) + cell)
                          : load(planes_.cell(k, value) + cell + n * Planes::cell_step(axis));
    };
    V w[W], flat = V{} + 1, strong[Dim];
    for (int v = 0; v < W; ++v) w[v] = load(planes_.cell(k, v) + cell);
    if (smearing_ || flattening_)
      for (int a = 0; a < Dim; ++a) {
        const V p_1 = neighbour(P, a, -1), p1 = neighbour(P, a, 1);
        strong[a] = strong_shock(p_1, p1, neighbour(1 + a, a, -1), neighbour(1 + a, a, 1));
        if (flattening_) flat = simd::min(flat, flatness(strong[a], neighbour(P, a, -2), p_1, p1, neighbour(P, a, 2)));
      }
    if (smearing_)
      for (int a = 0; a < Dim; ++a) {
        V others{};
        for (int b = 0; b < Dim; ++b)
          if (b != a) others = simd::max(others, strong[b]);
        store(planes_.beside(k, a) + at, others);
      }
    const V volume = simd::reciprocal(w[0]), stiffness = w[0] * load(planes_.cell(k, W) + cell);
    for_axes<Dim>([&](auto axis) __attribute__((always_inline)) {
      constexpr int a = axis;
      V s[W], upper[W], lower[W];  // s: half slopes
      for (int v = 0; v < W; ++v) s[v] = half_slope<limiter>(w[v] - neighbour(v, a, -1), neighbour(v, a, 1) - w[v]);
      if (flattening_)
        for (int v = 0; v < W; ++v) s[v] *= flat;
      const V u = whole_ * w[1 + a], closing = whole_ * s[1 + a];
      const auto put = [&](int v, V change) {
        const V middle = w[v] - change;
        upper[v] = middle + s[v];
        lower[v] = middle - s[v];
      };
      put(0, u * s[0] + w[0] * closing);
      for (int b = 0; b < Dim; ++b) put(1 + b, a == b ? u * s[1 + a] + whole_ * volume * s[P] : u * s[1 + b]);
      put(P, u * s[P] + stiffness * closing);
      if constexpr (Gas::carries_energy) put(Dim + 2, u * s[Dim + 2] + w[P] * volume * closing);
      keep_positive<Dim, Gas>(upper, w);
      keep_positive<Dim, Gas>(lower, w);
      for (int v = 0; v < W; ++v) {
        store(planes_.state(k, a, 1, v) + at, upper[v]);
        store(planes_.state(k, a, 0, v) + at, lower[v]);
      }
    });
  };
  for_cells(-1, tile.count[0] + 1, -1, rows(tile) + 1, states);
}

/// A state at a face: that of plane k across `axis` as it was predicted.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
[[gnu::always_inline]] inline Side<Dim, Gas> Sweep<Dim, Gas, limiter, solver>::side(int k, int axis, int upper,
                                                                                    Place place) {
  Sides s;
  for (int v = 0; v < W; ++v) s.w[v] = load(planes_.state(k, axis, upper, v) + place.at);
  s.c2 = load(planes_.cell(k, W) + place.cell);
  return s;
}

/// What crosses a cell sideways within half a step changes its state at a face across `axis`, unless that would not
/// stay positive. `volume` is 1/rho of what comes out.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
[[gnu::always_inline]] inline void Sweep<Dim, Gas, limiter, solver>::change(Sides& s, V density, V& volume,
                                                                            const V (&d)[C], int k, Place place) {
  V x[X], w[W];
  for (int v = 0; v < X; ++v) x[v] = load(planes_.cell(k, W + v) + place.cell);
  for (int v = 0; v < W; ++v) w[v] = s.w[v];
  gas_.template changed<Dim>(w, x, volume, d);
  const V new_density = s.w[0] + d[0], least = Gas::always_positive ? simd::min(new_density, w[P]) : new_density;
  if (simd::lanes_less(V{}, least) != (1u << width) - 1) {
    for (int v = 1; v < W; ++v) w[v] = least > 0 ? w[v] : s.w[v];
    volume = least > 0 ? volume : simd::reciprocal(s.w[0]);
    density = least > 0 ? density : s.w[0];
  }
  s.w[0] = density;
  for (int v = 1; v < W; ++v) s.w[v] = w[v];
}

/// Through the faces between the cells at `before` of plane `below` and at `here` of plane k. A flux that keeps
/// contacts keeps apart the rows that a shock runs along, and they drift apart [Quirk 1994]: there, it is one that
/// smears.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <int axis>
[[gnu::always_inline]] inline void Sweep<Dim, Gas, limiter, solver>::flux(const OuterWaves& waves, const Sides& l,
                                                                          const Sides& r, int below, Place before,
                                                                          int k, Place here, V (&f)[C]) {
  if constexpr (solver == RiemannSolver::exact)
    exact_flux<Dim, axis>(gas_, l, r, f);
  else
    hllc<Dim, axis>(gas_, waves, l, r, f);
  if (!smearing_) return;
  const V shock = simd::max(load(planes_.beside(below, axis) + before.at), load(planes_.beside(k, axis) + here.at));
  if (!simd::any_less(V{}, shock)) return;
  V smeared[C];
  hll<Dim, axis>(gas_, waves, l, r, smeared);
  for (int c = 0; c < C; ++c) f[c] = shock > 0 ? smeared[c] : f[c];
}

/// Of the states that know their own axis alone: through the lower faces of plane k.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <int a>
void Sweep<Dim, Gas, limiter, solver>::first_fluxes(const Tile<Dim>& tile, int k) {
  if (a == last && k < 0) return;  // nobody asks
  const int below = a == last ? k - 1 : k;
  const auto fluxes = [&](std::ptrdiff_t at, std::ptrdiff_t cell) __attribute__((always_inline)) {
    const Place here{at, cell}, before = here.before(a);
    const Sides l = side(below, a, 1, before), r = side(k, a, 0, here);
    V f[C];
    const V per_both = simd::reciprocal(V(l.w[0] * r.w[0]));
    const OuterWaves waves = outer_waves<Dim, a>(gas_, l, r, r.w[0] * per_both, l.w[0] * per_both);
    flux<a>(waves, l, r, below, before, k, here, f);
    for (int c = 0; c < C; ++c) store(planes_.first(k, a, c) + at, f[c]);
  };
  for_cells(-1, tile.count[0] + 1, a == 1 && a != last ? 0 : -1, rows(tile) + 1, fluxes);
}

/// What crosses the cells of plane k along one axis within half a step.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <int a>
void Sweep<Dim, Gas, limiter, solver>::sideways(const Tile<Dim>& tile, int k) {
  const auto changes = [&](std::ptrdiff_t at, std::ptrdiff_t) __attribute__((always_inline)) {
    for (int c = 0; c < C; ++c) {
      const double* in = planes_.first(k, a, c) + at;
      const double* out = a == last ? planes_.first(k + 1, a, c) + at : in + Planes::step(a);
      store(planes_.sideways(k, a, c) + at, half_ * (load(in) - load(out)));
    }
  };
  const int beyond = a == 1 && a != last ? 0 : 1;
  for_cells(-1, tile.count[0] + 1, -beyond, rows(tile) + beyond, changes);
}

/// Through the lower faces across an axis of plane k.
template <int Dim, class Gas, SlopeLimiter limiter, RiemannSolver solver>
template <bool Flagged, int a>
void Sweep<Dim, Gas, limiter, solver>::final_fluxes(const Tile<Dim>& tile, int k) {
  const int below = a == last ? k - 1 : k;
  const auto fluxes = [&](std::ptrdiff_t at, std::ptrdiff_t cell) __attribute__((always_inline)) {
    const Place here{at, cell}, before = here.before(a);
    Sides l = side(below, a, 1, before), r = side(k, a, 0, here);
    V d_l[C] = {}, d_r[C] = {};
    for (int other = 0; other < Dim; ++other)
      if (other != a)
        for (int c = 0; c < C; ++c) {
          d_l[c] += load(planes_.sideways(below, other, c) + before.at);
          d_r[c] += load(planes_.sideways(k, other, c) + at);
        }
    const V density_l = positive(l.w[0] + d_l[0], l.w[0]), density_r = positive(r.w[0] + d_r[0], r.w[0]);
    const V per_both = simd::reciprocal(V(density_l * density_r));  // quotients are what a face costs
    V volume_l = density_r * per_both, volume_r = density_l * per_both;
    change(l, density_l, volume_l, d_l, below, before);
    change(r, density_r, volume_r, d_r, k, here);
    if constexpr (Flagged) {
      const auto flagged = simd::max(load(planes_.flag(below) + before.cell), load(planes_.flag(k) + cell)) > 0;
      for (int v = 0; v < W; ++v) {
        l.w[v] = flagged ? load(planes_.cell(below, v) + before.cell) : l.w[v];
        r.w[v] = flagged ? load(planes_.cell(k, v) + cell) : r.w[v];
      }
      volume_l = flagged ? simd::reciprocal(l.w[0]) : volume_l;
      volume_r = flagged ? simd::reciprocal(r.w[0]) : volume_r;
    }
    V f[C];
    const OuterWaves waves = outer_waves<Dim, a>(gas_, l, r, volume_l, volume_r);
    flux<a>(waves, l, r, below, before, k, here, f);
    for (int c = 0; c < C; ++c) store(planes_.final(k, a, c) + at, f[c]);
  };
  for_cells(-1, tile.count[0] + (a == 0 ? 1 : 0), 0, rows(tile) + (a == 1 ? 1 : 0), fluxes);
}

}  // namespace ejecta::grid_detail
