#pragma once
/// Parts of the pair loop: the members of a cluster in their lanes, how a partner looks from there, what touching
/// pieces do to each other, and sums that make a tensor.
#include <cmath>

#include "base/simd.hpp"
#include "base/types.hpp"
#include "particles/pair_lists.hpp"
#include "schemes/kernels.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta::pair_detail {

template <int Dim, class V>
V dot(const V (&a)[Dim], const V (&b)[Dim]) {
  V sum = a[0] * b[0];
  for (int k = 1; k < Dim; ++k) sum += a[k] * b[k];
  return sum;
}

/// ((A + Sign B - pressure I) . g)_a with tensors stored row by row, or one number each for isotropic stresses.
template <bool Stress, int Dim, int Sign = 1, class TensorA, class TensorB, class V>
[[gnu::always_inline]] inline void contract(const TensorA& A, const TensorB& B, V pressure, const V (&g)[Dim],
                                            V (&f)[Dim]) {
  const auto both = [&](int k) {
    const V sum = Sign > 0 ? V(A[k] + B[k]) : V(A[k] - B[k]);
    return Sign > 0 && (!Stress || k % (Dim + 1) == 0) ? V(sum - pressure) : sum;
  };
  for (int a = 0; a < Dim; ++a) {
    f[a] = both(Stress ? a * Dim : 0) * g[Stress ? 0 : a];
    if constexpr (Stress)
      for (int b = 1; b < Dim; ++b) f[a] += both(a * Dim + b) * g[b];
  }
}

/// T : L of lane k for the same storage.
template <bool Stress, int Dim, class V, int N>
double double_contract(const V (&t)[N], int k, const Mat<Dim>& L) {
  if constexpr (!Stress) return static_cast<double>(t[0][k]) * L.trace();
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) sum += static_cast<double>(t[Stress ? a * Dim + b : 0][k]) * L(a, b);
  return sum;
}

/// x . D x for a symmetric D (order: base/types.hpp).
template <int Dim, class Tensor, class V>
V along(const Tensor& d, const V (&x)[Dim]) {
  if constexpr (Dim == 2) {
    return x[0] * (d[0] * x[0] + d[2] * x[1]) + x[1] * (d[2] * x[0] + d[1] * x[1]);
  } else {
    return x[0] * (d[0] * x[0] + d[3] * x[1] + d[4] * x[2]) + x[1] * (d[3] * x[0] + d[1] * x[1] + d[5] * x[2]) +
           x[2] * (d[4] * x[0] + d[5] * x[1] + d[2] * x[2]);
  }
}

/// How fast the strain x.e x that a pair shares closes its gap, where it is what closes it (`along`, v.x): the harmonic
/// mean of both sides, 0 where one side opens, and fading where it differs by more than `trust` from what happens.
template <class V>
[[gnu::always_inline]] inline V smooth_closing(V ours, V theirs, V along) {
  using T = kernel_detail::Scalar<V>;
  constexpr T trust = T(0.3), guard = sizeof(T) == sizeof(float) ? T(1e-15) : T(1e-60);
  ours = simd::min(ours, V{});
  theirs = simd::min(theirs, V{});
  const V twice = T(-2) * ours * theirs, sum = guard - (ours + theirs);  // mean = twice / sum
  const V trusted = trust * simd::magnitude(along) + guard;
  const V quotient = simd::reciprocal(V(sum * trusted));  // one division for both
  const V off = simd::magnitude(V(twice - along * sum)) * quotient;
  return twice * trusted * quotient * simd::max(simd::min(V(T(2) - off), V{} + T(1)), V{});
}

/// Shares s_ij and s_ji of the weights of a pair of neighbours (PairPass::rates), by their expansions r and
/// compressions c = 1/r: 1 while their densities differ by less than `alike`, those of volumes where by four times
/// that.
template <class V>
struct WeightShares {
  V own, other;

  template <class T>
  WeightShares(T alike, V r_i, V c_i, T r_j, T c_j) {
    const V i_over_j = simd::rounded(V(r_j * c_i)), j_over_i = simd::rounded(V(r_i * c_j));  // of densities
    // 1 where weights are those of masses, 0 where those of volumes
    const V mass =
        simd::max(simd::min(V((T(4) * alike - (i_over_j + j_over_i)) * (1 / (T(3) * alike))), V{} + T(1)), V{});
    own = mass + (T(1) - mass) * i_over_j;
    other = mass + (T(1) - mass) * j_over_i;
  }
};

/// Tells at once whether all lanes are so much alike in density with a partner that both shares are 1.
template <class T, class V, class R>
struct Alike {
  T limit, most = 0;                ///< where x + 1/x reaches the limit, a little less
  T expanded = 0, compressed = 0;  ///< the most of all lanes

