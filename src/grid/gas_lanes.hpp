#pragma once
/// Thermodynamics of the cells, several at a time: a policy of the sweep (sweep.hpp). A policy has
///   carries_energy        whether the specific energy is one of the primitives, after the pressure
///   always_positive       whether pressures are
///   extras                how many values a cell has beside its primitives; the first is its sound speed squared
///   primitives(u, w, x)   primitives w and extras x of conserved u
///   sound2(w, c2, v)      sound speed squared of primitives w at a face of a cell where it is c2; v = 1/rho
///   energy(w)             per volume, kinetic energy included
///   changed(w, x, v, d)   makes of w, all but its density, what a change d of the conserved values makes of it; v is
///                         1/rho after it
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

/// Primitives: density, velocity, pressure, and the specific energy where it is carried. Conserved: density,
/// momentum, energy.
template <int Dim>
inline constexpr int pressure_at = Dim + 1;
template <int Dim>
inline constexpr int conserved_count = Dim + 2;

/// [m^2/s^2] Cold matter has a speed of sound too, so that nothing is divided by 0.
inline constexpr double least_sound2 = 1e-60;

/// u^2/2
template <int Dim>
V half_speed2(const V* w) {
  V sum = w[1] * w[1];
  for (int a = 1; a < Dim; ++a) sum += w[1 + a] * w[1 + a];
  return 0.5 * sum;
}
/// Velocities of conserved values; returns the internal energy per volume.
template <int Dim>
V velocities(const V* u, V volume, V* w) {
  V squares{};
  for (int a = 0; a < Dim; ++a) {
    w[1 + a] = u[1 + a] * volume;
    squares += w[1 + a] * u[1 + a];
  }
  return u[Dim + 1] - 0.5 * squares;
}

/// Ideal gas: all follows from density and pressure.
struct IdealLanes {
  static constexpr bool carries_energy = false, always_positive = true;
  static constexpr int extras = 1;
  double gamma, per_gamma_1;  ///< 1/(gamma - 1)

  explicit IdealLanes(const IdealGas& gas) : gamma(gas.gamma), per_gamma_1(1 / (gas.gamma - 1)) {}

  template <int Dim>
  void primitives(const V* u, V* w, V* x) const {
    const V volume = simd::reciprocal(u[0]);
    w[0] = u[0];
    w[Dim + 1] = (gamma - 1) * velocities<Dim>(u, volume, w);
    x[0] = sound2<Dim>(w, V{}, volume);
  }
  template <int Dim>
  V sound2(const V* w, V, V volume) const {
    return gamma * w[Dim + 1] * volume + least_sound2;
  }
  template <int Dim>
  V energy(const V* w) const {
    return w[Dim + 1] * per_gamma_1 + w[0] * half_speed2<Dim>(w);
  }
  template <int Dim>
  void changed(V* w, const V*, V volume, const V* d) const {
    V u[Dim + 2];
    for (int a = 0; a < Dim; ++a) u[1 + a] = w[0] * w[1 + a] + d[1 + a];
    u[Dim + 1] = energy<Dim>(w) + d[Dim + 1];
    w[Dim + 1] = (gamma - 1) * velocities<Dim>(u, volume, w);
  }
};

/// Any equation of state: pressure and its derivatives are known in the cells, and faces take them along.
struct GeneralLanes {
  static constexpr bool carries_energy = true, always_positive = false;
  static constexpr int extras = 3;  ///< c^2, dP/drho, dP/de of the cell
  const Eos& eos;

  explicit GeneralLanes(const Eos& of) : eos(of) {}

  template <int Dim>
  void primitives(const V* u, V* w, V* x) const {
    const V volume = simd::reciprocal(u[0]);
    w[0] = u[0];
    w[Dim + 2] = velocities<Dim>(u, volume, w) * volume;
    evaluate(w[0], w[Dim + 2], w[Dim + 1], x);
  }
  /// Pressure and extras of densities and specific energies.
  void evaluate(V density, V energy, V& pressure, V* x) const {
    std::visit(
        [&](const auto& e) {
          for (int k = 0; k < width; ++k) {
            const EosPoint point = e.evaluate(density[k], energy[k]);
            pressure[k] = point.pressure;
            const double c = ejecta::sound_speed(point, density[k], e.sound_speed_floor());
            x[0][k] = c * c;
            x[1][k] = point.dP_drho;
            x[2][k] = point.dP_de;
          }
        },
        eos);
  }
  template <int Dim>
  V sound2(const V*, V c2, V) const {
    return c2 + least_sound2;
  }
  template <int Dim>
  V energy(const V* w) const {
    return w[0] * (w[Dim + 2] + half_speed2<Dim>(w));
  }
  template <int Dim>
  void changed(V* w, const V* x, V volume, const V* d) const {
    V u[Dim + 2];
    for (int a = 0; a < Dim; ++a) u[1 + a] = w[0] * w[1 + a] + d[1 + a];
    u[Dim + 1] = energy<Dim>(w) + d[Dim + 1];
    const V e = velocities<Dim>(u, volume, w) * volume;
    w[Dim + 1] += x[1] * d[0] + x[2] * (e - w[Dim + 2]);
    w[Dim + 2] = e;
  }
};

}  // namespace ejecta::grid_detail
