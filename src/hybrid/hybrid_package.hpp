#pragma once
#include "model/package_kind.hpp"

namespace ejecta {

/// A grid with particles where fronts are: numerics.scheme = "hybrid", with the settings [hybrid] and [grid].
PackageKind hybrid_package();

}  // namespace ejecta
