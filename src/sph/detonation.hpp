#pragma once
/// When a detonation reaches each particle.
#include <vector>

#include "sph/placement.hpp"

namespace ejecta {

/// Time at which the detonation reaches each particle of an explosive [s], by Huygens: along the quickest way from a
/// detonator through explosives, each at its own detonation speed. Where the straight way stays within one explosive
/// the time is exact; where it is cut off, the detonation turns at the particle nearest to the corner, and is late by
/// less than a spacing's worth at each. Infinite where no way leads to; 0 in other matter. Bodies are taken as they
/// stand at the start; no way leads through periodic faces. Throws InputError for a detonator that touches no
/// explosive.
template <int Dim>
std::vector<double> lighting_times(const Scene& scene, const std::vector<Material>& materials,
                                   const std::vector<Placement<Dim>>& placements);

}  // namespace ejecta
