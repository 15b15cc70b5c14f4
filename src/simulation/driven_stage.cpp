#include "base/parallel.hpp"
#include "simulation/particle_state.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

template <int Dim>
void driven_bodies(Simulation<Dim>& sim) {
  Particles<Dim>& p = sim.particles;
  const ExternalLoad load = holding_load(p, sim.scene);
  sim.external.force = load.force;
  sim.external.torque = load.torque;
  sim.external.power = load.power;
  parallel_for(0, p.size(), [&](std::size_t i) {
    if (driven(p, sim.scene, i)) p.set_vector(Field::acceleration, i, Vec<Dim>::Zero());
  });
}

template void driven_bodies<2>(Simulation<2>&);
template void driven_bodies<3>(Simulation<3>&);

}  // namespace ejecta