  Alike(double alike, V expansion, V compression) : limit(static_cast<T>(alike)) {
    if (alike > 2) most = static_cast<T>(0.999 * 0.5 * (alike + std::sqrt(alike * alike - 4)));
    for (int k = 0; k < simd::lanes<T>; ++k) {
      expanded = std::max(expanded, expansion[k]);
      compressed = std::max(compressed, compression[k]);
    }
  }
  bool with(const T* j) const {
    return j[R::expansion] * compressed < most && j[R::compression] * expanded < most;
  }
};

/// The products x_a x_b in the order of symmetric tensors.
template <class V, int Dim>
struct Squares {
  V products[symmetric_size<Dim>];

  explicit Squares(const V (&x)[Dim]) {
    for (int a = 0, k = Dim; a < Dim; ++a) {
      products[a] = x[a] * x[a];
      for (int b = a + 1; b < Dim; ++b, ++k) products[k] = x[a] * x[b];
    }
  }
  /// x . e x for e with twice what is off its diagonal; the same number seen from either side of a pair.
  V along(const V (&e)[symmetric_size<Dim>]) const {
    return sum_of([&](int k) { return e[k]; });
  }
  template <class T>
  V along(const T* e) const {
    return sum_of([&](int k) { return simd::all<V>(e[k]); });
  }

 private:
  template <class Component>
  V sum_of(Component&& e) const {
    V sum = e(0) * products[0];
    for (int k = 1; k < symmetric_size<Dim>; ++k) sum = simd::fused(e(k), products[k], sum);
    return sum;
  }
};

/// Sum over partners of a b^T.
template <class V, int Dim>
struct TensorSum {
  V sum[Dim * Dim] = {};
  void add(const V (&a)[Dim], const V (&b)[Dim]) {
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) sum[r * Dim + c] += a[r] * b[c];
  }
  Mat<Dim> of_lane(int lane) const {
    Mat<Dim> m;
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) m(r, c) = static_cast<double>(sum[r * Dim + c][lane]);
    return m;
  }
};

/// Sum over partners of a b^T where b is along a.
template <class V, int Dim>
struct SymmetricSum {
  V sum[symmetric_size<Dim>] = {};
  void add(const V (&a)[Dim], const V (&b)[Dim]) {
    for (int r = 0, k = Dim; r < Dim; ++r) {
      sum[r] += a[r] * b[r];
      for (int c = r + 1; c < Dim; ++c, ++k) sum[k] += a[r] * b[c];
    }
  }
  Mat<Dim> of_lane(int lane) const {
    Symmetric<Dim> m;
    for (int k = 0; k < symmetric_size<Dim>; ++k) m[k] = static_cast<double>(sum[k][lane]);
    return matrix_of<Dim>(m);
  }
};

/// Sum over partners of (a h)^2 with the own smoothing length, or of |H^-1 a|^2 with the own metric G = H H.
template <class V, int Dim, bool Tensor>
struct SquareSum {
  V sum{};
  void add(const V (&a)[Dim]) { sum += dot(a, a); }
  double of_lane(int lane, double h) const { return h * h * static_cast<double>(sum[lane]); }
};
template <class V, int Dim>
struct SquareSum<V, Dim, true> {
  SymmetricSum<V, Dim> sum;
  void add(const V (&a)[Dim]) { sum.add(a, a); }
  double of_lane(int lane, const Mat<Dim>& metric) const { return (metric.inverse() * sum.of_lane(lane)).trace(); }
};

template <int Dim>
void store(Particles<Dim>& particles, Field field, std::size_t i, const Mat<Dim>& m) {
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) particles.column(field, a * Dim + b)[i] = m(a, b);
}

/// What a bonded pass adds to a partner.
template <class V, int Dim, bool Bonded>
struct Bond {};
template <class V, int Dim>
struct Bond<V, Dim, true> {
  V between[Dim], own, stretch2;  ///< separation that the kernel sees; 1 for neighbours; of a bond, else 0
};

/// A candidate as the lanes of a cluster see it.
template <class T, class V, int Dim, RecordKind Kind, class Pair>
struct Partner : Bond<V, Dim, Kind.bonded> {
  V dx[Dim], r2;  ///< x_j - x_i
  Pair pair;
  const T *record, *touch;  ///< touch: only in mixed clusters
  bool foreign;             ///< in some lane of another piece; only in mixed clusters

