#pragma once
#include <array>
#include <string_view>

#include "scene/scene.hpp"

namespace ejecta {

enum class RiemannSolver { hllc, exact };
enum class SlopeLimiter { monotonised_central, minmod, none };

constexpr auto enum_names(RiemannSolver) { return std::to_array<std::string_view>({"hllc", "exact"}); }
constexpr auto enum_names(SlopeLimiter) {
  return std::to_array<std::string_view>({"monotonised_central", "minmod", "none"});
}

/// [grid]: how the finite volumes are solved.
struct GridSettings final : SectionSettings {
  RiemannSolver riemann = RiemannSolver::hllc;
  SlopeLimiter limiter = SlopeLimiter::monotonised_central;  ///< none: first order
  bool flattening = false;                                   ///< slopes fade inside strong shocks
  bool smearing = true;                                      ///< along strong shocks fluxes smear contacts and shear
  double courant = unset;                                    ///< not set: 0.8 in 2D, 0.45 in 3D

  void describe(Describer& d) override;
  /// The share of a crossing of a cell that a step may take.
  double courant_in(int dimension) const { return is_set(courant) ? courant : dimension == 2 ? 0.8 : 0.45; }
};

/// Those of a scene; the defaults if it has no such section.
GridSettings grid_settings(const Scene& scene);

}  // namespace ejecta
