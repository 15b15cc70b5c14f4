#pragma once
/// The state of a run and the loop that advances it.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/timers.hpp"
#include "material/material.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"
#include "schemes/ideal_h.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/support_size.hpp"
#include "simulation/diagnostics.hpp"
#include "simulation/outset.hpp"

namespace ejecta {

template <int Dim>
struct Simulation;

/// One line of the algorithm: what it reads, what it writes, what it does. A stage is in the list only if the scene
/// asks for it, and a column exists only if a stage names it.
template <int Dim>
struct Stage {
  std::string name;
  std::vector<Field> reads, writes;
  void (*run)(Simulation<Dim>&);
};

/// The smallest of the time steps the stages can bear, and who asked for it.
struct TimeStepVote {
  double dt;  ///< s
  std::string_view reason;
  std::size_t particle;  ///< index, or size() if nobody
};

struct Clock {
  double time = 0;  ///< s
  double dt = 0;    ///< last step [s]
  std::int64_t step = 0;
};

/// Watches the run from outside: images, tables, checkpoints.
template <int Dim>
class Observer {
 public:
  virtual ~Observer() = default;
  /// Simulated time the next observation is due [s]; steps are clipped to it. Infinity: none in particular.
  virtual double next_time() const = 0;
  /// Called after every step, before the first, and with `last` after the last or when the run is cut short.
  virtual void observe(Simulation<Dim>& sim, bool last) = 0;
};

/// How often a particle voted on the shape of its H during a run, and how often a limit acted on the result.
struct ShapeReport {
  std::int64_t votes = 0;           ///< particles times votes
  std::int64_t few_neighbours = 0;  ///< kept the shape that moved with the flow
  std::int64_t limited_change = 0;  ///< moved only part of the way
  std::int64_t largest_aspect = 0;  ///< held at numerics.largest_aspect
  ShapeReport& operator+=(const ShapeReport& o) {
    votes += o.votes;
    few_neighbours += o.few_neighbours;
    limited_change += o.limited_change;
    largest_aspect += o.largest_aspect;
    return *this;
  }
};

/// Particles, then images, while they vote.
template <int Dim>
struct ShapeScratch {
  struct Place {
    Vec<Dim> x;
    double material;
  };
  std::vector<Place> places;
  std::vector<ShapeVote<Dim>> votes;
  std::vector<int> neighbours;  ///< of the particles
  std::vector<double> lengths;
  std::size_t bytes() const {
    return lengths.capacity() * sizeof(double) + places.capacity() * sizeof(Place) +
           votes.capacity() * sizeof(ShapeVote<Dim>) + neighbours.capacity() * sizeof(int);
  }
};

template <int Dim>
struct Simulation {
  Scene scene;
  std::vector<Material> materials;  ///< by material number (Label::material)
  std::vector<int> body_material;   ///< material number of each body
  Particles<Dim> particles;
  std::vector<Stage<Dim>> stages;
  PairLists<Dim> lists;
  std::unique_ptr<PairPass<Dim>> pass;
  std::unique_ptr<SupportSize> support;
  std::vector<double> intact;        ///< share of the deviator that damage leaves; empty without damage
  std::vector<std::uint32_t> order;  ///< scratch of the spatial sort
  ShapeScratch<Dim> shape_scratch;
  ShapeReport shape_report;
  double lists_built_at = 0;  ///< s
  std::int64_t list_builds = 0, sorts = 0;
  std::int64_t unconverged = 0;  ///< particle-steps in which the distension solver failed (plain Newton may)
  Clock clock;
  TimeStepVote vote{0, "start", 0};
  Totals initial;         ///< conserved quantities at the start
  Outset outset;          ///< of a fresh set-up; a restart makes it again
  ExternalLoad external;  ///< on driven bodies
  StageTimers timers;
  double wall_seconds = 0;  ///< spent in steps so far
};

/// Sets a scene up: bodies filled, columns allocated, flaws drawn, stages chosen and evaluated once at t = 0.
/// Throws InputError if two bodies overlap or a body holds no particle, SimulationError if the first evaluation fails.
template <int Dim>
std::unique_ptr<Simulation<Dim>> set_up(const Scene& scene, const std::vector<Material>& materials);

/// Runs all stages on the present (predicted) state.
template <int Dim>
void evaluate(Simulation<Dim>& sim);

/// Advances by one step of at most dt_limit [s]. Throws SimulationError.
template <int Dim>
void step(Simulation<Dim>& sim, double dt_limit);

/// Steps until the end time, the step limit, or until stop() says so; calls the observers. Returns true if the end was
/// reached. Throws SimulationError; the state is then that of the failed step.
template <int Dim>
bool run(Simulation<Dim>& sim, const std::vector<Observer<Dim>*>& observers, bool (*stop)());

}  // namespace ejecta
