#pragma once
/// The pair loop. W particles i sit in the lanes of vector registers; the candidates j of their cluster are broadcast
/// one by one from their records.
#include <bit>
#include <cmath>

#include "base/flush_denormals.hpp"
#include "base/parallel.hpp"
#include "schemes/contact.hpp"
#include "schemes/gradient_correction.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/members.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/pair_weights.hpp"
#include "schemes/rate_columns.hpp"
#include "schemes/support.hpp"

namespace ejecta {

/// Which of its parts a pass has; what is left out costs nothing.
struct PassKind {
  bool stress = false, gradient = false, asph = false, cracked = false, bonded = false;
  constexpr RecordKind record() const { return {stress, asph, cracked, bonded, gradient}; }
};

/// The axes: precision T, dimension, parts, kernel K (kernels.hpp) and flux (flux.hpp). Only rates() and density() know
/// particles; the loops take records and clusters and write into columns.
template <class T, int Dim, PassKind Kind, class K, class Flux>
class PairPassOf final : public PairPass<Dim> {
 public:
  explicit PairPassOf(const PairPassSettings& settings)
      : settings_(settings), around_{{}, settings.gradient_correction, HalfSpace(K{}, Dim)} {}

  void density(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void rates(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void slopes(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  std::size_t bytes() const override {
    return (records_.capacity() + contacts_.capacity()) * sizeof(T) + in_contact_.capacity() +
           pieces_.capacity() * sizeof(pieces_[0]) + around_.sums.capacity() * sizeof(around_.sums[0]);
  }

 private:
  using R = PairRecord<T, Dim, Kind.record(), Flux>;
  using V = simd::Vector<T, simd::lanes<T>>;
  using Support = std::conditional_t<Kind.asph, EllipsoidalSupport<V, Dim, K, R>, IsotropicSupport<V, Dim, K, R>>;
  using FluxLanes = typename Flux::template Lanes<V, Dim, R, Kind.record().strained>;
  static_assert(!Flux::whole || (!Kind.stress && !Kind.gradient && !R::split), "a whole flux is of gases, in double");
  using Members = pair_detail::Members<T, V, R, Dim, Kind.record()>;
  using Partner = pair_detail::Partner<T, V, Dim, Kind.record(), typename Support::Pair>;
  using TensorSum = pair_detail::TensorSum<V, Dim>;
  using Shares = pair_detail::WeightShares<V>;
  using Alike = pair_detail::Alike<T, V, R>;
  using Candidates = std::span<const std::uint32_t>;

  /// What the loop over the partners of a cluster sums for its rates.
  struct RateSums {
    simd::WideSum<T> acceleration[Dim], heat, friction_heat;  ///< heat: twice what the pairs give
    V divergence{}, moment{}, fastest{};
    V gradients[Dim] = {};  ///< weighted kernel gradients: what the stress of i acts on
    V pull[Dim] = {};       ///< of the stresses of all j
    TensorSum gradient, contact_gradient;
    TensorSum cut, cut_moment;  ///< the share that cracks take off
  };

  RecordScales scales() const {
    const GodunovSettings godunov = settings_.godunov.value_or(GodunovSettings{});
    return {K::template norm<Dim>,
            K::support,
            K::reduced_scale,
            K::reduced_over_r,
            settings_.length_unit,
            godunov.linear_conduction,
            godunov.quadratic_conduction};
  }
  /// Fetches what the next batch will want: `values` from the start of its records on. Inlined by order: GCC takes a
  /// function that only prefetches for one without effect and drops the call.
  [[gnu::always_inline]] inline void prefetch(std::uint32_t index, int values) const {
    constexpr int line = 64 / sizeof(T);
    const T* record = records_.data() + static_cast<std::size_t>(index) * R::size;
    for (int k = 0; k < values; k += line) __builtin_prefetch(record + k);
  }
  /// Contacts: members or candidates of several pieces. Inlined whatever its size: else the sums of its bodies would
  /// live in memory.
  template <bool Contacts, class Count, class... Bodies>
  [[gnu::always_inline]] inline void for_partners(const Members& members, const Support& support, Candidates candidates,
                                                  int values, Count&& count, Bodies&&... bodies) const;
  /// The members as others in contact with them see it; nothing without contacts.
  template <bool Contacts>
  auto contact_of(const Members& members) const {
    if constexpr (Contacts)
      return members.contact(contacts_.data(), settings_.friction);
    else
      return std::false_type{};
  }
  void rates_by_stress(Particles<Dim>& particles, const PairLists<Dim>& lists);
  void rates_by_flux(Particles<Dim>& particles, const PairLists<Dim>& lists);
  bool several_pieces(const Cluster& c, Candidates candidates) const;
  void find_contacts(std::size_t cluster, const PairLists<Dim>& lists);
  template <bool Contacts>
  void sum_moments(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates);
  template <bool Contacts>
  void cluster_rates(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates) const;
  template <bool Contacts, class ContactLanes>
  [[gnu::always_inline]] inline void close(const RateColumns<Dim>& columns, const Cluster& c, const RateSums& sums,
                                           const V (&v)[Dim], const V (&stress)[R::stresses],
                                           const ContactLanes& contact) const;
  void cluster_density(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates) const;
  void cluster_slopes(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates) const;
  void cluster_fluxes(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates) const;
  template <class Body>
  void for_clusters(const PairLists<Dim>& lists, Body&& body) const {
    parallel_blocks(lists.clusters().size(), 16, [&](std::size_t begin, std::size_t end) {
      [[maybe_unused]] const std::conditional_t<R::split, FlushDenormals, std::false_type> flush{};
      for (std::size_t k = begin; k < end; ++k) body(k);
    });
  }

  PairPassSettings settings_;
  std::vector<T> records_, contacts_;  ///< contacts_: empty where nothing can be in contact
  std::vector<char> in_contact_;       ///< by cluster
  std::vector<std::int32_t> pieces_;   ///< of all records, close together; empty where nothing can be in contact
  Surroundings<Dim> around_;
};

/// Candidates go in batches through short loops: who is within reach of any lane, and what passes between those, in one
/// loop for each body. Lists have margins, so many are not; chains of dependent operations overlap better in short
/// loops; and the sums of each stay in registers. Who is within reach is kept as bits in a register: an address made of
/// it would hold up the loads that follow, and branches on it would often be guessed wrong.
/// Calls count(pair) for every candidate and the first body(partner) for those within reach. A body that returns
/// whether the next one has anything to do there narrows them down. No two bodies add to one sum: how they take turns
/// depends on how far the lists reach, and so would its rounding.
template <class T, int Dim, PassKind Kind, class K, class Flux>
template <bool Contacts, class Count, class... Bodies>
void PairPassOf<T, Dim, Kind, K, Flux>::for_partners(const Members& members, const Support& support,
                                                     Candidates candidates, int values, Count&& count,
                                                     Bodies&&... bodies) const {
  constexpr std::size_t batch = 32;
  Partner partners[batch];
  for (std::size_t begin = 0; begin < candidates.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, candidates.size());
    std::uint64_t reached = 0;
    for (std::size_t place = begin; place < end; ++place) {
      prefetch(candidates[std::min(place + batch, candidates.size() - 1)], values);
      Partner& p = partners[place - begin];
      p.record = records_.data() + static_cast<std::size_t>(candidates[place]) * R::size;
      if constexpr (Contacts)
        p.contact = contacts_.data() + static_cast<std::size_t>(candidates[place]) * R::contact_size;
      V between[Dim], distance2;  // where the kernel is taken
      members.template meet<Contacts>(p, between, distance2);
      p.pair = support.pair(between, distance2, p.record);
      count(p.pair);
      reached |= std::uint64_t{simd::any_less(V{}, p.pair.reach())} << (place - begin);
    }
    const auto for_each = [&](auto& body) __attribute__((always_inline)) {
      std::uint64_t wanted = 0;
      for (std::uint64_t left = reached; left != 0; left &= left - 1) {
        const int k = std::countr_zero(left);
        if constexpr (std::is_void_v<decltype(body(partners[k]))>)
          body(partners[k]);
        else
          wanted |= std::uint64_t{body(partners[k])} << k;
      }
      reached = wanted;
    };
    (for_each(bodies), ...);
  }
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::rates(Particles<Dim>& particles, const PairLists<Dim>& lists) {
  if constexpr (Flux::whole)
    rates_by_flux(particles, lists);
  else
    rates_by_stress(particles, lists);
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::rates_by_stress(Particles<Dim>& particles, const PairLists<Dim>& lists) {
  const PairRules& rules = settings_.rules;
  const auto& clusters = lists.clusters();
  const RateColumns<Dim> columns(particles);
  R::pack(particles, lists.ghosts(), rules, scales(), records_);
  in_contact_.assign(clusters.size(), 0);
  if constexpr (Kind.stress) {
    around_.sums.resize(particles.size());
    if (settings_.contacts) {
      pieces_.resize(particles.size() + lists.ghosts().size());
      parallel_for(0, pieces_.size(),
                   [&](std::size_t i) { pieces_[i] = static_cast<std::int32_t>(records_[i * R::size + R::piece]); });
      for_clusters(lists, [&](std::size_t k) { find_contacts(k, lists); });
      R::pack_contacts(particles, lists.ghosts(), rules, around_, contacts_);
    }
    for_clusters(lists, [&](std::size_t k) {
      if (in_contact_[k])
        sum_moments<true>(columns, clusters[k], lists.candidates(k));
      else if (around_.corrects || Kind.cracked)
        sum_moments<false>(columns, clusters[k], lists.candidates(k));
    });
  }
  R::pack_stress(particles, lists.ghosts(), rules, around_, records_, contacts_);
  for_clusters(lists, [&](std::size_t k) {
    if constexpr (Kind.stress)
      // In single precision both sides of a pair go through the same code, so that they round alike.
      if (in_contact_[k] || (R::split && settings_.contacts))
        return cluster_rates<true>(columns, clusters[k], lists.candidates(k));
    cluster_rates<false>(columns, clusters[k], lists.candidates(k));
  });
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::rates_by_flux(Particles<Dim>& particles, const PairLists<Dim>& lists) {
  R::pack(particles, lists.ghosts(), settings_.rules, scales(), records_);
  const RateColumns<Dim> columns(particles);
  for_clusters(lists, [&](std::size_t k) { cluster_fluxes(columns, lists.clusters()[k], lists.candidates(k)); });
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::slopes([[maybe_unused]] Particles<Dim>& particles,
                                               [[maybe_unused]] const PairLists<Dim>& lists) {
  if constexpr (Flux::whole) {
    R::pack(particles, lists.ghosts(), settings_.rules, scales(), records_);
    const RateColumns<Dim> columns(particles);
    for_clusters(lists, [&](std::size_t k) { cluster_slopes(columns, lists.clusters()[k], lists.candidates(k)); });
  }
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::density(Particles<Dim>& particles, const PairLists<Dim>& lists) {
  R::pack(particles, lists.ghosts(), settings_.rules, scales(), records_);
  const RateColumns<Dim> columns(particles);
  for_clusters(lists, [&](std::size_t k) { cluster_density(columns, lists.clusters()[k], lists.candidates(k)); });
}

template <class T, int Dim, PassKind Kind, class K, class Flux>
void PairPassOf<T, Dim, Kind, K, Flux>::cluster_density(const RateColumns<Dim>& columns, const Cluster& c,
                                                        Candidates candidates) const {
  const Members members(c, records_.data());
  const Support support{members.loader()};
  simd::WideSum<T> density, filling;
  V sum{};
  const bool fills = Flux::whole && columns.filling.count != 0;
  for (const std::uint32_t index : candidates) {
    Partner p;
    p.record = records_.data() + static_cast<std::size_t>(index) * R::size;
    V between[Dim], distance2, w, moment;
    members.template meet<false>(p, between, distance2);
    support.value(between, distance2, w, moment);
    density.add(Flux::whole ? T(1) : p.record[R::mass], w);
    if constexpr (Flux::whole)
      if (fills)
        filling.add(p.record[R::volume] * p.record[R::expansion], support.partner_value(between, distance2, p.record));
    sum += moment;
  }
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    columns.density(0, i) = support.norm(k) * density.lane(k);
    if constexpr (Flux::whole) {
      const double on_lattice = settings_.godunov->lattice_density;
      columns.density(0, i) *= records_[i * R::size + R::mass] / on_lattice;
      if (fills) columns.filling(0, i) = K::template norm<Dim> * filling.lane(k) / on_lattice;
    }
    columns.zeroth_moment(0, i) = static_cast<double>(sum[k]);
  }
}

}  // namespace ejecta
