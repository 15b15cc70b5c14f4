#pragma once
/// The members of a cluster in their lanes, and how a partner looks from there.
#include <algorithm>
#include <span>

#include "base/simd.hpp"
#include "particles/pair_lists.hpp"
#include "schemes/contact.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta::pair_detail {

/// What a bonded pass adds to a partner.
template <class V, int Dim, bool Bonded>
struct Bond {};
template <class V, int Dim>
struct Bond<V, Dim, true> {
  V between[Dim], own, stretch2;  ///< separation that the kernel sees; 1 for neighbours; of a bond, else 0
};

/// What the loop keeps of a candidate from one body to the next: as little as it can, for stores take the time of
/// multiplications.
template <class T, class V, int Dim, RecordKind Kind, class Pair>
struct Candidate : Bond<V, Dim, Kind.bonded> {
  V r2;     ///< square of |x_j - x_i|
  V along;  ///< v.x, from the first body on
  Pair pair;
  const T *record, *contact = nullptr;  ///< contact: only with contacts
  bool foreign = false;                 ///< in some lane of another piece; only with contacts
};

/// A candidate as the lanes of a cluster see it.
template <class T, class V, int Dim, RecordKind Kind, class Pair>
struct Partner {
  using Kept = Candidate<T, V, Dim, Kind, Pair>;
  Kept& kept;
  V dx[Dim];  ///< x_j - x_i
  const V& r2 = kept.r2;
  V& along = kept.along;
  const Pair& pair = kept.pair;
  const T *record = kept.record, *contact = kept.contact;
  bool foreign = kept.foreign;

  template <class Members>
  Partner(Kept& k, const Members& members) : kept(k) {
    members.separation(record, dx);
  }

  /// Bit k: lane k reaches the partner, or the partner lane k.
  unsigned lanes_reached() const { return simd::lanes_less(V{}, pair.reach()); }
  bool reached() const { return lanes_reached() != 0; }
  /// Square of the separation at which the kernel is taken.
  V distance2() const {
    if constexpr (Kind.bonded)
      return dot(kept.between, kept.between);
    else
      return r2;
  }
  /// What the kernel gradient is along the pair, over its length; of a bond along itself, which may have turned since.
  V central() const {
    if constexpr (Kind.bonded)
      return pair.central(kept.between, dot(kept.between, kept.between));
    else
      return pair.central(dx, r2);
  }
  /// The kernel gradient times a factor.
  template <class Factor = T>
  void kernel_gradient(V (&g)[Dim], Factor factor = 1) const {
    if constexpr (Kind.bonded)
      pair.gradient(kept.between, factor, g);
    else
      pair.gradient(dx, factor, g);
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

  /// x_j - x_i
  void separation(const T* j, V (&dx)[Dim]) const { separation(x, x_low, j, R::x, R::x_low, dx); }
  /// Looks at the candidate of p.record: `between` is the separation at which the kernel is taken, and its square.
  template <bool Contacts, class Candidate>
  void meet(Candidate& p, V (&between)[Dim], V& distance2) const {
    const T* j = p.record;
    V dx[Dim];
    separation(j, dx);
    p.r2 = dot(dx, dx);
    if constexpr (Contacts) p.foreign = any_differs(piece, j[R::piece]);
    if constexpr (Kind.bonded) {
      separation(place, place_low, j, R::place, R::place_low, between);
      const V same = piece == simd::all<V>(j[R::piece]) ? V{} + T(1) : V{}, R2 = dot(between, between);
      const V limit = bond + j[R::bond], both = same * bond * j[R::bond];
      const V apart = R2 > limit * limit ? both : V{};  // of one piece, and strangers
      p.own = apart > T(0) ? V{} : same;
      p.foreign = simd::any_less(p.own, V{} + T(1));
      const V holds = p.own * both;
      for (int a = 0; a < Dim; ++a) p.between[a] = between[a] = holds > T(0) ? between[a] : dx[a];
      distance2 = holds > T(0) ? R2 : p.r2;
      p.stretch2 = holds > T(0) ? V(p.r2 / (R2 + T(1e-20))) : V{};
    } else {
      for (int a = 0; a < Dim; ++a) between[a] = dx[a];
      distance2 = p.r2;
    }
  }
  /// 1 in the lanes of the partner's piece, 0 in others.
  template <class Partner>
  V own(const Partner& p) const {
    if constexpr (Kind.bonded)
      return p.kept.own;
    else
      return piece == simd::all<V>(p.record[R::piece]) ? V{} + T(1) : V{};
  }
  /// Square of the stretch of bonds that are in use.
  template <class Partner>
  V stretch2(const Partner& p) const {
    return p.pair.reach() > T(0) ? p.kept.stretch2 : V{};
  }
  Contact<T, V, R, Dim> contact(const T* contacts, double friction) const {
    const auto load = loader();
    const auto load_contact = loader(contacts, R::contact_size);
    Contact<T, V, R, Dim> t;
    t.degree = load_contact(R::contact);
    t.sound_speed = load(R::sound_speed);
    t.impedance = load(R::density) * t.sound_speed;
    t.expansion = load(R::expansion);
    t.compression = load(R::compression);
    for (int a = 0; a < Dim; ++a) {
      t.normal[a] = load_contact(R::normal + a);
      t.velocity[a] = load(R::v + a);
    }
    for (int k = 0; k < R::stresses; ++k) t.press[k] = load_contact(R::press + k);
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
