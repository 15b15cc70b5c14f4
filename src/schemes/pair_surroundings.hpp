#pragma once
/// First passes over the pairs: what is in contact, and the moment matrices.
#include "schemes/pair_pass_impl.hpp"

namespace ejecta {

/// Whether any of the candidates may be of another piece.
template <class T, int Dim, PassKind Kind, class K, class Flux>
bool PairPassOf<T, Dim, Kind, K, Flux>::several_pieces(const Cluster& c, Candidates candidates) const {
  if constexpr (Kind.bonded) return true;
  const auto differs = [&, first = pieces_[c.begin]](std::size_t i) { return pieces_[i] != first; };
  for (std::size_t i = c.begin; i < c.end; ++i)
    if (differs(i)) return true;
  return std::ranges::any_of(candidates, differs);
}

/// Where other pieces are, and how near.
template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::find_contacts(std::size_t cluster, const PairLists<Dim>& lists) {
  const Cluster& c = lists.clusters()[cluster];
  const auto candidates = lists.candidates(cluster);
  for (std::size_t i = c.begin; i < c.end; ++i) around_.sums[i] = {};
  if (!several_pieces(c, candidates)) return;
  const Members members(c, records_.data());
  const Support support{members.loader()};
  V outward[Dim] = {}, occupied{};
  for_partners<true>(
      members, support, candidates, R::v, [](const V&) {},
      [&](const Partner& p) __attribute__((always_inline)) {
        if (!p.foreign || !p.reached()) return;
        in_contact_[cluster] = 1;  // by who is within reach alone: how far lists reach must not change how sums round
        V gradient[Dim];
        const V volume = p.record[R::volume] * p.record[R::expansion] * (T(1) - members.own(p));
        p.kernel_gradient(gradient);
        for (int a = 0; a < Dim; ++a) outward[a] += volume * gradient[a];
        occupied += volume * support.values(p.dx, p.r2, p.record).own;
      });
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    for (int a = 0; a < Dim; ++a) around_.sums[i].outward[a] = static_cast<double>(outward[a][k]);
    around_.sums[i].occupied = support.norm(k) * static_cast<double>(occupied[k]);
  }
}

/// F of a bonded particle and half of k (hourglass.hpp); 0 where its neighbours are too few to tell.
template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::set_deformation(std::size_t i, const Mat<Dim>& moment,
                                                        const Mat<Dim>& at_the_start, double least) {
  const auto correction = gradient_correction<Dim>(at_the_start, least);
  if (!correction.whole) return;
  const Mat<Dim> F = moment * correction.Q.transpose();
  T* r = records_.data() + i * R::size;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) r[R::deformation + a * Dim + b] = static_cast<T>(F(a, b));
  r[R::stiffness] = static_cast<T>(0.5 * hourglass_stiffness) * r[R::density] * r[R::sound_speed] * r[R::sound_speed];
}

/// Moment matrices, and the stretch of bonds.
template <class T, int Dim, PassKind Kind, class K, class Flux>
template <bool Contacts>
void PairPassOf<T, Dim, Kind, K, Flux>::sum_moments(const RateColumns<Dim>& columns, const Cluster& c,
                                                    Candidates candidates) {
  const Members members(c, records_.data());
  const Support support{members.loader()};
  [[maybe_unused]] const auto contact = contact_of<Contacts>(members);
  const V expansion = members.loader()(R::expansion), compression = members.loader()(R::compression);
  const Alike alike(settings_.alike, expansion, compression);
  constexpr bool along = !Kind.asph && !Kind.bonded;  // the gradient is along the pair
  std::conditional_t<along, pair_detail::SymmetricSum<V, Dim>, TensorSum> moment;
  [[maybe_unused]] TensorSum contact_moment, start_moment, cut;
  [[maybe_unused]] const pair_detail::Cracks<T, V, R, Dim, Kind.cracked> cracks(members.loader());
  pair_detail::SquareSum<V, Dim, Kind.asph> squares, squares_of_others;
  V stretch2 = V{} + T(1);
  for_partners<Contacts>(
      members, support, candidates, Kind.cracked ? R::size : R::v, [](const V&) {},
      [&](const Partner& p) __attribute__((always_inline)) {
        const T volume = p.record[R::volume];
        V weight = simd::all<V>(volume), weighted[Dim];
        if (!alike.with(p.record))
          weight *= Shares(alike.limit, expansion, compression, p.record[R::expansion], p.record[R::compression]).own;
        if constexpr (Contacts)
          if (p.foreign) {
            const V own = members.own(p);
            V others[Dim], own_share, other_share;
            contact.shares(p, own, own_share, other_share);
            p.kernel_gradient(others, V(own_share * volume));
            contact_moment.add(p.dx, others);
            squares_of_others.add(others);
            weight *= own;
          }
        p.kernel_gradient(weighted, weight);
        moment.add(p.dx, weighted);
        squares.add(weighted);
        if constexpr (Kind.cracked)
          if (V share; cracks.cut(p, share)) {
            for (int a = 0; a < Dim; ++a) weighted[a] *= share;
            cut.add(p.dx, weighted);
          }
        if constexpr (Kind.bonded) {
          start_moment.add(p.kept.between, weighted);
          stretch2 = simd::max(stretch2, members.stretch2(p));
        }
      });
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    const double expansion = static_cast<double>(records_[i * R::size + R::expansion]);
    auto& sums = around_.sums[i];
    sums.moment = expansion * moment.of_lane(k);
    const auto scale = Support::scale(records_.data() + i * R::size);
    const double squared = expansion * expansion, own_squares = squared * squares.of_lane(k, scale);
    sums.least = least_stretch(std::sqrt(own_squares));
    if constexpr (Contacts) {
      sums.contact = expansion * contact_moment.of_lane(k);
      sums.least_of_all = least_stretch(std::sqrt(own_squares + squared * squares_of_others.of_lane(k, scale)));
    }
    if constexpr (Kind.cracked) around_.cut[i] = expansion * cut.of_lane(k);
    if constexpr (Kind.bonded) {
      columns.stretch(0, i) = std::sqrt(static_cast<double>(stretch2[k]));
      set_deformation(i, sums.moment, expansion * start_moment.of_lane(k), sums.least);
    }
  }
}

}  // namespace ejecta
