/// Apart from the time loop, so that a program may do without the list of packages.
#include "simulation/simulation.hpp"

namespace ejecta {

Simulation set_up_simulation(const Scene& scene, const std::vector<Material>& materials) {
  Simulation sim;
  sim.scene = scene;
  for (const PackageKind& kind : package_kinds())
    if (kind.in(scene)) sim.packages.push_back(kind.set_up(scene, materials));
  if (!sim.packages.empty()) sim.clock = sim.packages.front()->clock;
  return sim;
}

}  // namespace ejecta
