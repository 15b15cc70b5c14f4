#pragma once
/// The pair loop. W particles i sit in the lanes of vector registers; the candidates j of their cluster are broadcast
/// one by one from their records. Included only by the pair_pass_ and tensor_pass_ files of the kernels.
#include <Eigen/LU>
#include <bit>

#include "base/parallel.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/support.hpp"

namespace ejecta {

namespace pair_detail {

/// One value of each of the W members of a cluster; lanes beyond its end repeat the last member.
template <class V, class T>
V load(const Cluster& c, const T* records, int stride, int place) {
  V v{};
  for (int k = 0; k < simd::lanes<T>; ++k) {
    const std::size_t i = std::min<std::size_t>(c.begin + static_cast<std::size_t>(k), c.end - 1);
    v[k] = records[i * static_cast<std::size_t>(stride) + static_cast<std::size_t>(place)];
  }
  return v;
}

/// x_j - x_i; antisymmetric bit for bit also where positions are split in two.
template <class V, class R, int Dim, class T>
void separation(const V (&x)[Dim], const V (&x_low)[Dim], const T* j, V (&dx)[Dim], V& r2) {
  for (int a = 0; a < Dim; ++a) {
    dx[a] = j[R::x + a] - x[a];
    if constexpr (R::split) dx[a] += j[R::x_low + a] - x_low[a];
  }
  r2 = dx[0] * dx[0];
  for (int a = 1; a < Dim; ++a) r2 += dx[a] * dx[a];
}

/// (sigma . g)_a with sigma stored as xx yy xy | xx yy zz xy xz yz, or one number for an isotropic stress.
template <bool Stress, int Dim, class Tensor, class V>
void contract(const Tensor& s, const V (&g)[Dim], V (&t)[Dim]) {
  if constexpr (!Stress) {
    for (int a = 0; a < Dim; ++a) t[a] = s[0] * g[a];
  } else if constexpr (Dim == 2) {
    t[0] = s[0] * g[0] + s[2] * g[1];
    t[1] = s[2] * g[0] + s[1] * g[1];
  } else {
    t[0] = s[0] * g[0] + s[3] * g[1] + s[4] * g[2];
    t[1] = s[3] * g[0] + s[1] * g[1] + s[5] * g[2];
    t[2] = s[4] * g[0] + s[5] * g[1] + s[2] * g[2];
  }
}

/// x . D x for a symmetric D.
template <int Dim, class Tensor, class V>
V along(const Tensor& d, const V (&x)[Dim]) {
  V image[Dim];
  contract<true, Dim>(d, x, image);
  V sum = x[0] * image[0];
  for (int a = 1; a < Dim; ++a) sum += x[a] * image[a];
  return sum;
}

/// sigma : L for the same storage; for an isotropic stress L is its trace alone if Stress is false.
template <bool Stress, int Dim>
double double_contract(const double* s, const Mat<Dim>& L) {
  if constexpr (!Stress) {
    return s[0] * L.trace();
  } else if constexpr (Dim == 2) {
    return s[0] * L(0, 0) + s[1] * L(1, 1) + s[2] * (L(0, 1) + L(1, 0));
  } else {
    return s[0] * L(0, 0) + s[1] * L(1, 1) + s[2] * L(2, 2) + s[3] * (L(0, 1) + L(1, 0)) + s[4] * (L(0, 2) + L(2, 0)) +
           s[5] * (L(1, 2) + L(2, 1));
  }
}

/// Sums over neighbours that make a velocity gradient.
template <class V, int Dim, bool Spread>
struct GradientSum {
  V sum[Dim * Dim] = {};     ///< m dv_a g_b
  V spread[Dim * Dim] = {};  ///< m dx_a g_b, only if Spread; symmetric only where g is along dx, so not with tensors

  /// `weighted` is the kernel gradient times the mass of the partner.
  void add(const V (&dx)[Dim], const V (&dv)[Dim], const V (&weighted)[Dim]) {
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) {
        sum[a * Dim + b] += dv[a] * weighted[b];
        if constexpr (Spread) spread[a * Dim + b] += dx[a] * weighted[b];
      }
  }
  static Mat<Dim> of_lane(const V (&sums)[Dim * Dim], int lane) {
    Mat<Dim> m;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) m(a, b) = static_cast<double>(sums[a * Dim + b][lane]);
    return m;
  }
};

