#pragma once
/// The loops over the pairs of a flux that is whole (flux.hpp): slopes to reconstruct from, and what passes.
#include <algorithm>
#include <cmath>

#include "schemes/flux.hpp"
#include "schemes/pair_pass_impl.hpp"

namespace ejecta {

namespace pair_detail {

/// Rate at which a particle among others that fill `filled` of the space around it is squeezed [c/h], for volumes that
/// are moved by what faces sweep: those lose or gain a few per cent in a shock, and nothing else would tell. It leaves
/// a contact alone, unlike a sum over neighbours, as every volume spreads with its own kernel. From 0.3 to 1 the error
/// of Sod's tube hardly changes, and that of Noh's problem falls by a third.
inline double squeeze(double filled) {
  constexpr double rate = 1, most = 2;  // few neighbours: as at a free surface, no worse
  return rate * std::log(std::clamp(filled, 1 / most, most));
}

/// How far from what its neighbours, counted by number, leave a particle its density may get: a particle that has lost
/// its volume to one beside it would hardly be missed in what all fill together.
struct DensityShares {
  double least = 0.6, most = 1.7;
};
/// Particles of a coarse body count the finer neighbours of another as their own.
template <int Dim>
DensityShares density_shares(const std::vector<double>& sizes) {
  DensityShares shares;
  if (sizes.empty()) return shares;
  const auto [finest, coarsest] = std::minmax_element(sizes.begin(), sizes.end());
  const double share = std::pow(*finest / *coarsest, Dim);
  return {shares.least * share, shares.most / share};
}

}  // namespace pair_detail

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::cluster_slopes(const RateColumns<Dim>& columns, const Cluster& c,
                                                       Candidates candidates) const {
  using Places = typename R::FluxRecord;
  const Members members(c, records_.data());
  const auto load = members.loader();
  const Support support{load};
  V v[Dim];
  for (int a = 0; a < Dim; ++a) v[a] = load(R::v + a);
  const V density = load(R::density), pressure = load(R::flux + Places::pressure);
  TensorSum moment, strain;
  V of_density[Dim] = {}, of_pressure[Dim] = {};
  pair_detail::SquareSum<V, Dim, Kind.asph> squares;
  for_partners<false>(
      members, support, candidates, R::size, [](const V&) {},
      [&](const Partner& p) __attribute__((always_inline)) {
        const T* j = p.record;
        V dv[Dim], weighted[Dim];
        p.kernel_gradient(weighted);
        const T volume = j[R::volume] * j[R::expansion];
        const V more_density = j[R::density] - density, more_pressure = j[R::flux + Places::pressure] - pressure;
        for (int a = 0; a < Dim; ++a) {
          dv[a] = j[R::v + a] - v[a];
          weighted[a] *= volume;
          of_density[a] += more_density * weighted[a];
          of_pressure[a] += more_pressure * weighted[a];
        }
        moment.add(p.dx, weighted);
        strain.add(dv, weighted);
        squares.add(weighted);
      });
  const double per_unit = 1 / settings_.length_unit;
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    const double stiffness = std::sqrt(squares.of_lane(k, Support::scale(records_.data() + i * R::size)));
    const Mat<Dim> B = gradient_correction<Dim>(moment.of_lane(k), least_stretch(stiffness)).Q;
    const auto store = [&](const Columns<Dim, double>& gradient, const V(&sum)[Dim]) {
      Vec<Dim> raw;
      for (int a = 0; a < Dim; ++a) raw[a] = sum[a][k];
      const Vec<Dim> corrected = per_unit * (B * raw);
      for (int a = 0; a < Dim; ++a) gradient(static_cast<std::size_t>(a), i) = corrected[a];
    };
    store(columns.density_gradient, of_density);
    store(columns.pressure_gradient, of_pressure);
    columns.velocity_gradient.set(i, Mat<Dim>(per_unit * (strain.of_lane(k) * B.transpose())));
    columns.face_correction.set(i, B);
  }
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::cluster_fluxes(const RateColumns<Dim>& columns, const Cluster& c,
                                                       Candidates candidates) const {
  const Members members(c, records_.data());
  const auto load = members.loader();
  const Support support{load};
  V v[Dim];
  for (int a = 0; a < Dim; ++a) v[a] = load(R::v + a);
  const FluxLanes flux(load, settings_);
  const bool moves = columns.compression_rate.count != 0, conducts = settings_.godunov->conducts();
  simd::WideSum<T> acceleration[Dim], heat, conducted, growth, filled, counted;
  V moment{}, fastest{};
  for_partners<false>(
      members, support, candidates, R::size, [&](const V& moment_of_one) { moment += moment_of_one; },
      [](const Partner& p) { return p.reached(); },
      [&](const Partner& p) __attribute__((always_inline)) {
        const T* j = p.record;
        V dv[Dim];
        for (int a = 0; a < Dim; ++a) dv[a] = j[R::v + a] - v[a];
        const WholeFlux<V, Dim> passes = flux.across(p, pair_detail::dot(dv, p.dx));
        for (int a = 0; a < Dim; ++a) acceleration[a].add(-j[R::volume], V(passes.pressure * passes.face[a]));
        // F.(v* - v_i): what i loses and j gains, in all, is the work of F, and what its face sweeps is volume.
        const V sweeps = T(0.5) * pair_detail::dot(dv, passes.face) + passes.drift;
        heat.add(-j[R::volume], V(passes.pressure * sweeps));
        if (conducts) [[unlikely]]
          conducted.add(R::mass(j), flux.conducted(p));
        if (moves) {
          growth.add(j[R::volume] * j[R::expansion], sweeps);
          // Not the particle itself, which is a partner or not as others of its cluster are near: it is added below.
          const KernelValues<V> values = support.values(p.dx, p.r2, j);
          filled.add(j[R::volume] * j[R::expansion], p.r2 > T(0) ? values.others : V{});
          counted.add(T(1), p.r2 > T(0) ? values.own : V{});
        }
        fastest = simd::min(fastest, support.within(p.pair, p.r2, passes.approach));
      });
  const double per_unit = 1 / settings_.length_unit, unit_volume = std::pow(settings_.length_unit, Dim);
  const auto shares = pair_detail::density_shares<Dim>(settings_.rules.sizes);
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    // V0/m of the record: both sides of a pair must use the same two volumes.
    const double specific_volume = records_[i * R::size + R::volume] * unit_volume / columns.mass(0, i);
    for (int a = 0; a < Dim; ++a)
      columns.acceleration(static_cast<std::size_t>(a), i) = specific_volume * per_unit * acceleration[a].lane(k);
    columns.specific_energy_rate(0, i) = specific_volume * per_unit * heat.lane(k);
    if (conducts) columns.specific_energy_rate(0, i) += per_unit * per_unit * conducted.lane(k);
    if (moves) {
      constexpr double norm = K::template norm<Dim>;
      const T* own = records_.data() + i * R::size;
      const double per_ball = support.norm(k) / norm;  // 1/h^Dim
      const double per_h = per_unit * (Dim == 2 ? std::sqrt(per_ball) : std::cbrt(per_ball));
      const double all = filled.lane(k) + own[R::volume] * own[R::expansion] * per_ball * K::value(0.0);
      columns.compression_rate(0, i) =
          own[R::sound_speed] * per_h * pair_detail::squeeze(norm * all / settings_.godunov->lattice_density) -
          2 * per_unit * growth.lane(k);
      const double neighbours =
                       support.norm(k) * (counted.lane(k) + K::value(0.0)) / settings_.godunov->lattice_density,
                   by_number = neighbours * R::mass(own);
      columns.density(0, i) = std::clamp(columns.density(0, i), shares.least * by_number, shares.most * by_number);
    }
    columns.zeroth_moment(0, i) = Support::moment_scale * moment[k];
    columns.largest_mu(0, i) = -fastest[k];
  }
}

}  // namespace ejecta
