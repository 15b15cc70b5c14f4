#pragma once
/// The words a scene uses for its choices, in the order of the enumerations.
#include <array>
#include <string_view>

#include "scene/scene.hpp"

namespace ejecta {

constexpr auto enum_names(Kernel) {
  return std::to_array<std::string_view>({"cubic_spline", "quintic_spline", "wendland_c2", "wendland_c4", "gaussian"});
}
constexpr auto enum_names(SchemeKind) {
  return std::to_array<std::string_view>({"sph", "asph", "fvm", "gsph", "agsph", "hybrid"});
}
constexpr auto enum_names(PairRiemann) { return std::to_array<std::string_view>({"approximate", "exact"}); }
constexpr auto enum_names(PairLimiter) {
  return std::to_array<std::string_view>({"monotonised_central", "inutsuka", "none"});
}
constexpr auto enum_names(PairFaces) { return std::to_array<std::string_view>({"renormalised", "kernel"}); }
constexpr auto enum_names(Precision) { return std::to_array<std::string_view>({"double", "mixed"}); }
constexpr auto enum_names(DensityMethod) { return std::to_array<std::string_view>({"continuity", "summation"}); }
constexpr auto enum_names(BoundaryKind) {
  return std::to_array<std::string_view>({"open", "periodic", "reflecting", "symmetry"});
}
constexpr auto enum_names(DistensionSolver) {
  return std::to_array<std::string_view>({"safe_newton", "bisection", "newton"});
}
constexpr auto enum_names(Lattice) { return std::to_array<std::string_view>({"cubic", "hexagonal", "glass"}); }
constexpr auto enum_names(BodyLattice) {
  return std::to_array<std::string_view>({"auto", "cubic", "hexagonal", "glass", "shells"});
}
constexpr auto enum_names(OnError) { return std::to_array<std::string_view>({"warn", "disable", "abort"}); }
constexpr auto enum_names(Switch) { return std::to_array<std::string_view>({"auto", "false", "true"}); }
constexpr auto enum_names(ProbeKind) {
  return std::to_array<std::string_view>({"point", "tracer", "surface", "velocimeter"});
}
constexpr auto enum_names(FragmentLink) { return std::to_array<std::string_view>({"auto", "spacing", "support"}); }

/// The word for one choice: name_of(Kernel::wendland_c2) is "wendland_c2".
template <class Enum>
constexpr std::string_view name_of(Enum value) {
  return enum_names(value)[static_cast<std::size_t>(value)];
}

}  // namespace ejecta