/// The gradient L times the inverse of the spread. Where the neighbours do not span space well enough the uncorrected
/// form is the better estimate.
template <int Dim>
Mat<Dim> corrected(const Mat<Dim>& L, const Mat<Dim>& spread) {
  constexpr double least_determinant = Dim == 2 ? 0.05 : 0.02;  // 1 in the interior, about 1/4 at an edge
  return spread.determinant() > least_determinant ? Mat<Dim>(L * spread.inverse()) : L;
}

template <int Dim>
void store(Particles<Dim>& particles, Field field, std::size_t i, const Mat<Dim>& m) {
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) particles.column(field, a * Dim + b)[i] = m(a, b);
}

}  // namespace pair_detail

/// Which of its parts a pass has; what is left out costs nothing.
struct PassKind {
  bool stress = false, gradient = false, correction = false, tensor = false, coupled = false;
  constexpr RecordKind record() const { return {stress, tensor, coupled}; }
};

template <class T, int Dim, PassKind Kind, class K>
class PairPassOf final : public PairPass<Dim> {
 public:
  explicit PairPassOf(const PairPassSettings& settings) : settings_(settings) {}

  void density(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void rates(Particles<Dim>& particles, const PairLists<Dim>& lists, std::span<const double> intact) override;
  std::size_t bytes() const override { return records_.capacity() * sizeof(T); }

 private:
  using R = PairRecord<T, Dim, Kind.record()>;
  using V = simd::Vector<T, simd::lanes<T>>;
  using Support = std::conditional_t<Kind.tensor, TensorSupport<V, Dim, K, R>, IsotropicSupport<V, Dim, K, R>>;
  using GradientSum = pair_detail::GradientSum<V, Dim, Kind.correction || Kind.coupled>;

  /// A candidate as the lanes of a cluster see it.
  struct Partner {
    V dx[Dim], r2;  ///< x_j - x_i
    typename Support::Pair pair;
    const T* record;
  };
  /// Candidates go in batches through two short loops: who is within reach of any lane, and what passes between those.
  /// Lists have margins, so many are not; and chains of dependent operations overlap better in short loops. Who is
  /// within reach is kept as bits in a register: an address made of it would hold up the loads that follow.
  static constexpr std::size_t batch = 32;

  /// Fetches the record that the next batch will want.
  void prefetch(std::uint32_t index) const {
    constexpr std::size_t line = 64 / sizeof(T);
    const T* record = records_.data() + static_cast<std::size_t>(index) * R::size;
    for (std::size_t k = 0; k < R::size; k += line) __builtin_prefetch(record + k);
  }

  void cluster_rates(Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates) const;
  void cluster_density(Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates) const;
  template <class Body>
  void for_clusters(const PairLists<Dim>& lists, Body&& body) const {
    parallel_blocks(lists.clusters().size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) body(lists.clusters()[k], lists.candidates(k));
    });
  }

  PairPassSettings settings_;
  std::vector<T> records_;
};

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::rates(Particles<Dim>& particles, const PairLists<Dim>& lists,
                                        std::span<const double> intact) {
  R::pack(particles, lists.images(), settings_.boundary, K::template norm<Dim>, settings_.length_unit, intact,
          settings_.cut_by_cracks, records_);
  for_clusters(lists, [&](const Cluster& c, auto candidates) { cluster_rates(particles, c, candidates); });
}

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::cluster_rates(Particles<Dim>& particles, const Cluster& c,
                                                std::span<const std::uint32_t> candidates) const {
  const T* records = records_.data();
  auto load = [&](int place) { return pair_detail::load<V>(c, records, R::size, place); };
  V x[Dim], x_low[Dim], v[Dim], stress[R::stresses], damage[symmetric_size<Dim>];
  for (int a = 0; a < Dim; ++a) {
    x[a] = load(R::x + a);
    if constexpr (R::split) x_low[a] = load(R::x_low + a);
    v[a] = load(R::v + a);
  }
  for (int s = 0; s < R::stresses; ++s) stress[s] = load(R::stress + s);
  if constexpr (Kind.coupled) {
    for (int s = 0; s < symmetric_size<Dim>; ++s) damage[s] = load(R::damage + s);
  }
  const Support support{load};
  const V density_reciprocal = load(R::density_reciprocal), sound_speed = load(R::sound_speed),
          shear_switch = load(R::shear_switch);
  const T alpha = static_cast<T>(settings_.viscosity_alpha), beta = static_cast<T>(settings_.viscosity_beta);

  simd::WideSum<T> acceleration[Dim], viscous_heating;
  [[maybe_unused]] GradientSum gradient, cut;  // cut: the share that cracks take off
  V divergence{}, moment{}, fastest{};
  Partner partners[batch];
  for (std::size_t begin = 0; begin < candidates.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, candidates.size());
    std::uint64_t reached = 0;
    for (std::size_t place = begin; place < end; ++place) {
      prefetch(candidates[std::min(place + batch, candidates.size() - 1)]);
      Partner& p = partners[place - begin];
      p.record = records + static_cast<std::size_t>(candidates[place]) * R::size;
      pair_detail::separation<V, R, Dim>(x, x_low, p.record, p.dx, p.r2);
      p.pair = support.pair(p.dx, p.r2, p.record);
      moment += p.pair.moment;
      reached |= std::uint64_t{simd::any_less(V{}, p.pair.reach())} << (place - begin);
    }
    for (; reached != 0; reached &= reached - 1) {
      const Partner& p = partners[std::countr_zero(reached)];
      const T* j = p.record;
      V dv[Dim], kernel_gradient[Dim];
      for (int a = 0; a < Dim; ++a) dv[a] = j[R::v + a] - v[a];
      p.pair.gradient(p.dx, kernel_gradient);
      V work = dv[0] * kernel_gradient[0];
      for (int a = 1; a < Dim; ++a) work += dv[a] * kernel_gradient[a];
      // Monaghan (1992): Pi = (-alpha c mu + beta mu^2) / rho. Here mu <= 0.
      const V mu = support.approach(p.pair, p.dx, p.r2, dv, work, kernel_gradient, j);
      const V sound = T(0.5) * (sound_speed + j[R::sound_speed]);
      const V viscosity = T(0.5) * (shear_switch + j[R::shear_switch]) *
                          (T(0.5) * (density_reciprocal + j[R::density_reciprocal])) *
                          (mu * (beta * mu - alpha * sound));
      // sigma_i/rho_i^2 + sigma_j/rho_j^2 - Pi I
      V total[R::stresses], force[Dim];
      for (int s = 0; s < R::stresses; ++s) total[s] = stress[s] + j[R::stress + s];
      for (int s = 0; s < (Kind.stress ? Dim : 1); ++s) total[s] -= viscosity;
      pair_detail::contract<Kind.stress, Dim>(total, kernel_gradient, force);

      const T mass = j[R::mass];
      for (int a = 0; a < Dim; ++a) acceleration[a].add(mass, force[a]);
      viscous_heating.add(mass, V(viscosity * work));
      if constexpr (Kind.gradient) {
        V weighted[Dim];
        for (int b = 0; b < Dim; ++b) weighted[b] = mass * kernel_gradient[b];
        gradient.add(p.dx, dv, weighted);
        if constexpr (Kind.coupled) {
          V across = simd::max(pair_detail::along<Dim>(damage, p.dx), pair_detail::along<Dim>(j + R::damage, p.dx));
          if (simd::any_less(V{}, across)) {  // most matter has no cracks
            across = simd::min(V(across * simd::reciprocal(V(p.r2 + support_detail::guard<T>))), V{} + T(1));
            for (int b = 0; b < Dim; ++b) weighted[b] *= across;
            cut.add(p.dx, dv, weighted);
          }
        }
      } else {
        divergence += mass * work;
      }
      fastest = simd::min(fastest, V(p.pair.moment > 0 ? mu : V{}));
    }
  }

  const double per_unit = 1 / settings_.length_unit;
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    for (int a = 0; a < Dim; ++a) particles.column(Field::acceleration, a)[i] = acceleration[a].lane(k) * per_unit;
    double own_stress[R::stresses];
    for (int s = 0; s < R::stresses; ++s) own_stress[s] = static_cast<double>(stress[s][k]);
    double work = 0;  // of the stress, sigma : L / rho
    if constexpr (Kind.gradient) {
      const double specific_volume = 1 / particles.column(Field::density)[i];
      const Mat<Dim> raw = per_unit * GradientSum::of_lane(gradient.sum, k),
                     spread = GradientSum::of_lane(gradient.spread, k);
      Mat<Dim> L = specific_volume * raw;
      if constexpr (Kind.correction) L = pair_detail::corrected<Dim>(L, specific_volume * spread);
      pair_detail::store(particles, Field::velocity_gradient, i, L);
      if constexpr (Kind.coupled) {
        const Mat<Dim> left = raw - per_unit * GradientSum::of_lane(cut.sum, k),
                       left_spread = spread - GradientSum::of_lane(cut.spread, k);
        pair_detail::store(particles, Field::coupled_gradient, i,
                           pair_detail::corrected<Dim>(specific_volume * left, specific_volume * left_spread));
      }
      work = pair_detail::double_contract<Kind.stress, Dim>(own_stress, raw);
    } else {
      work = own_stress[0] * (static_cast<double>(divergence[k]) * per_unit);
    }
    particles.column(Field::heating)[i] = work - 0.5 * viscous_heating.lane(k) * per_unit;
    particles.column(Field::neighbour_sum)[i] = static_cast<double>(moment[k]);
    particles.column(Field::approach_speed)[i] = -static_cast<double>(fastest[k]);
  }
}

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::density(Particles<Dim>& particles, const PairLists<Dim>& lists) {
  R::pack(particles, lists.images(), settings_.boundary, K::template norm<Dim>, settings_.length_unit, {},
          settings_.cut_by_cracks, records_);
  for_clusters(lists, [&](const Cluster& c, auto candidates) { cluster_density(particles, c, candidates); });
}

