#pragma once
/// What passes between pieces in contact, as the lanes of a cluster see it.
#include "base/simd.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta::pair_detail {

/// All lanes; the caller keeps to those of other pieces.
template <class T, class V, class R, int Dim>
struct Contact {
  V degree, sound_speed, impedance, expansion, compression, normal[Dim], velocity[Dim], press[R::stresses];
  T friction;

  /// Whether lane k passes stress on to others.
  bool pressed(int k) const {
    bool any = false;
    for (const V& value : press) any |= value[k] != 0;
    return any;
  }
  /// How far a pair of different pieces is in contact; 0 within a piece.
  template <class Partner>
  V weight(const Partner& p, V own) const {
    return (T(1) - own) * simd::max(degree, simd::all<V>(p.contact[R::contact]));
  }
  /// What acts on i of j and on j of i, as far as they are in contact, by the impedances rho c of both, 2 in all: as
  /// where two waves meet, the softer one decides what stress there is at the contact. A solid hardly notices the gas
  /// beside it, which feels it as a wall. Times the share that makes the weights those of volumes.
  template <class Partner>
  void shares(const Partner& p, V own, V& own_share, V& other_share) const {
    const V other = simd::all<V>(p.record[R::density] * p.record[R::sound_speed]);
    const V contact = weight(p, own), per_sum = T(2) / (impedance + other);
    other_share = impedance * per_sum * (expansion * p.record[R::compression]) * contact;
    own_share = other * per_sum * (p.record[R::expansion] * compression) * contact;
  }
  /// Factor of the flux: the mean sound speed in it is at most twice the lower one.
  template <class Partner>
  V softness(const Partner& p) const {
    const V other = simd::all<V>(p.record[R::sound_speed]);
    return simd::min(V(T(4) * simd::min(sound_speed, other) / (sound_speed + other)), V{} + T(1));
  }
  /// What closes the gap between pieces, of v.x (`along`), beyond what slides: sliding does not brake, before a
  /// particle as little as behind it, and as v.x is at most this, what acts on it heats and never cools.
  template <class Partner>
  V closing(const Partner& p, const V (&dv)[Dim], V along) const {
    V n[Dim];
    const V n2 = mean_normal(p, n), gap = dot(dv, n) * dot(p.dx, n) / (n2 + T(1e-20));
    return n2 > T(0.01) ? V(gap + simd::magnitude(V(along - gap))) : along;
  }
  /// Adds friction to the force per volume; returns half of what it heats, in single precision beyond half of its work
  /// on dv, which the pass counts with that of the other forces. The velocity of an image behind a wall is mirrored;
  /// the wall itself rests.
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
    for (int a = 0; a < Dim; ++a) n[a] = normal[a] - p.contact[R::normal + a];
    return dot(n, n);
  }
};

}  // namespace ejecta::pair_detail
