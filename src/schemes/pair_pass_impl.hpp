#pragma once
/// The pair loop. W particles i sit in the lanes of vector registers; the candidates j of their cluster are broadcast
/// one by one from their records.
#include <bit>

#include "base/parallel.hpp"
#include "schemes/gradient_correction.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/pair_sums.hpp"
#include "schemes/support.hpp"

namespace ejecta {

/// Which of its parts a pass has; what is left out costs nothing.
struct PassKind {
  bool stress = false, gradient = false, tensor = false, coupled = false, bonded = false;
  constexpr RecordKind record() const { return {stress, tensor, coupled, bonded, gradient}; }
};

template <class T, int Dim, PassKind Kind, class K>
class PairPassOf final : public PairPass<Dim> {
 public:
  explicit PairPassOf(const PairPassSettings& settings)
      : settings_(settings), around_{{}, settings.gradient_correction, HalfSpace(K{}, Dim)} {}

  void density(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void rates(Particles<Dim>& particles, const PairLists<Dim>& lists, std::span<const double> intact) override;
  std::size_t bytes() const override {
    return (records_.capacity() + touches_.capacity()) * sizeof(T) + mixed_.capacity() +
           around_.sums.capacity() * sizeof(around_.sums[0]);
  }

 private:
  using R = PairRecord<T, Dim, Kind.record()>;
  using V = simd::Vector<T, simd::lanes<T>>;
  using Support = std::conditional_t<Kind.tensor, TensorSupport<V, Dim, K, R>, IsotropicSupport<V, Dim, K, R>>;
  using Members = pair_detail::Members<T, V, R, Dim, Kind.record()>;
  using Partner = pair_detail::Partner<T, V, Dim, Kind.record(), typename Support::Pair>;
  using TensorSum = pair_detail::TensorSum<V, Dim>;
  using Shares = pair_detail::WeightShares<V>;
  using Alike = pair_detail::Alike<T, V, R>;

  RecordScales scales() const {
    return {K::template norm<Dim>, K::support, K::reduced_scale, K::reduced_over_r, settings_.length_unit};
  }
  /// Fetches what the next batch will want: `values` from the start of its records on.
  void prefetch(std::uint32_t index, int values) const {
    constexpr int line = 64 / sizeof(T);
    const T* record = records_.data() + static_cast<std::size_t>(index) * R::size;
    for (int k = 0; k < values; k += line) __builtin_prefetch(record + k);
  }
  /// Mixed: members or candidates of several pieces. Inlined whatever its size: else the sums of its bodies would live
  /// in memory.
  template <bool Mixed, class Count, class... Bodies>
  [[gnu::always_inline]] inline void for_partners(const Members& members, const Support& support,
                                                  std::span<const std::uint32_t> candidates, int values, Count&& count,
                                                  Bodies&&... bodies) const;
  void feel(std::size_t cluster, const PairLists<Dim>& lists);
  template <bool Mixed>
  void look_around(Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates);
  template <bool Mixed>
  void cluster_rates(Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates) const;
  void cluster_density(Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates) const;
  template <class Body>
  void for_clusters(const PairLists<Dim>& lists, Body&& body) const {
    parallel_blocks(lists.clusters().size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) body(k);
    });
  }

  PairPassSettings settings_;
  std::vector<T> records_, touches_;  ///< touches_: empty where nothing can touch
  std::vector<char> mixed_;           ///< by cluster
  Surroundings<Dim> around_;
};