template <class T, int Dim, PassKind Kind, class K>
void PairPassOf<T, Dim, Kind, K>::cluster_density(Particles<Dim>& particles, const Cluster& c,
                                                  std::span<const std::uint32_t> candidates) const {
  const T* records = records_.data();
  auto load = [&](int place) { return pair_detail::load<V>(c, records, R::size, place); };
  V x[Dim], x_low[Dim];
  for (int a = 0; a < Dim; ++a) {
    x[a] = load(R::x + a);
    if constexpr (R::split) x_low[a] = load(R::x_low + a);
  }
  const Support support{load};
  simd::WideSum<T> density;
  V sum{};
  for (const std::uint32_t index : candidates) {
    const T* j = records + static_cast<std::size_t>(index) * R::size;
    V dx[Dim], r2, w, moment;
    pair_detail::separation<V, R, Dim>(x, x_low, j, dx, r2);
    support.value(dx, r2, w, moment);
    density.add(j[R::mass], w);
    sum += moment;
  }
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    particles.column(Field::density)[i] = support.norm(k) * density.lane(k);
    particles.column(Field::neighbour_sum)[i] = static_cast<double>(sum[k]);
  }
}

/// The pass of one kernel for what the settings ask, with smoothing lengths.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_isotropic_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    auto of = [&]<PassKind Kind>() { return std::make_unique<PairPassOf<T, Dim, Kind, K>>(s); };
    constexpr bool stress = true, gradient = true, correction = true;
    if (s.stress && s.gradient_correction) return of.template operator()<PassKind{stress, gradient, correction}>();
    if (s.stress) return of.template operator()<PassKind{stress, gradient}>();
    if (s.velocity_gradient && s.gradient_correction)
      return of.template operator()<PassKind{!stress, gradient, correction}>();
    if (s.velocity_gradient) return of.template operator()<PassKind{!stress, gradient}>();
    return of.template operator()<PassKind{}>();
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

/// The same with smoothing tensors or with stress cut off by cracks: both always with velocity gradients.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_tensor_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    auto of = [&]<PassKind Kind>() -> std::unique_ptr<PairPass<Dim>> {
      constexpr PassKind corrected{Kind.stress, true, true, Kind.tensor, Kind.coupled};
      if (s.gradient_correction) return std::make_unique<PairPassOf<T, Dim, corrected, K>>(s);
      return std::make_unique<PairPassOf<T, Dim, Kind, K>>(s);
    };
    constexpr bool stress = true, gradient = true, tensor = true, coupled = true;
    if (s.coupled && s.tensor) return of.template operator()<PassKind{stress, gradient, false, tensor, coupled}>();
    if (s.coupled) return of.template operator()<PassKind{stress, gradient, false, !tensor, coupled}>();
    if (s.stress) return of.template operator()<PassKind{stress, gradient, false, tensor}>();
    return of.template operator()<PassKind{!stress, gradient, false, tensor}>();
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

}  // namespace ejecta
