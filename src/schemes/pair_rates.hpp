#pragma once
/// The pass over the pairs that gives rates.
#include "schemes/flux.hpp"
#include "schemes/pair_pass_impl.hpp"

namespace ejecta {

template <class T, int Dim, PassKind Kind, class K, class Flux>
template <bool Contacts>
void PairPassOf<T, Dim, Kind, K, Flux>::cluster_rates(const RateColumns<Dim>& columns, const Cluster& c,
                                                      Candidates candidates) const {
  const Members members(c, records_.data());
  const auto load = members.loader();
  const Support support{load};
  V v[Dim], stress[R::stresses];
  for (int a = 0; a < Dim; ++a) v[a] = load(R::v + a);
  for (int s = 0; s < R::stresses; ++s) stress[s] = load(R::stress + s);
  [[maybe_unused]] V shear[R::stresses];
  if constexpr (Kind.cracked)
    for (int s = 0; s < R::stresses; ++s) shear[s] = load(R::shear + s);
  [[maybe_unused]] const pair_detail::Cracks<T, V, R, Dim, Kind.cracked> cracks(load);
  const FluxLanes flux(load, settings_);
  [[maybe_unused]] const auto hourglass = pair_detail::hourglass_of<Kind.bonded, T, V, R, Dim>(load);
  const V expansion = load(R::expansion), compression = load(R::compression);
  const Alike alike(settings_.alike, expansion, compression);
  [[maybe_unused]] const auto contact = contact_of<Contacts>(members);

  constexpr bool along_gradient = !Kind.stress || (!Kind.asph && !Kind.bonded);  // the flux acts along it
  // In double precision, and within a piece, stresses act apart from the flux: that of j with the gradients, that of i
  // in the end on the sum of all of them.
  constexpr bool apart = Kind.stress && !R::split;
  RateSums sums;
  const auto gradients = [&](Partner & p) __attribute__((always_inline)) {
    const T* j = p.record;
    V dv[Dim], gradient[Dim], weighted[Dim], returned[Dim];  // times V0_j, times w_ij/r_i, times V0_j w_ji/(V0_i r_j)
    for (int a = 0; a < Dim; ++a) dv[a] = j[R::v + a] - v[a];
    p.along = pair_detail::dot(dv, p.dx);
    p.kernel_gradient(gradient, j[R::volume]);
    for (int b = 0; b < Dim; ++b) returned[b] = weighted[b] = gradient[b];
    if (!alike.with(j)) {
      const Shares shares(alike.limit, expansion, compression, j[R::expansion], j[R::compression]);
      for (int b = 0; b < Dim; ++b) {
        weighted[b] *= shares.own;
        returned[b] *= shares.other;
      }
    }
    [[maybe_unused]] V cut;
    [[maybe_unused]] bool is_cut = false;
    if constexpr (Kind.cracked) is_cut = cracks.cut(p, cut);
    if constexpr (apart)
      if (!Contacts || !p.foreign) {
        for (int b = 0; b < Dim; ++b) {
          sums.gradients[b] += weighted[b];
          for (int a = 0; a < Dim; ++a) sums.pull[a] += j[R::stress + a * Dim + b] * returned[b];
        }
        if constexpr (Kind.cracked)
          if (is_cut)
            for (int b = 0; b < Dim; ++b) {
              sums.cut_gradients[b] += cut * weighted[b];
              const V share = cut * returned[b];
              for (int a = 0; a < Dim; ++a) sums.pull[a] -= j[R::shear + a * Dim + b] * share;
            }
      }
    if constexpr (Kind.gradient) {
      if constexpr (Contacts)
        if (p.foreign) {
          const V own = members.own(p);
          V others[Dim], own_share, other_share;
          contact.shares(p, own, own_share, other_share);
          for (int b = 0; b < Dim; ++b) {
            others[b] = own_share * gradient[b];
            weighted[b] *= own;
          }
          sums.contact_gradient.add(dv, others);
        }
      sums.gradient.add(dv, weighted);
      if constexpr (Kind.cracked)
        if (is_cut) {
          for (int b = 0; b < Dim; ++b) weighted[b] *= cut;
          sums.cut.add(dv, weighted);
        }
    } else if constexpr (!R::split) {  // else the work is not needed
      sums.divergence += pair_detail::dot(dv, weighted);
    }
    // Whether forces() has anything to do.
    if constexpr (!apart || !Flux::closing_only || Kind.bonded) return p.reached();
    if constexpr (Contacts)
      if (p.foreign) return p.reached();
    return (p.lanes_reached() & simd::lanes_less(p.along, V{})) != 0;
  };
  const auto forces = [&](const Partner& p) __attribute__((always_inline)) {
    const T* j = p.record;
    const T volume = j[R::volume];
    V dv[Dim], kernel_gradient[Dim], force[Dim];
    for (int a = 0; a < Dim; ++a) dv[a] = j[R::v + a] - v[a];
    p.kernel_gradient(kernel_gradient);
    const V along = p.along, central = p.central();
    Jump<V> jump = flux.jump(p.dx, along, j);
    [[maybe_unused]] V own{}, uneven[Dim];  // uneven: what the stress of i gives more than that of j
    if constexpr (Contacts)
      if (p.foreign) {
        own = members.own(p);
        jump.closing = own > T(0) ? jump.closing : contact.closing(p, dv, along);
        jump.share = own > T(0) ? jump.share : V(contact.weight(p, own) * contact.softness(p));
      }
    auto exchange = flux.between(support, p, jump.closing, jump.share);
    if constexpr (Kind.bonded) exchange.pressure += hourglass.pressure(p);
    sums.fastest = simd::min(sums.fastest, support.within(p.pair, p.distance2(), exchange.approach));
    if constexpr (Flux::uneven) sums.heat.add(volume, exchange.uneven);
    if constexpr (apart)
      if (!Contacts || !p.foreign) {
        const V push = (volume * exchange.pressure) * central;  // along the pair, see below
        for (int a = 0; a < Dim; ++a) sums.acceleration[a].sum -= push * p.dx[a];
        sums.heat.sum -= push * along;
        return;
      }
    // With corrected gradients no torque is left but that of a flux off the pair's axis. Elsewhere that of smoothing
    // tensors follows their gradient: across shocks it is the better one.
    const V pressure = along_gradient ? simd::rounded(exchange.pressure) : V{};
    // Where densities are alike shares are 1 to the bit. Seen from j everything must be the same number, whichever way
    // its cluster takes: products are rounded before the sum, as in the kernels.
    [[maybe_unused]] V cut;
    bool is_cut = false;
    if constexpr (Kind.cracked) is_cut = cracks.cut(p, cut);
    if ((Contacts && p.foreign) || is_cut || !alike.with(j)) {
      const Shares shares(alike.limit, expansion, compression, j[R::expansion], j[R::compression]);
      V ours[R::stresses], theirs[R::stresses];
      for (int s = 0; s < R::stresses; ++s) {
        ours[s] = stress[s];
        theirs[s] = simd::all<V>(j[R::stress + s]);
        if constexpr (Kind.cracked)
          if (is_cut) {
            ours[s] = simd::fused(V(-cut), shear[s], ours[s]);
            theirs[s] = simd::fused(V(-cut), simd::all<V>(j[R::shear + s]), theirs[s]);
          }
        ours[s] = shares.own * ours[s];
        theirs[s] = shares.other * theirs[s];
      }
      if constexpr (Contacts)
        if (p.foreign) {
          V own_share, other_share;
          contact.shares(p, own, own_share, other_share);
          for (int s = 0; s < R::stresses; ++s) {
            ours[s] = own > T(0) ? ours[s] : V(own_share * contact.press[s]);
            theirs[s] = own > T(0) ? theirs[s] : V(other_share * p.contact[R::press + s]);
          }
        }
      for (int s = 0; s < R::stresses; ++s) {
        ours[s] = simd::rounded(ours[s]);
        theirs[s] = simd::rounded(theirs[s]);
      }
      pair_detail::contract<Kind.stress, Dim>(ours, theirs, pressure, kernel_gradient, force);
      if constexpr (R::split)
        pair_detail::contract<Kind.stress, Dim, -1>(ours, theirs, pressure, kernel_gradient, uneven);
    } else {
      pair_detail::contract<Kind.stress, Dim>(stress, j + R::stress, pressure, kernel_gradient, force);
      if constexpr (R::split)
        pair_detail::contract<Kind.stress, Dim, -1>(stress, j + R::stress, pressure, kernel_gradient, uneven);
    }
    if constexpr (!along_gradient)
      for (int a = 0; a < Dim; ++a) force[a] -= exchange.pressure * (central * p.dx[a]);
    if constexpr (Contacts)
      if (p.foreign && contact.friction > 0)
        sums.friction_heat.add(
            volume,
            contact.rub(p, dv, own, force, V((expansion * j[R::expansion]) * (central * simd::square_root(p.r2)))));
    if constexpr (R::split) {
      // Half of the work of the very force that acts on the velocity of j (on v it follows from the sum of forces), and
      // what the two stresses differ by. The work of both sides is then the same in double precision, and what they
      // differ by the negative: no rounding of dv comes between work and heat.
      for (int a = 0; a < Dim; ++a)
        sums.heat.add(static_cast<double>(volume) * static_cast<double>(j[R::v + a]), force[a]);
      sums.heat.add(volume, pair_detail::dot(uneven, dv));
    } else {
      sums.heat.add(-volume,
                    exchange.pressure * (Kind.stress ? V(central * along) : pair_detail::dot(dv, kernel_gradient)));
    }
    for (int a = 0; a < Dim; ++a) sums.acceleration[a].add(volume, force[a]);
  };
  for_partners<Contacts>(
      members, support, candidates, R::size, [&](const V& moment) { sums.moment += moment; }, gradients, forces);
  if constexpr (apart)
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b) {
        sums.pull[a] += stress[a * Dim + b] * sums.gradients[b];
        if constexpr (Kind.cracked) sums.pull[a] -= shear[a * Dim + b] * sums.cut_gradients[b];
      }
      sums.acceleration[a].add(1, sums.pull[a]);
    }
  close<Contacts>(columns, c, sums, v, stress, shear, contact);
}

}  // namespace ejecta
