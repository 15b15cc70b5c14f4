#pragma once
#include <array>
#include <string_view>

#include "scene/scene.hpp"

namespace ejecta {

/// How what particles have found comes back to the grid.
enum class Transfer { fluxes, interpolate };
constexpr auto enum_names(Transfer) { return std::to_array<std::string_view>({"fluxes", "interpolate"}); }

/// [hybrid]: where particles are, and how they and the grid tell each other.
struct HybridSettings final : SectionSettings {
  int ratio = 2;              ///< spacing of the grid over that of the particles: a power of two
  double jump = 0.5;          ///< of pressure between two cells, over the lower one, that makes a front
  double least_share = 0.2;   ///< of the highest pressure anywhere: the least jump of a front
  int ahead = 2, behind = 2;  ///< cells around a front that particles fill, towards lower and higher pressure
  int around = 3;             ///< cells around solids that particles fill
  int hysteresis = 1;         ///< cells further out that keep the particles that they have
  Transfer transfer = Transfer::fluxes;

  void describe(Describer& d) override;
};

HybridSettings hybrid_settings(const Scene& scene);

}  // namespace ejecta
