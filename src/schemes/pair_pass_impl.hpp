#pragma once
/// The pair loop. W particles i sit in the lanes of vector registers; the candidates j of their cluster are broadcast
/// one by one from their records. Included only by the pair_pass_<kernel>.cpp files, one instantiation each.
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
template <bool Stress, int Dim, class V>
void contract(const V* s, const V (&g)[Dim], V (&t)[Dim]) {
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

/// sigma : L for the same storage and L row by row; for an isotropic stress L is its trace alone.
template <bool Stress, bool Gradient, int Dim>
double double_contract(const double* s, const double* L) {
  if constexpr (!Gradient) return s[0] * L[0];
  if constexpr (!Stress) {
    double trace = 0;
    for (int a = 0; a < Dim; ++a) trace += L[a * Dim + a];
    return s[0] * trace;
  } else if constexpr (Dim == 2) {
    return s[0] * L[0] + s[1] * L[3] + s[2] * (L[1] + L[2]);
  } else {
    return s[0] * L[0] + s[1] * L[4] + s[2] * L[8] + s[3] * (L[1] + L[3]) + s[4] * (L[2] + L[6]) + s[5] * (L[5] + L[7]);
  }
}

/// The inverse of a symmetric matrix sum (xx yy xy | xx yy zz xy xz yz), or the identity where the neighbours do not
/// span space well enough: then the uncorrected form is the better estimate.
template <int Dim>
Mat<Dim> correction(const double* m) {
  Mat<Dim> a;
  if constexpr (Dim == 2) {
    a << m[0], m[2], m[2], m[1];
  } else {
    a << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
  }
  constexpr double least_determinant = Dim == 2 ? 0.05 : 0.02;  // 1 in the interior, about 1/4 at an edge
  if (!(a.determinant() > least_determinant)) return Mat<Dim>::Identity();
  return a.inverse();
}

}  // namespace pair_detail

template <class T, int Dim, bool Stress, bool Gradient, bool Correction, class K>
class PairPassOf final : public PairPass<Dim> {
 public:
  explicit PairPassOf(const PairPassSettings& settings) : settings_(settings) {}

  void density(Particles<Dim>& particles, const PairLists<Dim>& lists) override;
  void rates(Particles<Dim>& particles, const PairLists<Dim>& lists, std::span<const double> intact) override;
  std::size_t bytes() const override { return records_.capacity() * sizeof(T); }

 private:
  using R = PairRecord<T, Dim, Stress>;
  using V = simd::Vector<T, simd::lanes<T>>;

