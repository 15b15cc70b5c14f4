#pragma once
#include "model/package_kind.hpp"

namespace ejecta {

/// Finite volumes: numerics.scheme = "fvm", with the settings [grid].
PackageKind grid_package();

}  // namespace ejecta
