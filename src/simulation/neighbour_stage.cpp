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
void renew_lists(Simulation<Dim>& sim) {
  if (sim.lists.valid(sim.particles, sim.clock.time - sim.lists_built_at)) return;
  const Numerics& numerics = sim.scene.numerics;
  sim.lists.build(sim.particles, {kernel_support(numerics.kernel), cluster_size(numerics.precision),
                                  steps_ahead * sim.clock.dt, sim.scene.boundary});
  sim.lists_built_at = sim.clock.time;
  ++sim.list_builds;
}

template <int Dim>
void neighbours(Simulation<Dim>& sim) {
  wrap_positions(sim.particles, sim.scene.boundary);
  if (sim.clock.step % steps_between_sorts == 0) {
    spatial_order(sim.particles, cluster_size(sim.scene.numerics.precision), sim.order);
    sim.particles.reorder(sim.order);
    sim.lists.invalidate();
    ++sim.sorts;
  }
  renew_lists(sim);
}

template void renew_lists<2>(Simulation<2>&);
template void renew_lists<3>(Simulation<3>&);
template void neighbours<2>(Simulation<2>&);
template void neighbours<3>(Simulation<3>&);

}  // namespace ejecta