/// Candidates go in batches through short loops: who is within reach of any lane, and what passes between those, in one
/// loop for each body. Lists have margins, so many are not; chains of dependent operations overlap better in short
/// loops; and the sums of each stay in registers. Who is within reach is kept as bits in a register: an address made of
/// it would hold up the loads that follow.
/// Calls count(pair) for every candidate and each body(partner) for those within reach.
template <class T, int Dim, PassKind Kind, class K>
template <bool Mixed, class Count, class... Bodies>
void PairPassOf<T, Dim, Kind, K>::for_partners(const Members& members, const Support& support,
                                               std::span<const std::uint32_t> candidates, int values, Count&& count,
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
      if constexpr (Mixed) p.touch = touches_.data() + static_cast<std::size_t>(candidates[place]) * R::touch_size;
      V between[Dim], distance2;  // where the kernel is taken
      members.template meet<Mixed>(p, between, distance2);
      p.pair = support.pair(between, distance2, p.record);
      count(p.pair);
      reached |= std::uint64_t{simd::any_less(V{}, p.pair.reach())} << (place - begin);
    }
    const auto for_reached = [&](auto& body) __attribute__((always_inline)) {
      for (std::uint64_t left = reached; left != 0; left &= left - 1) body(partners[std::countr_zero(left)]);
    };
    (for_reached(bodies), ...);
  }
}

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::rates(Particles<Dim>& particles, const PairLists<Dim>& lists,
                                        std::span<const double> intact) {
  const PairRules& rules = settings_.rules;
  const auto& clusters = lists.clusters();
  R::pack(particles, lists.images(), rules, scales(), records_);
  mixed_.assign(clusters.size(), 0);
  if constexpr (Kind.stress) {
    around_.sums.resize(particles.size());
    if (settings_.touches) {
      for_clusters(lists, [&](std::size_t k) { feel(k, lists); });
      R::pack_touch(particles, lists.images(), rules, around_, touches_);
    }
    for_clusters(lists, [&](std::size_t k) {
      if (mixed_[k])
        look_around<true>(particles, clusters[k], lists.candidates(k));
      else if (around_.corrects || Kind.coupled)
        look_around<false>(particles, clusters[k], lists.candidates(k));
    });
  }
  R::pack_stress(particles, lists.images(), rules, intact, around_, records_, touches_);
  for_clusters(lists, [&](std::size_t k) {
    if constexpr (Kind.stress)
      // In single precision both sides of a pair go through the same code, so that they round alike.
      if (mixed_[k] || (R::split && settings_.touches))
        return cluster_rates<true>(particles, clusters[k], lists.candidates(k));
    cluster_rates<false>(particles, clusters[k], lists.candidates(k));
  });
}

/// Where other pieces are, and how near.
template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::feel(std::size_t cluster, const PairLists<Dim>& lists) {
  const Cluster& c = lists.clusters()[cluster];
  const auto candidates = lists.candidates(cluster);
  const Members members(c, records_.data());
  for (std::size_t i = c.begin; i < c.end; ++i) around_.sums[i] = {};
  if (!members.mixed(candidates)) return;
  const Support support{members.loader()};
  V outward[Dim] = {}, occupied{};
  for_partners<true>(
      members, support, candidates, R::v, [](const auto&) {},
      [&](const Partner& p) __attribute__((always_inline)) {
        if (!p.foreign) return;
        mixed_[cluster] = 1;  // by who is within reach alone: how far lists reach must not change how sums round
        V gradient[Dim], w, unused;
        const V volume = p.record[R::volume] * p.record[R::expansion] * (T(1) - members.own(p));
        p.kernel_gradient(gradient);
        for (int a = 0; a < Dim; ++a) outward[a] += volume * gradient[a];
        support.value(p.dx, p.r2, w, unused);
        occupied += volume * w;
      });
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    for (int a = 0; a < Dim; ++a) around_.sums[i].outward[a] = static_cast<double>(outward[a][k]);
    around_.sums[i].occupied = support.norm(k) * static_cast<double>(occupied[k]);
  }
}