  /// A candidate as the lanes of a cluster see it.
  struct Partner {
    V dx[Dim], r2;  ///< x_j - x_i
    typename IsotropicSupport<V, Dim, K>::Pair pair;
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

template <class T, int Dim, bool Stress, bool Gradient, bool Correction, class K>
void PairPassOf<T, Dim, Stress, Gradient, Correction, K>::rates(Particles<Dim>& particles, const PairLists<Dim>& lists,
                                                                std::span<const double> intact) {
  pack_records<T, Dim, Stress>(particles, lists.images(), settings_.boundary, K::template norm<Dim>,
                               settings_.length_unit, intact, records_);
  for_clusters(lists, [&](const Cluster& c, auto candidates) { cluster_rates(particles, c, candidates); });
}

template <class T, int Dim, bool Stress, bool Gradient, bool Correction, class K>
void PairPassOf<T, Dim, Stress, Gradient, Correction, K>::cluster_rates(
    Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates) const {
  const T* records = records_.data();
  auto load = [&](int place) { return pair_detail::load<V>(c, records, R::size, place); };
  V x[Dim], x_low[Dim], v[Dim], stress[R::stresses];
  for (int a = 0; a < Dim; ++a) {
    x[a] = load(R::x + a);
    if constexpr (R::split) x_low[a] = load(R::x_low + a);
    v[a] = load(R::v + a);
  }
  for (int s = 0; s < R::stresses; ++s) stress[s] = load(R::stress + s);
  const IsotropicSupport<V, Dim, K> support{load(R::h), load(R::h_reciprocal), load(R::slope_norm)};
  const V density_reciprocal = load(R::density_reciprocal), sound_speed = load(R::sound_speed),
          shear_switch = load(R::shear_switch);
  const T alpha = static_cast<T>(settings_.viscosity_alpha), beta = static_cast<T>(settings_.viscosity_beta);

  simd::WideSum<T> acceleration[Dim], viscous_heating;
  V gradient[Gradient ? Dim * Dim : 1] = {}, spread[symmetric_size<Dim>] = {}, moment{}, fastest{};
  Partner partners[batch];
  for (std::size_t begin = 0; begin < candidates.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, candidates.size());
    std::uint64_t reached = 0;
    for (std::size_t place = begin; place < end; ++place) {
      prefetch(candidates[std::min(place + batch, candidates.size() - 1)]);
      Partner& p = partners[place - begin];
      p.record = records + static_cast<std::size_t>(candidates[place]) * R::size;
      pair_detail::separation<V, R, Dim>(x, x_low, p.record, p.dx, p.r2);
      p.pair = support.template pair<R>(p.r2, p.record);
      moment += p.pair.moment;
      reached |= std::uint64_t{simd::any_less(V{}, p.pair.slope)} << (place - begin);
    }
    for (; reached != 0; reached &= reached - 1) {
      const Partner& p = partners[std::countr_zero(reached)];
      const T* j = p.record;
      V dv[Dim], kernel_gradient[Dim];
      for (int a = 0; a < Dim; ++a) {
        dv[a] = j[R::v + a] - v[a];
        kernel_gradient[a] = p.pair.slope * p.dx[a];
      }
      V approach = dv[0] * p.dx[0], work = dv[0] * kernel_gradient[0];
      for (int a = 1; a < Dim; ++a) {
        approach += dv[a] * p.dx[a];
        work += dv[a] * kernel_gradient[a];
      }
      // Monaghan (1992): mu = h v.x / (r^2 + 0.01 h^2) while approaching, Pi = (-alpha c mu + beta mu^2) / rho. Here mu
      // <= 0.
      const V mean_h = support.template mean_h<R>(j);
      const V mu = mean_h * simd::min(approach, V{}) * simd::reciprocal(V(p.r2 + T(0.01) * mean_h * mean_h));
      const V sound = T(0.5) * (sound_speed + j[R::sound_speed]);
      const V viscosity = T(0.5) * (shear_switch + j[R::shear_switch]) *
                          (T(0.5) * (density_reciprocal + j[R::density_reciprocal])) *
                          (mu * (beta * mu - alpha * sound));
      // sigma_i/rho_i^2 + sigma_j/rho_j^2 - Pi I
      V total[R::stresses], force[Dim];
      for (int s = 0; s < R::stresses; ++s) total[s] = stress[s] + j[R::stress + s];
      for (int s = 0; s < (Stress ? Dim : 1); ++s) total[s] -= viscosity;
      pair_detail::contract<Stress, Dim>(total, kernel_gradient, force);

      const T mass = j[R::mass];
      for (int a = 0; a < Dim; ++a) acceleration[a].add(mass, force[a]);
      viscous_heating.add(mass, V(viscosity * work));
      if constexpr (Gradient) {
        V weighted[Dim];
        for (int b = 0; b < Dim; ++b) weighted[b] = mass * kernel_gradient[b];
        for (int a = 0; a < Dim; ++a)
          for (int b = 0; b < Dim; ++b) gradient[a * Dim + b] += dv[a] * weighted[b];
        if constexpr (Correction) {
          for (int a = 0; a < Dim; ++a) spread[a] += p.dx[a] * weighted[a];
          int s = Dim;
          for (int a = 0; a < Dim; ++a)
            for (int b = a + 1; b < Dim; ++b) spread[s++] += p.dx[a] * weighted[b];
        }
      } else {
        gradient[0] += mass * work;
      }
      fastest = simd::min(fastest, V(p.pair.moment > 0 ? mu : V{}));
    }
  }

