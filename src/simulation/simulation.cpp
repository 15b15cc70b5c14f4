#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include "base/errors.hpp"

namespace ejecta {

namespace {

/// A step this much shorter than the run is a run that does not end.
constexpr double least_relative_step = 1e-10;
constexpr std::int64_t steps_between_energy_checks = 20;

using Packages = std::span<Package* const>;

struct Winner {
  Vote vote;
  const Package* voter = nullptr;
  Whereabouts where;
};

Winner count_votes(Packages packages) {
  Winner winner;
  for (Package* package : packages)
    if (const Vote vote = package->vote(); !winner.voter || vote.dt < winner.vote.dt) winner = {vote, package, {}};
  if (winner.voter && winner.vote.culprit != Vote::nobody)
    winner.where = winner.voter->whereabouts(winner.vote.culprit);
  return winner;
}

/// Throws if a sum is no number, whatever made it so: no state of the packages can be trusted then.
void check_finite(const Totals& now, const Clock& clock) {
  const std::pair<const char*, double> sums[] = {{"mass", now.mass},
                                                 {"momentum", now.momentum.sum()},
                                                 {"angular momentum", now.angular_momentum.sum()},
                                                 {"kinetic energy", now.kinetic},
                                                 {"internal energy", now.internal}};
  for (const auto& [name, sum] : sums)
    if (!std::isfinite(sum))
      throw SimulationError(fmt::format("time {:.6g} s, step {}: the {} of everything is not a finite number ({:.3g})",
                                        clock.time, clock.step, name, sum));
}

void check_ledger(Packages packages, const Clock& clock, double most) {
  Totals initial, now;
  ExternalLoad load;
  for (const Package* package : packages) {
    initial += package->initial;
    now += package->conserved();
    load += package->external;
  }
  check_finite(now, clock);
  const double drift = conservation_errors(initial, now, load).energy;
  if (!(std::abs(drift) <= most))
    throw SimulationError(
        fmt::format("time {:.6g} s, step {}: total energy has drifted by {:.3g} of its value "
                    "(numerics.max_energy_drift = {:.3g})",
                    clock.time, clock.step, drift, most));
}

Winner step_together(Packages packages, Clock& clock, StageTimers& timers, const Scene& scene, double dt_limit) {
  if (clock.step == 0) check_ledger(packages, clock, scene.numerics.max_energy_drift);
  const Winner winner = count_votes(packages);
  if (!(winner.vote.dt > least_relative_step * scene.time_end))
    throw SimulationError(fmt::format(
        "time {:.6g} s, step {}: the time step has collapsed to {:.3g} s by the {} of {}", clock.time, clock.step,
        winner.vote.dt, winner.vote.reason,
        winner.vote.culprit == Vote::nobody ? "nobody in particular" : winner.voter->describe(winner.vote.culprit)));
  const double dt = std::min(winner.vote.dt, dt_limit);
  clock.dt = dt;
  clock.before = clock.time;
  clock.time += dt;
  ++clock.step;
  for (Package* package : packages) package->advance(dt);
  timers.time("health", [&] {
    for (const Package* package : packages) package->check_health();
    if (clock.step % steps_between_energy_checks == 0) check_ledger(packages, clock, scene.numerics.max_energy_drift);
  });
  return winner;
}

std::vector<Package*> pointers(const Simulation& sim) {
  std::vector<Package*> list;
  for (const auto& package : sim.packages) list.push_back(package.get());
  return list;
}

}  // namespace

Totals initial(const Simulation& sim) {
  Totals sum;
  for (const auto& package : sim.packages) sum += package->initial;
  return sum;
}

Totals conserved(const Simulation& sim) {
  Totals sum;
  for (const auto& package : sim.packages) sum += package->conserved();
  return sum;
}

ExternalLoad external(const Simulation& sim) {
  ExternalLoad sum;
  for (const auto& package : sim.packages) sum += package->external;
  return sum;
}

Kept kept(const Simulation& sim) {
  Kept all;
  for (const auto& package : sim.packages) {
    all.momentum &= package->kept().momentum;
    all.angular_momentum &= package->kept().angular_momentum;
  }
  return all;
}

double element_steps(const Simulation& sim) {
  double sum = 0;
  for (const auto& package : sim.packages) sum += package->element_steps();
  return sum;
}

std::vector<StageTimers::Entry> wall_times(const Simulation& sim) {
  std::vector<StageTimers::Entry> all;
  const auto add = [&](const Package& package) {
    all.insert(all.end(), package.timers.entries().begin(), package.timers.entries().end());
  };
  for (const auto& package : sim.packages) {
    add(*package);
    for (const Package* part : package->parts()) add(*part);
  }
  all.insert(all.end(), sim.timers.entries().begin(), sim.timers.entries().end());
  return all;
}

void step(Simulation& sim, double dt_limit) {
  const Winner winner = step_together(pointers(sim), sim.clock, sim.timers, sim.scene, dt_limit);
  sim.vote = winner.vote;
  sim.limited = winner.where;
}

Vote step(Package& package, const Scene& scene, double dt_limit) {
  Package* const alone[] = {&package};
  Clock clock = package.clock;
  return step_together(alone, clock, package.timers, scene, dt_limit).vote;
}

bool run(Simulation& sim, const std::vector<Observer*>& observers, const std::function<bool()>& stop) {
  auto observe = [&](bool last) {
    for (Observer* observer : observers) observer->observe(sim, last);
  };
  auto finished = [&] {
    return sim.clock.time >= sim.scene.time_end * (1 - 1e-12) ||
           (sim.scene.max_steps && sim.clock.step >= *sim.scene.max_steps);
  };
  while (!finished()) {
    if (stop()) {
      observe(true);
      return false;
    }
    observe(false);
    const double end = sim.scene.time_end, round_off = 1e-12 * end;
    double limit = end - sim.clock.time;
    for (const Observer* observer : observers)
      if (const double wait = observer->next_time() - sim.clock.time; wait > round_off) limit = std::min(limit, wait);
    const auto start = std::chrono::steady_clock::now();
    step(sim, limit);
    sim.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  observe(true);
  return true;
}

}  // namespace ejecta
