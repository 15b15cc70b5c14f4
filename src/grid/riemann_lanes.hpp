#pragma once
/// Fluxes through faces, several faces at a time.
#include "grid/gas_lanes.hpp"
#include "material/exact_riemann.hpp"

namespace ejecta::grid_detail {

/// Primitives on one side of a face, and the sound speed squared of its cell.
template <int Dim, class Gas>
struct Side {
  static constexpr int values = Dim + 2 + (Gas::carries_energy ? 1 : 0);
  V w[values];
  V c2;
};

/// Speeds of the outer waves. `n` is, as below, the axis across the face.
struct OuterWaves {
  V left, right;
};

/// By Einfeldt (1988, eqs 5.1 to 5.6), which bound those of the exact solution of an ideal gas. The volumes are
/// 1/rho.
template <int Dim, int n, class Gas>
[[gnu::always_inline]] inline OuterWaves outer_waves(const Gas& gas, const Side<Dim, Gas>& left,
                                                     const Side<Dim, Gas>& right, V volume_l, V volume_r) {
  const V *l = left.w, *r = right.w;
  const V ul = l[1 + n], ur = r[1 + n], apart = ur - ul;
  const V c2l = gas.template sound2<Dim>(l, left.c2, volume_l), c2r = gas.template sound2<Dim>(r, right.c2, volume_r);
  // Means of Roe, whose weights are sqrt(rho), here multiplied with sqrt(rho_l) + sqrt(rho_r).
  const V root = simd::square_root(V(l[0] * r[0])), weight_l = l[0] + root, weight_r = r[0] + root;
  const V share = simd::reciprocal(V(weight_l + weight_r));
  const V mean_u = (weight_l * ul + weight_r * ur) * share;
  const V mean_c = simd::square_root(V((weight_l * c2l + weight_r * c2r + 0.5 * root * apart * apart) * share));
  return {simd::min(V(ul - simd::square_root(c2l)), V(mean_u - mean_c)),
          simd::max(V(ur + simd::square_root(c2r)), V(mean_u + mean_c))};
}

/// Flux of two waves [Harten, Lax & van Leer 1983]: contacts and shear are smeared as fast as sound runs.
template <int Dim, int n, class Gas>
[[gnu::noinline]] void hll(const Gas& gas, const OuterWaves& outer, const Side<Dim, Gas>& left,
                           const Side<Dim, Gas>& right, V (&flux)[Dim + 2]) {
  constexpr int p = pressure_at<Dim>;
  const V *l = left.w, *r = right.w;
  const V sl = simd::min(outer.left, V{}), sr = simd::max(outer.right, V{}), apart = simd::reciprocal(V(sr - sl));
  const V share_l = sr * apart, share_r = -sl * apart, exchange = sl * sr * apart;
  const V energy_l = gas.template energy<Dim>(l), energy_r = gas.template energy<Dim>(r);
  const V mass_l = l[0] * l[1 + n], mass_r = r[0] * r[1 + n];
  flux[0] = share_l * mass_l + share_r * mass_r + exchange * (r[0] - l[0]);
  for (int a = 0; a < Dim; ++a)
    flux[1 + a] =
        share_l * (mass_l * l[1 + a]) + share_r * (mass_r * r[1 + a]) + exchange * (r[0] * r[1 + a] - l[0] * l[1 + a]);
  flux[1 + n] += share_l * l[p] + share_r * r[p];
  flux[Dim + 1] = share_l * (l[1 + n] * (energy_l + l[p])) + share_r * (r[1 + n] * (energy_r + r[p])) +
                  exchange * (energy_r - energy_l);
}

/// The same with the contact restored [Toro, Spruce & Speares 1994].
template <int Dim, int n, class Gas>
[[gnu::always_inline]] inline void hllc(const Gas& gas, const OuterWaves& outer, const Side<Dim, Gas>& left,
                                        const Side<Dim, Gas>& right, V (&flux)[Dim + 2]) {
  constexpr int p = pressure_at<Dim>;
  const V *l = left.w, *r = right.w;
  const V ul = l[1 + n], ur = r[1 + n], sl = outer.left, sr = outer.right;
  const V al = l[0] * (sl - ul),
          ar = r[0] * (sr - ur);  // mass through either wave
  const V force = r[p] - l[p] + al * ul - ar * ur,
          mass = al - ar;  // the contact runs at force/mass, mass < 0
  const auto from_left = force <= 0;
  V w[Side<Dim, Gas>::values];
  for (int k = 0; k < Side<Dim, Gas>::values; ++k) w[k] = from_left ? l[k] : r[k];
  const V s = from_left ? sl : sr;
  const V clipped = from_left ? simd::min(sl, V{}) : simd::max(sr, V{});  // 0: the wave does not reach the face
  const V ahead = s * mass - force, per_both = simd::reciprocal(V(mass * ahead));
  const V contact = force * ahead * per_both,
          per_wave = mass * mass * per_both;  // 1/(s - contact)
  const V u = w[1 + n], squeezed = (s - u) * per_wave;
  const V density = w[0] * squeezed, energy = gas.template energy<Dim>(w);
  flux[0] = w[0] * u + clipped * (density - w[0]);
  for (int a = 0; a < Dim; ++a) flux[1 + a] = flux[0] * w[1 + a];
  flux[1 + n] = w[0] * u * u + w[p] + clipped * (density * contact - w[0] * u);
  const V energy_star = squeezed * energy + (contact - u) * (density * contact + w[p] * per_wave);
  flux[Dim + 1] = u * (energy + w[p]) + clipped * (energy_star - energy);
}

/// Flux of the exact solution (material/exact_riemann.hpp), for ideal gases.
template <int Dim, int n>
void exact_flux(const IdealLanes& gas, const Side<Dim, IdealLanes>& left, const Side<Dim, IdealLanes>& right,
                V (&flux)[Dim + 2]) {
  constexpr int p = pressure_at<Dim>;
  V w[Dim + 2];
  for (int k = 0; k < width; ++k) {
    const ExactRiemann riemann({left.w[0][k], left.w[1 + n][k], left.w[p][k]},
                               {right.w[0][k], right.w[1 + n][k], right.w[p][k]}, gas.gamma);
    const GasState state = riemann.at(0);
    const bool from_left = riemann.vacuum() ? state.velocity >= 0 : riemann.star_velocity() >= 0;
    for (int a = 0; a < Dim; ++a) w[1 + a][k] = from_left ? left.w[1 + a][k] : right.w[1 + a][k];
    w[0][k] = state.density;
    w[1 + n][k] = state.velocity;
    w[p][k] = state.pressure;
  }
  const V u = w[1 + n];
  flux[0] = w[0] * u;
  for (int a = 0; a < Dim; ++a) flux[1 + a] = flux[0] * w[1 + a];
  flux[1 + n] += w[p];
  flux[Dim + 1] = u * (gas.template energy<Dim>(w) + w[p]);
}

}  // namespace ejecta::grid_detail