  /// What the kernel gradient is along the pair, over its length; of a bond along itself, which may have turned since.
  V central() const {
    if constexpr (Kind.bonded)
      return pair.central(this->between, dot(this->between, this->between));
    else
      return pair.central(dx, r2);
  }
  void kernel_gradient(V (&g)[Dim]) const {
    if constexpr (Kind.bonded)
      pair.gradient(this->between, g);
    else
      pair.gradient(dx, g);
  }
};

/// What passes between pieces that touch. All lanes; the caller keeps to those of other pieces.
template <class T, class V, class R, int Dim>
struct Touch {
  V touching, impedance, expansion, compression, normal[Dim], velocity[Dim], press[R::stresses];
  T friction;

  /// Whether lane k passes stress on to others.
  bool pressed(int k) const {
    bool any = false;
    for (const V& value : press) any |= value[k] != 0;
    return any;
  }
  /// How far a pair of different pieces touches; 0 within a piece.
  template <class Partner>
  V weight(const Partner& p, V own) const {
    return (T(1) - own) * simd::max(touching, simd::all<V>(p.touch[R::touching]));
  }
  /// What i feels of j and j of i, as far as they touch, by the impedances rho c of both, 2 in all: as where two waves
  /// meet, the softer one decides what stress there is at the contact. A solid hardly notices the gas beside it, which
  /// feels it as a wall. Times the share that makes the weights those of volumes.
  template <class Partner>
  void shares(const Partner& p, V own, V& own_share, V& other_share) const {
    const V other = simd::all<V>(p.record[R::density] * p.record[R::sound_speed]);
    const V touched = weight(p, own), per_sum = T(2) / (impedance + other);
    other_share = impedance * per_sum * (expansion * p.record[R::compression]) * touched;
    own_share = other * per_sum * (p.record[R::expansion] * compression) * touched;
  }
  /// Factor of the viscosity: the mean sound speed in it is at most twice the lower one.
  template <class Partner>
  V softness(const Partner& p, V sound_speed) const {
    const V other = simd::all<V>(p.record[R::sound_speed]);
    return simd::min(V(T(4) * simd::min(sound_speed, other) / (sound_speed + other)), V{} + T(1));
  }
  /// What closes the gap between pieces, of v.x (`along`): sliding does not brake.
  template <class Partner>
  V closing(const Partner& p, const V (&dv)[Dim], V along) const {
    V n[Dim];
    const V n2 = mean_normal(p, n), gap = dot(dv, n) * dot(p.dx, n) / (n2 + T(1e-20));
    return n2 > T(0.01) ? gap : along;
  }
  /// Adds friction to the force per volume; returns half of what it heats, in single precision beyond half of its work
  /// on dv, which the pass counts with that of the other forces. The velocity of an image behind a wall is mirrored; the
  /// wall itself rests.
  template <class Partner>
  V rub(const Partner& p, const V (&dv)[Dim], V own, V (&force)[Dim], V reach) const {
    const bool rests = p.record[R::piece] == T(wall);
    V n[Dim], slide[Dim];
    const V n2 = mean_normal(p, n) + T(1e-20);
    for (int a = 0; a < Dim; ++a) slide[a] = rests ? V(-p.record[R::v + a] - velocity[a]) : dv[a];
    const V out = dot(slide, n) / n2, push = simd::max(V(-dot(force, n)), V{}) * (T(1) - own);
    for (int a = 0; a < Dim; ++a) slide[a] -= out * n[a];
    const V speed = simd::square_root(V(dot(slide, slide) + T(1e-20)));
    const V softer = simd::min(impedance, simd::all<V>(p.record[R::density] * p.record[R::sound_speed]));
    const V drag = simd::min(V(friction * push / simd::square_root(n2)), V(softer * speed * reach)) / speed;
    V work{};
    for (int a = 0; a < Dim; ++a) {
      force[a] += drag * slide[a];
      work += drag * slide[a] * (R::split ? V(slide[a] - dv[a]) : slide[a]);
    }
    return T(0.5) * work;
  }

 private:
  /// Normal of the contact, from i to j: the mean of what both see.
  template <class Partner>
  V mean_normal(const Partner& p, V (&n)[Dim]) const {
    for (int a = 0; a < Dim; ++a) n[a] = normal[a] - p.touch[R::normal + a];
    return dot(n, n);
  }
};

/// The W members of a cluster; lanes beyond its end repeat the last member.
template <class T, class V, class R, int Dim, RecordKind Kind>
struct Members {
  const Cluster& cluster;
  const T* records;
  V x[Dim], x_low[Dim], piece, place[Dim], place_low[Dim], bond;

