#include <algorithm>

#include "particles/spatial_order.hpp"
#include "schemes/kernels.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {
constexpr double steps_ahead = 10;  ///< steps that new lists should last
/// Sorting changes the order of all sums, so it must not depend on when lists happen to be renewed: a restarted run
/// renews them at other steps, which changes nothing.
constexpr std::int64_t steps_between_sorts = 200;
}  // namespace

template <int Dim>
void neighbours(Simulation<Dim>& sim) {
  wrap_positions(sim.particles, sim.scene.boundary);
  const bool sort = sim.clock.step % steps_between_sorts == 0;
  if (!sort && sim.lists.valid(sim.particles, sim.clock.time - sim.lists_built_at)) return;
  const std::size_t cluster = cluster_size(sim.scene.numerics.precision);
  if (sort) {
    spatial_order(sim.particles, cluster, sim.order);
    sim.particles.reorder(sim.order);
    ++sim.sorts;
  }
  sim.lists.build(sim.particles,
                  {kernel_support(sim.scene.numerics.kernel), cluster, steps_ahead * sim.clock.dt, sim.scene.boundary});
  sim.lists_built_at = sim.clock.time;
  ++sim.list_builds;
}

template void neighbours<2>(Simulation<2>&);
template void neighbours<3>(Simulation<3>&);

}  // namespace ejecta
