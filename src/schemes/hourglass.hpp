#pragma once
/// What keeps bonded particles to the deformation that they share with their neighbours. Gradients that are exact for
/// linear fields see nothing of a pattern that alternates from one particle to the next; in matter that is compressed
/// by bending such patterns grow until particles sit on one another. Against them bonds act as springs [Ganzenmueller
/// 2015, Comput. Methods Appl. Mech. Eng. 286, 87], here by the pressure along the pair
///   p_ij = 1/2 [k_i (x.F_i X/r^2 - 1) + k_j (x.F_j X/r^2 - 1)],   k = hourglass_stiffness rho c^2,
/// X the separation at the start and F_i = M_i(x) M_i(X)^-1 what the particle takes for the deformation since (M:
/// PairPass::rates). Where that is uniform p_ij is 0, exactly: what is in brackets counts from hourglass_onset on,
/// so that waves, and matter that flies undisturbed, get neither stiffness nor noise from their bonds.
#include <type_traits>

#include "base/simd.hpp"
#include "schemes/lane_algebra.hpp"

namespace ejecta {

/// Rings of rubber that bounce come apart without, and from this to 2 are alike (docs/pair_pass.md). More of it
/// stiffens a stretched strip: by 0.2 % as it is, 0.5 % at 0.1.
inline constexpr double hourglass_stiffness = 0.02;
/// Patterns of this strain do no harm.
inline constexpr double hourglass_onset = 1e-4;

namespace pair_detail {

/// Springs of the lanes of a cluster; R: the record.
template <class T, class V, class R, int Dim>
struct Hourglass {
  V deformation[Dim * Dim], stiffness;

  template <class Load>
  explicit Hourglass(const Load& load) : stiffness(load(R::stiffness)) {
    for (int k = 0; k < Dim * Dim; ++k) deformation[k] = load(R::deformation + k);
  }
  /// p_ij of lanes that hold on to the partner, 0 in others; the same number seen from either side.
  template <class Partner>
  V pressure(const Partner& p) const {
    const T* j = p.record;
    const V per_r2 = simd::reciprocal(V(p.r2 + T(1e-20)));
    const V ours = pull(deformation, stiffness, p, per_r2),
            theirs = pull(j + R::deformation, simd::all<V>(j[R::stiffness]), p, per_r2);
    return p.kept.stretch2 > T(0) ? V(ours + theirs) : V{};
  }

 private:
  /// k/2 (x.F X/r^2 - 1). The separation of the other side is the negative.
  template <class Tensor, class Partner>
  static V pull(const Tensor& F, V half_k, const Partner& p, V per_r2) {
    V along{};
    for (int a = 0; a < Dim; ++a) {
      V image = F[a * Dim] * p.kept.between[0];
      for (int b = 1; b < Dim; ++b) image = simd::fused(V(F[a * Dim + b] - V{}), p.kept.between[b], image);
      along = simd::fused(image, p.dx[a], along);
    }
    const V off = simd::rounded(V(along * per_r2)) - T(1);
    constexpr T onset = T(hourglass_onset);
    return simd::rounded(V(half_k * (simd::max(V(off - onset), V{}) + simd::min(V(off + onset), V{}))));
  }
};

/// Nothing without bonds.
template <bool Bonded, class T, class V, class R, int Dim, class Load>
auto hourglass_of(const Load& load) {
  if constexpr (Bonded)
    return Hourglass<T, V, R, Dim>(load);
  else
    return std::false_type{};
}

}  // namespace pair_detail
}  // namespace ejecta
