#pragma once
/// How much a neighbour counts: by its mass, or by its volume where densities differ much.
#include <algorithm>
#include <cmath>

#include "base/simd.hpp"

namespace ejecta::pair_detail {

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
  T limit, least, most;  ///< of the expansion of such a partner

  Alike(double alike, V expansion, V compression) : limit(static_cast<T>(alike)) {
    T expanded = 0, compressed = 0;  // the most of all lanes
    for (int k = 0; k < simd::lanes<T>; ++k) {
      expanded = std::max(expanded, expansion[k]);
      compressed = std::max(compressed, compression[k]);
    }
    // Where x + 1/x reaches the limit, a little less.
    const T ratio = alike > 2 ? static_cast<T>(0.999 * 0.5 * (alike + std::sqrt(alike * alike - 4))) : T(0);
    least = expanded / ratio;
    most = ratio / compressed;
  }
  bool with(const T* j) const { return j[R::expansion] > least && j[R::expansion] < most; }
};

}  // namespace ejecta::pair_detail
