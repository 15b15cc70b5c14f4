#pragma once
/// Watching small runs: what tests of hard cases ask of all of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/errors.hpp"
#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {

/// How a run went.
struct Outcome {
  std::string error;                                               ///< of the SimulationError that ended it, or ""
  double least_energy = std::numeric_limits<double>::infinity();   ///< of any particle at any step [J/kg]
  double shortest_step = std::numeric_limits<double>::infinity();  ///< s
  ConservationErrors conservation{};
};

/// Runs to its end time, but at most max_steps.
template <int Dim>
Outcome follow(Sph<Dim>& sim, int max_steps = 1000000) {
  Outcome outcome;
  const double end = sim.scene.time_end;
  try {
    for (int k = 0; k < max_steps && sim.clock.time < end * (1 - 1e-12); ++k) {
      const Vote vote = step(sim, end - sim.clock.time);
      outcome.least_energy =
          std::min(outcome.least_energy, std::ranges::min(sim.particles.column(Field::specific_energy)));
      outcome.shortest_step = std::min(outcome.shortest_step, vote.dt);
    }
  } catch (const SimulationError& error) {
    outcome.error = error.what();
  }
  outcome.conservation = conservation_errors(sim.initial, totals(sim.particles));
  return outcome;
}

/// After particles have been changed by hand: stages and totals as set_up leaves them.
template <int Dim>
void begin_from_here(Sph<Dim>& sim) {
  sim.lists.invalidate();
  evaluate(sim);
  for (int a = 0; a < Dim; ++a)
    std::ranges::copy(sim.particles.column(Field::acceleration, a),
                      sim.particles.previous(Field::acceleration, a).begin());
  sim.initial = totals(sim.particles);
}

/// The message of the InputError or SimulationError of a scene, or "" if it can be set up and makes a step.
template <int Dim>
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const auto sim = start<Dim>(text, overrides);
    step(*sim, no_limit);
  } catch (const InputError& error) {
    return std::string("InputError: ") + error.what();
  } catch (const SimulationError& error) {
    return std::string("SimulationError: ") + error.what();
  }
  return "";
}

inline bool mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

template <int Dim>
double top_speed(const Particles<Dim>& p) {
  double fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) fastest = std::max(fastest, p.vector(Field::velocity, i).norm());
  return fastest;
}

}  // namespace ejecta
