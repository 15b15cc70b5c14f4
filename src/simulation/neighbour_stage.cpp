#include <algorithm>

#include "particles/spatial_order.hpp"
#include "schemes/kernels.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {
constexpr double steps_ahead = 10;     ///< steps that new lists should last
constexpr double worn_out = 1.15;      ///< candidates per cluster, relative to freshly sorted, that call for a new sort
}  // namespace

template <int Dim>
void neighbours(Simulation<Dim>& sim) {
  if (sim.lists.valid(sim.particles, sim.clock.time - sim.lists_built_at)) return;
  wrap_positions(sim.particles, sim.scene.boundary);
  const std::size_t cluster = cluster_size(sim.scene.numerics.precision);
  const typename PairLists<Dim>::Settings settings{kernel_support(sim.scene.numerics.kernel), cluster,
                                                   steps_ahead * sim.clock.dt, sim.scene.boundary};
  const bool worn = sim.lists.built() && sim.lists.mean_candidates() > worn_out * sim.candidates_when_sorted;
  if (worn || sim.list_builds == 0) {
    spatial_order(sim.particles, cluster, sim.order);
    sim.particles.reorder(sim.order);
    ++sim.sorts;
  }
  sim.lists.build(sim.particles, settings);
  if (worn || sim.list_builds == 0) sim.candidates_when_sorted = sim.lists.mean_candidates();
  sim.lists_built_at = sim.clock.time;
  ++sim.list_builds;
}

template void neighbours<2>(Simulation<2>&);
template void neighbours<3>(Simulation<3>&);

}  // namespace ejecta