/// Moment matrices, and the stretch of bonds.
template <class T, int Dim, PassKind Kind, class K>
template <bool Mixed>
void PairPassOf<T, Dim, Kind, K>::look_around(Particles<Dim>& particles, const Cluster& c,
                                              std::span<const std::uint32_t> candidates) {
  const Members members(c, records_.data());
  const Support support{members.loader()};
  [[maybe_unused]] pair_detail::Touch<T, V, R, Dim> touch;
  if constexpr (Mixed) touch = members.touch(touches_.data(), settings_.friction);
  const V expansion = members.loader()(R::expansion), compression = members.loader()(R::compression);
  const Alike alike(settings_.alike, expansion, compression);
  constexpr bool along = !Kind.tensor && !Kind.bonded;  // the gradient is along the pair
  std::conditional_t<along, pair_detail::SymmetricSum<V, Dim>, TensorSum> moment;
  [[maybe_unused]] TensorSum touched;
  pair_detail::SquareSum<V, Dim, Kind.tensor> squares, squares_of_others;
  V stretch2 = V{} + T(1);
  for_partners<Mixed>(
      members, support, candidates, R::v, [](const auto&) {},
      [&](const Partner& p) __attribute__((always_inline)) {
        const T volume = p.record[R::volume];
        V weight = simd::all<V>(volume), gradient[Dim], weighted[Dim];
        if (!alike.with(p.record))
          weight *= Shares(alike.limit, expansion, compression, p.record[R::expansion], p.record[R::compression]).own;
        p.kernel_gradient(gradient);
        for (int b = 0; b < Dim; ++b) weighted[b] = weight * gradient[b];
        if constexpr (Mixed)
          if (p.foreign) {
            const V own = members.own(p);
            V others[Dim], own_share, other_share;
            touch.shares(p, own, own_share, other_share);
            for (int b = 0; b < Dim; ++b) {
              others[b] = own_share * (volume * gradient[b]);
              weighted[b] *= own;
            }
            touched.add(p.dx, others);
            squares_of_others.add(others);
          }
        moment.add(p.dx, weighted);
        squares.add(weighted);
        if constexpr (Kind.bonded) stretch2 = simd::max(stretch2, members.stretch2(p));
      });
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    const double expansion = static_cast<double>(records_[i * R::size + R::expansion]);
    auto& sums = around_.sums[i];
    sums.moment = expansion * moment.of_lane(k);
    const auto scale = Support::scale(records_.data() + i * R::size);
    const double squared = expansion * expansion, own_squares = squared * squares.of_lane(k, scale);
    sums.least = least_stretch(std::sqrt(own_squares));
    if constexpr (Mixed) {
      sums.touched = expansion * touched.of_lane(k);
      sums.least_of_all = least_stretch(std::sqrt(own_squares + squared * squares_of_others.of_lane(k, scale)));
    }
    if constexpr (Kind.bonded) particles.column(Field::stretch)[i] = std::sqrt(static_cast<double>(stretch2[k]));
  }
}

