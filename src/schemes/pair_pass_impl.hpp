#pragma once
/// The pair loop. W particles i sit in the lanes of vector registers; the candidates j of their cluster are broadcast
/// one by one from their records.
#include <bit>
#include <cmath>

#include "base/flush_denormals.hpp"
#include "base/parallel.hpp"
#include "schemes/contact.hpp"
#include "schemes/cracks.hpp"
#include "schemes/gradient_correction.hpp"
#include "schemes/hourglass.hpp"
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
      : settings_(settings), around_{{}, {}, settings.gradient_correction, HalfSpace(K{}, Dim)} {}

  void density(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void rates(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void slopes(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  std::size_t bytes() const override {
    return (records_.capacity() + contacts_.capacity()) * sizeof(T) + in_contact_.capacity() +
           pieces_.capacity() * sizeof(pieces_[0]) + around_.sums.capacity() * sizeof(around_.sums[0]) +
           around_.cut.capacity() * sizeof(around_.cut[0]);
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
    V cut_gradients[Dim] = {};  ///< the share that cracks take off, of the first and of `gradient`
    TensorSum cut;
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
  template <bool Contacts, class Count, class First, class... Then>
  [[gnu::always_inline]] inline void for_partners(const Members& members, const Support& support, Candidates candidates,
                                                  int values, Count&& count, First&& first, Then&&... then) const;
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
  void set_deformation(std::size_t i, const Mat<Dim>& moment, const Mat<Dim>& at_the_start, double least);
  template <bool Contacts>
  void sum_moments(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates);
  template <bool Contacts>
  void cluster_rates(const RateColumns<Dim>& columns, const Cluster& c, Candidates candidates) const;
  template <bool Contacts, class ContactLanes>
  [[gnu::always_inline]] inline void close(const RateColumns<Dim>& columns, const Cluster& c, const RateSums& sums,
                                           const V (&v)[Dim], const V (&stress)[R::stresses],
                                           const V (&shear)[R::stresses], const ContactLanes& contact) const;
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

/// Calls count(|dW/deta| at eta_i) and first(partner) for every candidate, and then(partner) for those of which `first`
/// returns true. Beyond the reach of both kernel gradients are exactly 0. No two bodies add to one sum: how they take
/// turns depends on how far the lists reach, and so would its rounding.
/// How a candidate is placed takes a chain of dependent operations with a root. The next one is therefore looked at
/// before the first body takes the one at hand, whose operations fill the time. The second body, whose chain is longer
/// still, has a short loop of its own. Who is wanted there is kept as bits in a register: an address made of it would
/// hold up the loads that follow, and branches on it would often be guessed wrong.
template <class T, int Dim, PassKind Kind, class K, class Flux>
template <bool Contacts, class Count, class First, class... Then>
void PairPassOf<T, Dim, Kind, K, Flux>::for_partners(const Members& members, const Support& support,
                                                     Candidates candidates, int values, Count&& count, First&& first,
                                                     Then&&... then) const {
  constexpr std::size_t batch = 32, depth = 3;
  typename Partner::Kept kept[batch];
  const std::size_t n = candidates.size();
  const auto look_at = [&](std::size_t place) __attribute__((always_inline)) {
    prefetch(candidates[std::min(place + batch, n - 1)], values);
    auto& c = kept[place % batch];
    c.record = records_.data() + static_cast<std::size_t>(candidates[place]) * R::size;
    if constexpr (Contacts)
      c.contact = contacts_.data() + static_cast<std::size_t>(candidates[place]) * R::contact_size;
    V between[Dim], distance2, moment;  // where the kernel is taken
    members.template meet<Contacts>(c, between, distance2);
    c.pair = support.pair(between, distance2, c.record, moment);
    count(moment);
  };
  for (std::size_t begin = 0; begin < n; begin += batch) {
    const std::size_t in_batch = std::min(batch, n - begin);
    std::uint64_t wanted = 0;
    for (std::size_t k = 0; k < std::min(depth, in_batch); ++k) look_at(begin + k);
    for (std::size_t k = 0; k < in_batch; ++k) {
      if (k + depth < in_batch) look_at(begin + k + depth);
      Partner partner(kept[k], members);
      if constexpr (sizeof...(Then) == 0)
        first(partner);
      else
        wanted |= std::uint64_t{first(partner)} << k;
    }
    for (; wanted != 0; wanted &= wanted - 1) (then(Partner(kept[std::countr_zero(wanted)], members)), ...);
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
    if constexpr (Kind.cracked) around_.cut.resize(particles.size());
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
    typename Partner::Kept p;
    p.record = records_.data() + static_cast<std::size_t>(index) * R::size;
    V between[Dim], distance2;
    members.template meet<false>(p, between, distance2);
    const KernelValues<V> values = support.values(between, distance2, p.record);
    density.add(Flux::whole ? T(1) : R::mass(p.record), values.own);
    if constexpr (Flux::whole)
      if (fills) filling.add(p.record[R::volume] * p.record[R::expansion], values.others);
    sum += values.moment;
  }
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    columns.density(0, i) = support.norm(k) * density.lane(k);
    if constexpr (Flux::whole) {
      const double on_lattice = settings_.godunov->lattice_density;
      columns.density(0, i) *= R::mass(records_.data() + i * R::size) / on_lattice;
      if (fills) columns.filling(0, i) = K::template norm<Dim> * filling.lane(k) / on_lattice;
    }
    columns.zeroth_moment(0, i) = static_cast<double>(sum[k]);
  }
}

}  // namespace ejecta
