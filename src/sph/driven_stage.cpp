#include "base/parallel.hpp"
#include "sph/diagnostics.hpp"
#include "sph/particle_state.hpp"
#include "sph/stages.hpp"

namespace ejecta {

template <int Dim>
void driven_bodies(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const ExternalLoad load = holding_load(p, sph.scene);
  sph.external.force = load.force;
  sph.external.torque = load.torque;
  sph.external.power = load.power;
  parallel_for(0, p.size(), [&](std::size_t i) {
    if (driven(p, sph.scene, i)) p.set_vector(Field::acceleration, i, Vec<Dim>::Zero());
  });
}

template void driven_bodies<2>(Sph<2>&);
template void driven_bodies<3>(Sph<3>&);

}  // namespace ejecta