template <class T, int Dim, PassKind Kind, class K>
template <bool Mixed>
void PairPassOf<T, Dim, Kind, K>::cluster_rates(Particles<Dim>& particles, const Cluster& c,
                                                std::span<const std::uint32_t> candidates) const {
  const Members members(c, records_.data());
  const auto load = members.loader();
  const Support support{load};
  V v[Dim], stress[R::stresses], damage[symmetric_size<Dim>];
  for (int a = 0; a < Dim; ++a) v[a] = load(R::v + a);
  for (int s = 0; s < R::stresses; ++s) stress[s] = load(R::stress + s);
  if constexpr (Kind.coupled) {
    for (int s = 0; s < symmetric_size<Dim>; ++s) damage[s] = load(R::damage + s);
  }
  [[maybe_unused]] V smooth, strain[symmetric_size<Dim>];
  if constexpr (Kind.gradient) {
    smooth = load(R::smooth);
    for (int s = 0; s < symmetric_size<Dim>; ++s) strain[s] = load(R::strain + s);
  }
  const V expansion = load(R::expansion), compression = load(R::compression);
  const V density = load(R::density), sound_speed = load(R::sound_speed), viscosity_factor = load(R::viscosity_factor);
  const Alike alike(settings_.alike, expansion, compression);
  const T half_alpha = static_cast<T>(0.5 * settings_.viscosity_alpha), beta = static_cast<T>(settings_.viscosity_beta);
  [[maybe_unused]] pair_detail::Touch<T, V, R, Dim> touch;
  if constexpr (Mixed) touch = members.touch(touches_.data(), settings_.friction);

  constexpr bool along_gradient = !Kind.stress || (!Kind.tensor && !Kind.bonded);  // viscosity acts along it
  simd::WideSum<T> acceleration[Dim], heat, friction_heat;                         // heat: twice what the pairs give
  [[maybe_unused]] TensorSum gradient, touched, cut, cut_moment;  // cut: the share that cracks take off
  V divergence{}, moment{}, fastest{};
  const auto forces = [&](const Partner& p) __attribute__((always_inline)) {
    const T* j = p.record;
    const T volume = j[R::volume];
    V dv[Dim], kernel_gradient[Dim], force[Dim];
    for (int a = 0; a < Dim; ++a) dv[a] = j[R::v + a] - v[a];
    p.kernel_gradient(kernel_gradient);
    const V along = pair_detail::dot(dv, p.dx), central = p.central();
    V closing = along;
    if constexpr (Kind.gradient) {
      const pair_detail::Squares<V, Dim> squares(p.dx);
      const V shared = pair_detail::smooth_closing(squares.along(strain), squares.along(j + R::strain), along);
      closing -= simd::rounded(V((smooth + j[R::smooth]) * shared));
    }
    V limiter = viscosity_factor + j[R::viscosity_factor];
    [[maybe_unused]] V own{}, uneven[Dim];  // uneven: what the stress of i gives more than that of j
    if constexpr (Mixed)
      if (p.foreign) {
        own = members.own(p);
        closing = own > T(0) ? closing : touch.closing(p, dv, along);
        limiter = own > T(0) ? limiter : V(touch.weight(p, own) * touch.softness(p, sound_speed));
      }
    const Fraction<V> approach = support.approach(p.pair, p.r2, closing, j);
    const V densities = density + j[R::density], quotient = simd::reciprocal(V(approach.under * densities));
    const V mu = approach.over * (densities * quotient);
    const V mean_density = T(2) * density * j[R::density] * (approach.under * quotient);
    const V viscosity = limiter * (expansion * j[R::expansion]) * mean_density *
                        (mu * (beta * mu - half_alpha * (sound_speed + j[R::sound_speed])));
    // With corrected gradients no torque is left but that of a viscosity off the pair's axis. Elsewhere that of
    // smoothing tensors follows their gradient: across shocks it is the better one.
    const V pressure = along_gradient ? viscosity : V{};
    // In single precision always: both sides of a pair must round alike, whatever else is in their clusters.
    if (R::split || (Mixed && p.foreign) || !alike.with(j)) {
      const Shares shares(alike.limit, expansion, compression, j[R::expansion], j[R::compression]);
      V ours[R::stresses], theirs[R::stresses];
      for (int s = 0; s < R::stresses; ++s) {
        ours[s] = shares.own * stress[s];
        theirs[s] = shares.other * j[R::stress + s];
      }
      if constexpr (Mixed)
        if (p.foreign) {
          V own_share, other_share;
          touch.shares(p, own, own_share, other_share);
          for (int s = 0; s < R::stresses; ++s) {
            ours[s] = own > T(0) ? ours[s] : V(own_share * touch.press[s]);
            theirs[s] = own > T(0) ? theirs[s] : V(other_share * p.touch[R::press + s]);
          }
        }
      // Rounded before the sum, as in the kernels: seen from j it must be the same number.
      for (int s = 0; s < R::stresses; ++s) {
        ours[s] = simd::rounded(ours[s]);
        theirs[s] = simd::rounded(theirs[s]);
      }
      pair_detail::contract<Kind.stress, Dim>(ours, theirs, pressure, kernel_gradient, force);
      if constexpr (R::split)
        pair_detail::contract<Kind.stress, Dim, -1>(ours, theirs, pressure, kernel_gradient, uneven);
    } else {
      pair_detail::contract<Kind.stress, Dim>(stress, j + R::stress, pressure, kernel_gradient, force);
    }
    if constexpr (!along_gradient)
      for (int a = 0; a < Dim; ++a) force[a] -= viscosity * (central * p.dx[a]);
    if constexpr (Mixed)
      if (p.foreign && touch.friction > 0)
        friction_heat.add(
            volume,
            touch.rub(p, dv, own, force, V((expansion * j[R::expansion]) * (central * simd::square_root(p.r2)))));
    if constexpr (R::split) {
      // Half of the work of the very force that acts on the velocity of j (on v it follows from the sum of forces), and
      // what the two stresses differ by. The work of both sides is then the same in double precision, and what they
      // differ by the negative: no rounding of dv comes between work and heat.
      for (int a = 0; a < Dim; ++a)
        heat.add(static_cast<double>(volume) * static_cast<double>(j[R::v + a]), force[a]);
      heat.add(volume, pair_detail::dot(uneven, dv));
    } else {
      heat.add(-volume, viscosity * (Kind.stress ? V(central * along) : pair_detail::dot(dv, kernel_gradient)));
    }
    for (int a = 0; a < Dim; ++a) acceleration[a].add(volume, force[a]);
    fastest = simd::min(fastest, V(p.pair.moment > 0 ? mu : V{}));
  };
  const auto gradients = [&](const Partner& p) __attribute__((always_inline)) {
    const T* j = p.record;
    V dv[Dim], kernel_gradient[Dim], weight = simd::all<V>(j[R::volume]);
    for (int a = 0; a < Dim; ++a) dv[a] = j[R::v + a] - v[a];
    if (!alike.with(j))
      weight *= Shares(alike.limit, expansion, compression, j[R::expansion], j[R::compression]).own;
    p.kernel_gradient(kernel_gradient);
    if constexpr (Kind.gradient) {
      V weighted[Dim];
      for (int b = 0; b < Dim; ++b) weighted[b] = weight * kernel_gradient[b];
      if constexpr (Mixed)
        if (p.foreign) {
          const V own = members.own(p);
          V others[Dim], own_share, other_share;
          touch.shares(p, own, own_share, other_share);
          for (int b = 0; b < Dim; ++b) {
            others[b] = own_share * (j[R::volume] * kernel_gradient[b]);
            weighted[b] *= own;
          }
          touched.add(dv, others);
        }
      gradient.add(dv, weighted);
      if constexpr (Kind.coupled) {
        V across = simd::max(pair_detail::along<Dim>(damage, p.dx), pair_detail::along<Dim>(j + R::damage, p.dx));
        if (simd::any_less(V{}, across)) {  // most matter has no cracks
          across = simd::min(V(across * simd::reciprocal(V(p.r2 + support_detail::guard<T>))), V{} + T(1));
          for (int b = 0; b < Dim; ++b) weighted[b] *= across;
          cut.add(dv, weighted);
          cut_moment.add(p.dx, weighted);
        }
      }
    } else {
      divergence += weight * pair_detail::dot(dv, kernel_gradient);
    }
  };
  for_partners<Mixed>(
      members, support, candidates, R::size, [&](const auto& pair) { moment += pair.moment; }, forces, gradients);

  const double per_unit = 1 / settings_.length_unit, unit_volume = std::pow(settings_.length_unit, Dim);
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    // V0/m of the record, not 1/rho0: both sides of a pair must use the same two volumes.
    const double specific_volume =
        static_cast<double>(records_[i * R::size + R::volume]) * unit_volume / particles.column(Field::mass)[i];
    for (int a = 0; a < Dim; ++a)
      particles.column(Field::acceleration, a)[i] = specific_volume * per_unit * acceleration[a].lane(k);
    const double expanded = static_cast<double>(records_[i * R::size + R::expansion]);
    double work = 0;  // of the stress, sigma : L
    if constexpr (Kind.gradient) {
      const Mat<Dim> raw = gradient.of_lane(k);
      work = pair_detail::double_contract<Kind.stress, Dim>(stress, k, raw);
      Mat<Dim> L = expanded * raw;
      if constexpr (Kind.stress) {
        const auto& sums = around_.sums[i];
        L = around_.own(sums).gradient(expanded * raw);
        if constexpr (Mixed)
          if (!sums.touched.isZero(0)) {
            const Mat<Dim> others = touched.of_lane(k);
            const Mat<Dim> all = around_.all(sums).gradient(expanded * (raw + others));
            L = touching_gradient<Dim>(L, all, sums.normal(), touch.pressed(k));
            work += pair_detail::double_contract<true, Dim>(touch.press, k, others);
          }
      }
      pair_detail::store(particles, Field::velocity_gradient, i, Mat<Dim>(per_unit * L));
      if constexpr (Kind.coupled) {
        const Mat<Dim> left = around_.sums[i].moment - expanded * cut_moment.of_lane(k);
        const auto correction = gradient_correction<Dim>(left, around_.sums[i].least);
        const Mat<Dim> coupled = correction.gradient(expanded * (raw - cut.of_lane(k)));
        pair_detail::store(particles, Field::coupled_gradient, i, Mat<Dim>(per_unit * coupled));
      }
    } else {
      work = static_cast<double>(stress[0][k]) * static_cast<double>(divergence[k]);
    }
    double pairs = heat.lane(k);
    if constexpr (R::split)
      for (int a = 0; a < Dim; ++a) pairs -= static_cast<double>(v[a][k]) * acceleration[a].lane(k);
    double heating = 0.5 * pairs + friction_heat.lane(k);
    if constexpr (!R::split) heating += work;
    heating *= specific_volume * per_unit;
    if constexpr (R::split)  // the work above is that of rounded velocities, and the rest belongs to the particle alone
      for (int a = 0; a < Dim; ++a)
        heating -= particles.column(Field::acceleration, a)[i] *
                   (particles.column(Field::velocity, a)[i] - static_cast<double>(v[a][k]));
    particles.column(Field::heating)[i] = heating;
    particles.column(Field::neighbour_sum)[i] = Support::moment_scale * static_cast<double>(moment[k]);
    particles.column(Field::approach_speed)[i] = -static_cast<double>(fastest[k]);
  }
}

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::density(Particles<Dim>& particles, const PairLists<Dim>& lists) {
  R::pack(particles, lists.images(), settings_.rules, scales(), records_);
  for_clusters(lists, [&](std::size_t k) { cluster_density(particles, lists.clusters()[k], lists.candidates(k)); });
}

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::cluster_density(Particles<Dim>& particles, const Cluster& c,
                                                  std::span<const std::uint32_t> candidates) const {
  const Members members(c, records_.data());
  const Support support{members.loader()};
  simd::WideSum<T> density;
  V sum{};
  for (const std::uint32_t index : candidates) {
    Partner p;
    p.record = records_.data() + static_cast<std::size_t>(index) * R::size;
    V between[Dim], distance2, w, moment;
    members.template meet<false>(p, between, distance2);
    support.value(between, distance2, w, moment);
    density.add(p.record[R::mass], w);
    sum += moment;
  }
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    particles.column(Field::density)[i] = support.norm(k) * density.lane(k);
    particles.column(Field::neighbour_sum)[i] = static_cast<double>(sum[k]);
  }
}

}  // namespace ejecta
