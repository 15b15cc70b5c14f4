#pragma once
/// What cracks cut of a pair, as the lanes of a cluster see it.
#include "base/simd.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/pair_records.hpp"
#include "schemes/support.hpp"

namespace ejecta::pair_detail {

/// Damage tensors of the lanes; R: the record.
template <class T, class V, class R, int Dim, bool Cracked>
class Cracks {
 public:
  template <class Load>
  explicit Cracks(const Load& load) {
    if constexpr (Cracked)
      for (int s = 0; s < symmetric_size<Dim>; ++s) damage_[s] = load(R::damage + s);
  }
  /// The share that the cracks of either side cut off, max(n.D_i n, n.D_j n) along n = x/|x|, 0 to 1: the same number
  /// from either side. False if they cut nothing, as in most matter.
  template <class Partner>
  bool cut(const Partner& p, V& share) const {
    const Squares<V, Dim> squares(p.dx);
    share = simd::max(squares.along(damage_), squares.along(p.record + R::damage));
    if (!simd::any_less(V{}, share)) return false;
    share = simd::min(V(share * simd::reciprocal(V(p.r2 + support_detail::guard<T>))), V{} + T(1));
    return true;
  }

 private:
  V damage_[symmetric_size<Dim>]{};
};

}  // namespace ejecta::pair_detail
