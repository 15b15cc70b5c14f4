#pragma once
/// Thermodynamics of the cells, several at a time: a policy of the sweep (tile_sweep.hpp). A policy has
///   carries_energy   whether the specific energy is one of the primitives, after the pressure
///   extras           planes that complete() fills beside the primitives
///   sound2(w, x, v)  sound speed squared of primitives w in a cell whose extras are x; v = 1/rho
///   energy(w)        per volume, kinetic energy included
///   changed(w, x, d) primitives after a change d of the conserved ones, and whether they can be
#include <cstring>

#include "base/simd.hpp"
#include "material/eos.hpp"
#include "material/eos_point.hpp"

namespace ejecta::grid_detail {

using V = simd::Doubles;
inline constexpr int width = simd::lanes<double>;

inline V load(const double* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, V v) { std::memcpy(p, &v, sizeof v); }

/// Primitives: density, velocity, pressure, and the specific energy where it is carried. Conserved: density, momentum,
/// energy.
template <int Dim>
inline constexpr int pressure_at = Dim + 1;
template <int Dim>
inline constexpr int conserved_count = Dim + 2;

template <int Dim>
V kinetic(const V* w) {
  V sum = w[1] * w[1];
  for (int a = 1; a < Dim; ++a) sum += w[1 + a] * w[1 + a];
  return 0.5 * w[0] * sum;
}

/// Ideal gas: all follows from density and pressure.
struct IdealLanes {
  static constexpr bool carries_energy = false;
  static constexpr int extras = 0;
  static constexpr bool always_positive = true;  ///< pressures are
  double gamma;

  explicit IdealLanes(const IdealGas& gas) : gamma(gas.gamma) {}

  template <int Dim>
  V sound2(const V* w, const V*, V volume) const {
    return gamma * w[pressure_at<Dim>] * volume;
  }
  template <int Dim>
  V energy(const V* w) const {
    return w[pressure_at<Dim>] * (1 / (gamma - 1)) + kinetic<Dim>(w);
  }
  template <int Dim>
  void from_conserved(const V* u, V* w) const {
    const V volume = simd::reciprocal(u[0]);
    w[0] = u[0];
    V squares{};
    for (int a = 0; a < Dim; ++a) {
      w[1 + a] = u[1 + a] * volume;
      squares += w[1 + a] * u[1 + a];
    }
    w[pressure_at<Dim>] = (gamma - 1) * (u[Dim + 1] - 0.5 * squares);
  }
  template <int Dim>
  void changed(V* w, const V*, const V* d) const {
    V u[Dim + 2], after[Dim + 2];
    u[0] = w[0] + d[0];
    for (int a = 0; a < Dim; ++a) u[1 + a] = w[0] * w[1 + a] + d[1 + a];
    u[Dim + 1] = energy<Dim>(w) + d[Dim + 1];
    from_conserved<Dim>(u, after);
    for (int k = 0; k < Dim + 2; ++k) w[k] = after[k];
  }
};

/// Any equation of state: pressure and its derivatives are known in the cells, and faces take them along.
struct GeneralLanes {
  static constexpr bool carries_energy = true;
  static constexpr int extras = 3;  ///< c^2, dP/drho, dP/de of the cell
  static constexpr bool always_positive = false;
  const Eos& eos;

  explicit GeneralLanes(const Eos& of) : eos(of) {}

  template <int Dim>
  V sound2(const V*, const V* x, V) const {
    return x[0];
  }
  template <int Dim>
  V energy(const V* w) const {
    return w[0] * w[Dim + 2] + kinetic<Dim>(w);
  }
  template <int Dim>
  void changed(V* w, const V* x, const V* d) const {
    const V density = w[0] + d[0], volume = simd::reciprocal(density);
    const V total = energy<Dim>(w) + d[Dim + 1];
    V squares{}, velocity[Dim];
    for (int a = 0; a < Dim; ++a) {
      const V momentum = w[0] * w[1 + a] + d[1 + a];
      velocity[a] = momentum * volume;
      squares += momentum * velocity[a];
    }
    const V e = (total - 0.5 * squares) * volume;
    w[Dim + 1] += x[1] * d[0] + x[2] * (e - w[Dim + 2]);
    w[0] = density;
    for (int a = 0; a < Dim; ++a) w[1 + a] = velocity[a];
    w[Dim + 2] = e;
  }
};

}  // namespace ejecta::grid_detail
