#pragma once
/// Particle solvers whose particles somebody else has placed.
#include <functional>
#include <memory>
#include <vector>

#include "sph/placement.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// Columns allocated for what the stages name and filled by the bodies of the placements; `lay` then gives particles
/// the states that they are to have, before all stages run once. Throws SimulationError if that fails.
template <int Dim>
std::unique_ptr<Sph<Dim>> assemble(const Scene& scene, const std::vector<Material>& materials,
                                   std::vector<Stage<Dim>> stages, const std::vector<Placement<Dim>>& placements,
                                   const std::function<void(Sph<Dim>&)>& lay);

/// Material number of each body: its place in the list of materials by name.
std::vector<int> number_materials(const Scene& scene, const std::vector<Material>& materials);

}  // namespace ejecta
