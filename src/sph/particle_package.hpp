#pragma once
#include "model/package_kind.hpp"

namespace ejecta {

/// The particles of the bodies: there in every scene.
PackageKind particle_package();

}  // namespace ejecta
