#pragma once
#include "model/package_kind.hpp"

namespace ejecta {

/// The particles of the bodies: numerics.scheme = "sph" or "asph".
PackageKind particle_package();

/// Their expected costs.
Estimate estimate_particles(const Scene& scene, const std::vector<Material>& materials);

}  // namespace ejecta
