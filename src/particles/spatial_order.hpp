#pragma once
/// Order of particles in which every `cluster_size` consecutive ones form a compact cluster: within each material,
/// the range is halved at the median of its longest side, on a multiple of the cluster size, until clusters remain.
#include <cstdint>
#include <vector>

#include "particles/particles.hpp"

namespace ejecta {

/// The permutation that brings the particles into that order (for Particles::reorder). Ties are broken by particle id,
/// so the result depends on the positions alone.
template <int Dim>
void spatial_order(const Particles<Dim>& particles, std::size_t cluster_size, std::vector<std::uint32_t>& order);

}  // namespace ejecta