  const double per_unit = 1 / settings_.length_unit;
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    for (int a = 0; a < Dim; ++a) particles.column(Field::acceleration, a)[i] = acceleration[a].lane(k) * per_unit;
    double own_stress[R::stresses], raw[Gradient ? Dim * Dim : 1];
    for (int s = 0; s < R::stresses; ++s) own_stress[s] = static_cast<double>(stress[s][k]);
    for (int s = 0; s < (Gradient ? Dim * Dim : 1); ++s) raw[s] = static_cast<double>(gradient[s][k]) * per_unit;
    particles.column(Field::heating)[i] =
        pair_detail::double_contract<Stress, Gradient, Dim>(own_stress, raw) - 0.5 * viscous_heating.lane(k) * per_unit;
    particles.column(Field::neighbour_sum)[i] = static_cast<double>(moment[k]);
    particles.column(Field::approach_speed)[i] = -static_cast<double>(fastest[k]);
    if constexpr (Gradient) {
      const double specific_volume = 1 / particles.column(Field::density)[i];
      Mat<Dim> L;
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) L(a, b) = raw[a * Dim + b] * specific_volume;
      if constexpr (Correction) {
        double sums[symmetric_size<Dim>];
        for (int s = 0; s < symmetric_size<Dim>; ++s) sums[s] = static_cast<double>(spread[s][k]) * specific_volume;
        L = (L * pair_detail::correction<Dim>(sums)).eval();
      }
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) particles.column(Field::velocity_gradient, a * Dim + b)[i] = L(a, b);
    }
  }
}

template <class T, int Dim, bool Stress, bool Gradient, bool Correction, class K>
void PairPassOf<T, Dim, Stress, Gradient, Correction, K>::density(Particles<Dim>& particles,
                                                                  const PairLists<Dim>& lists) {
  pack_records<T, Dim, Stress>(particles, lists.images(), settings_.boundary, K::template norm<Dim>,
                               settings_.length_unit, {}, records_);
  for_clusters(lists, [&](const Cluster& c, auto candidates) { cluster_density(particles, c, candidates); });
}

template <class T, int Dim, bool Stress, bool Gradient, bool Correction, class K>
void PairPassOf<T, Dim, Stress, Gradient, Correction, K>::cluster_density(
    Particles<Dim>& particles, const Cluster& c, std::span<const std::uint32_t> candidates) const {
  const T* records = records_.data();
  auto load = [&](int place) { return pair_detail::load<V>(c, records, R::size, place); };
  V x[Dim], x_low[Dim];
  for (int a = 0; a < Dim; ++a) {
    x[a] = load(R::x + a);
    if constexpr (R::split) x_low[a] = load(R::x_low + a);
  }
  const V h_reciprocal = load(R::h_reciprocal);
  simd::WideSum<T> density;
  V moment{};
  constexpr T guard = sizeof(T) == sizeof(float) ? T(1e-30) : T(1e-200);
  for (const std::uint32_t index : candidates) {
    const T* j = records + static_cast<std::size_t>(index) * R::size;
    V dx[Dim], r2;
    pair_detail::separation<V, R, Dim>(x, x_low, j, dx, r2);
    const V r_reciprocal = simd::reciprocal_sqrt(V(r2 + guard));
    const V q = r2 * r_reciprocal * h_reciprocal;
    density.add(j[R::mass], K::value(q));
    moment -= q * K::slope_over_q(q, V(simd::reciprocal(V(q + guard))));
  }
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    const double n = static_cast<double>(h_reciprocal[k]);
    particles.column(Field::density)[i] = K::template norm<Dim> * (Dim == 2 ? n * n : n * n * n) * density.lane(k);
    particles.column(Field::neighbour_sum)[i] = static_cast<double>(moment[k]);
  }
}

/// The pass of one kernel for what the settings ask.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_pair_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    if (s.stress && s.gradient_correction) return std::make_unique<PairPassOf<T, Dim, true, true, true, K>>(s);
    if (s.stress) return std::make_unique<PairPassOf<T, Dim, true, true, false, K>>(s);
    if (s.velocity_gradient && s.gradient_correction)
      return std::make_unique<PairPassOf<T, Dim, false, true, true, K>>(s);
    if (s.velocity_gradient) return std::make_unique<PairPassOf<T, Dim, false, true, false, K>>(s);
    return std::make_unique<PairPassOf<T, Dim, false, false, false, K>>(s);
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

}  // namespace ejecta
