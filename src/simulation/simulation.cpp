#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "base/errors.hpp"
#include "simulation/integrator.hpp"
#include "simulation/time_step.hpp"

namespace ejecta {

namespace {
/// A step this much shorter than the run is a run that does not end.
constexpr double least_relative_step = 1e-10;
constexpr std::int64_t steps_between_energy_checks = 20;
}  // namespace

template <int Dim>
void evaluate(Simulation<Dim>& sim) {
  for (const Stage<Dim>& stage : sim.stages) {
    sim.timers.time(stage.name, [&] { stage.run(sim); });
  }
}

template <int Dim>
void step(Simulation<Dim>& sim, double dt_limit) {
  Clock& clock = sim.clock;
  sim.timers.time("time step", [&] { sim.vote = vote_time_step(sim); });
  if (!(sim.vote.dt > least_relative_step * sim.scene.time_end))
    throw SimulationError(fmt::format("time {:.6g} s, step {}: the time step has collapsed to {:.3g} s by the {} of {}",
                                      clock.time, clock.step, sim.vote.dt, sim.vote.reason,
                                      sim.vote.particle < sim.particles.size()
                                          ? describe_particle(sim, sim.vote.particle)
                                          : std::string("no particle")));
  const double dt = std::min(sim.vote.dt, dt_limit);
  sim.timers.time("integration", [&] { predict(sim.particles, dt, clock.dt); });
  clock.dt = dt;
  clock.time += dt;
  ++clock.step;
  const ExternalLoad before = sim.external;
  evaluate(sim);
  sim.timers.time("integration", [&] { correct(sim.particles, dt); });
  add_step(sim.external, before, sim.external, dt);
  sim.timers.time("health", [&] {
    check_health(sim, "correction");
    if (clock.step % steps_between_energy_checks != 0) return;
    const double drift = conservation_errors(sim.initial, totals(sim.particles), sim.external).energy;
    if (!(std::abs(drift) <= sim.scene.numerics.max_energy_drift))  // so that no number at all is caught too
      throw SimulationError(
          fmt::format("time {:.6g} s, step {}: total energy has drifted by {:.3g} of its value "
                      "(numerics.max_energy_drift = {:.3g})",
                      clock.time, clock.step, drift, sim.scene.numerics.max_energy_drift));
  });
}

template <int Dim>
bool run(Simulation<Dim>& sim, const std::vector<Observer<Dim>*>& observers, bool (*stop)()) {
  const double end = sim.scene.time_end, round_off = 1e-12 * end;
  auto observe = [&](bool last) {
    for (Observer<Dim>* observer : observers) observer->observe(sim, last);
  };
  auto finished = [&] {
    return sim.clock.time >= end - round_off || (sim.scene.max_steps > 0 && sim.clock.step >= sim.scene.max_steps);
  };
  while (!finished()) {
    if (stop()) {
      observe(true);
      return false;
    }
    observe(false);
    double limit = end - sim.clock.time;
    for (const Observer<Dim>* observer : observers)
      if (const double wait = observer->next_time() - sim.clock.time; wait > round_off) limit = std::min(limit, wait);
    const auto start = std::chrono::steady_clock::now();
    step(sim, limit);
    sim.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  observe(true);
  return true;
}

template void evaluate<2>(Simulation<2>&);
template void evaluate<3>(Simulation<3>&);
template void step<2>(Simulation<2>&, double);
template void step<3>(Simulation<3>&, double);
template bool run<2>(Simulation<2>&, const std::vector<Observer<2>*>&, bool (*)());
template bool run<3>(Simulation<3>&, const std::vector<Observer<3>*>&, bool (*)());

}  // namespace ejecta
