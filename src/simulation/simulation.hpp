#pragma once
/// The time loop: it knows packages and observers, and nothing of what they solve or show.
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "model/package_kind.hpp"
#include "scene/scene.hpp"

namespace ejecta {

struct Simulation {
  Scene scene;
  std::vector<std::unique_ptr<Package>> packages;
  Clock clock;                     ///< at which all packages have arrived
  Vote vote{.reason = "start"};    ///< that won the last step
  Whereabouts limited;             ///< where its culprit was then; steps may put particles in another order
  StageTimers timers;              ///< of observers
  double wall_seconds = 0;         ///< spent in steps so far, before restarts too
  double insitu_seconds = 0;       ///< spent in in-situ work so far, before restarts too
  std::map<std::string, double> notes;  ///< what observers remember; checkpoints keep it
};

/// The packages that a scene asks for, set up. Throws as PackageKind::set_up does.
Simulation set_up_simulation(const Scene& scene, const std::vector<Material>& materials);

/// The package of a type, for those who look at one solver alone; null if it is not there.
template <class Solver>
const Solver* find_package(const Simulation& sim) {
  for (const auto& package : sim.packages) {
    if (const auto* found = dynamic_cast<const Solver*>(package.get())) return found;
    for (const Package* part : package->parts())
      if (const auto* found = dynamic_cast<const Solver*>(part)) return found;
  }
  return nullptr;
}
/// The same where it must be there. Throws std::bad_cast.
template <class Solver>
const Solver& package_of(const Simulation& sim) {
  if (const auto* found = find_package<Solver>(sim)) return *found;
  throw std::bad_cast{};
}

/// Watches the run from outside: images, tables, checkpoints.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Simulated time the next observation is due [s]; steps are clipped to it. Infinity: none in particular.
  virtual double next_time() const { return std::numeric_limits<double>::infinity(); }
  /// Called after every step, before the first, and with `last` after the last or when the run is cut short.
  virtual void observe(Simulation& sim, bool last) = 0;
};

/// The ledgers of all packages as one.
Totals initial(const Simulation& sim);
Totals conserved(const Simulation& sim);
ExternalLoad external(const Simulation& sim);
Kept kept(const Simulation& sim);

/// Steps of single elements of all packages so far.
double element_steps(const Simulation& sim);

/// Time, step, ledger, and what the packages have to say.
Quantities quantities(const Simulation& sim);

/// Wall times of packages and observers, in order of first use.
std::vector<StageTimers::Entry> wall_times(const Simulation& sim);

/// Advances all packages by one step of at most dt_limit [s]. Throws SimulationError.
void step(Simulation& sim, double dt_limit);
/// The same for a package on its own. Returns the vote.
Vote step(Package& package, const Scene& scene, double dt_limit);

/// Steps until the end time, which stop() may change, the step limit, or until stop() says so; calls the observers.
/// Returns true if the end was reached. Throws SimulationError; the state is then that of the failed step.
bool run(Simulation& sim, const std::vector<Observer*>& observers, const std::function<bool()>& stop);

}  // namespace ejecta