  Members(const Cluster& c, const T* all) : cluster(c), records(all) {
    const auto load = loader();
    for (int a = 0; a < Dim; ++a) {
      x[a] = load(R::x + a);
      if constexpr (R::split) x_low[a] = load(R::x_low + a);
      if constexpr (Kind.bonded) place[a] = load(R::place + a);
      if constexpr (Kind.bonded && R::split) place_low[a] = load(R::place_low + a);
    }
    if constexpr (Kind.stress) piece = load(R::piece);
    if constexpr (Kind.bonded) bond = load(R::bond);
  }

  /// load(k): value k of the record of every member.
  auto loader() const { return loader(records, R::size); }
  auto loader(const T* of, std::size_t size) const {
    return [this, of, size](int k) {
      V v{};
      for (int lane = 0; lane < simd::lanes<T>; ++lane) {
        const std::size_t i = std::min<std::size_t>(cluster.begin + static_cast<std::size_t>(lane), cluster.end - 1);
        v[lane] = of[i * size + static_cast<std::size_t>(k)];
      }
      return v;
    };
  }

  /// Looks at the partner of p.record: `between` is the separation at which the kernel is taken, and its square.
  template <bool Mixed, class Partner>
  void meet(Partner& p, V (&between)[Dim], V& distance2) const {
    const T* j = p.record;
    separation(x, x_low, j, R::x, R::x_low, p.dx);
    p.r2 = dot(p.dx, p.dx);
    if constexpr (Mixed) p.foreign = any_differs(piece, j[R::piece]);
    if constexpr (Kind.bonded) {
      separation(place, place_low, j, R::place, R::place_low, between);
      const V same = piece == simd::all<V>(j[R::piece]) ? V{} + T(1) : V{}, R2 = dot(between, between);
      const V limit = bond + j[R::bond], both = same * bond * j[R::bond];
      const V apart = R2 > limit * limit ? both : V{};  // of one piece, and strangers
      p.own = apart > T(0) ? V{} : same;
      p.foreign = simd::any_less(p.own, V{} + T(1));
      const V holds = p.own * both;
      for (int a = 0; a < Dim; ++a) p.between[a] = between[a] = holds > T(0) ? between[a] : p.dx[a];
      distance2 = holds > T(0) ? R2 : p.r2;
      p.stretch2 = holds > T(0) ? V(p.r2 / (R2 + T(1e-20))) : V{};
    } else {
      for (int a = 0; a < Dim; ++a) between[a] = p.dx[a];
      distance2 = p.r2;
    }
  }
  /// Whether any of the candidates may be of another piece.
  bool mixed(std::span<const std::uint32_t> candidates) const {
    if constexpr (Kind.bonded) return true;
    const auto piece_of = [&](std::size_t i) { return records[i * R::size + R::piece]; };
    const T first = piece_of(cluster.begin);
    for (std::size_t i = cluster.begin; i < cluster.end; ++i)
      if (piece_of(i) != first) return true;
    for (const std::uint32_t j : candidates)
      if (piece_of(j) != first) return true;
    return false;
  }
  /// 1 in the lanes of the partner's piece, 0 in others.
  template <class Partner>
  V own(const Partner& p) const {
    if constexpr (Kind.bonded)
      return p.own;
    else
      return piece == simd::all<V>(p.record[R::piece]) ? V{} + T(1) : V{};
  }
  /// Square of the stretch of bonds that are in use.
  template <class Partner>
  V stretch2(const Partner& p) const {
    return p.pair.reach() > T(0) ? p.stretch2 : V{};
  }
  Touch<T, V, R, Dim> touch(const T* touches, double friction) const {
    const auto load = loader();
    const auto load_touch = loader(touches, R::touch_size);
    Touch<T, V, R, Dim> t;
    t.touching = load_touch(R::touching);
    t.impedance = load(R::density) * load(R::sound_speed);
    t.expansion = load(R::expansion);
    t.compression = load(R::compression);
    for (int a = 0; a < Dim; ++a) {
      t.normal[a] = load_touch(R::normal + a);
      t.velocity[a] = load(R::v + a);
    }
    for (int k = 0; k < R::stresses; ++k) t.press[k] = load_touch(R::press + k);
    t.friction = static_cast<T>(friction);
    return t;
  }

 private:
  static bool any_differs(V a, T b) {
    const V difference = a - b;
    return simd::any_less(V{}, V(difference * difference));
  }
  /// Antisymmetric bit for bit also where positions are split in two.
  static void separation(const V (&own)[Dim], const V (&own_low)[Dim], const T* j, int place, int low, V (&d)[Dim]) {
    for (int a = 0; a < Dim; ++a) {
      d[a] = j[place + a] - own[a];
      if constexpr (R::split) d[a] += j[low + a] - own_low[a];
    }
  }
};

}  // namespace ejecta::pair_detail
