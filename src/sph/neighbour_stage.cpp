#include <algorithm>

#include "particles/spatial_order.hpp"
#include "schemes/kernels.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {
constexpr double steps_ahead = 10;  ///< steps that new lists should last
/// Sorting changes the order of all sums, so it must not depend on when lists happen to be renewed: a restarted run
/// renews them at other steps, which changes nothing.
constexpr std::int64_t steps_between_sorts = 200;
}  // namespace

double list_reach(const Numerics& numerics) {
  return kernel_support(numerics.kernel) * (is_set(numerics.pilot_width) ? numerics.pilot_width : 1);
}

template <int Dim>
void renew_lists(Sph<Dim>& sph) {
  if (sph.lists.valid(sph.particles, sph.clock.time - sph.lists_built_at)) return;
  const Numerics& numerics = sph.scene.numerics;
  sph.lists.build(sph.particles, {list_reach(numerics), cluster_size(numerics.precision), steps_ahead * sph.clock.dt,
                                  sph.scene.boundary});
  sph.lists_built_at = sph.clock.time;
  ++sph.list_builds;
}

template <int Dim>
StageWork<Dim> neighbours() {
  const auto order = std::make_shared<std::vector<std::uint32_t>>();
  const auto run = [order](Sph<Dim>& sph) {
    wrap_positions(sph.particles, sph.scene.boundary);
    if (sph.clock.step % steps_between_sorts == 0) {
      spatial_order(sph.particles, cluster_size(sph.scene.numerics.precision), *order);
      sph.particles.reorder(*order);
      sph.lists.invalidate();
      ++sph.sorts;
    }
    renew_lists(sph);
  };
  return {run, [order] { return order->capacity() * sizeof(std::uint32_t); }};
}

template void renew_lists<2>(Sph<2>&);
template void renew_lists<3>(Sph<3>&);
template StageWork<2> neighbours<2>();
template StageWork<3> neighbours<3>();

}  // namespace ejecta
