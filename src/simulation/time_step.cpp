#include "simulation/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "particles/smoothing_metric.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

template <int Dim>
TimeStepVote vote_time_step(const Simulation<Dim>& sim) {
  const Particles<Dim>& p = sim.particles;
  const Numerics& numerics = sim.scene.numerics;
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto h = p.column(Field::smoothing_length), sound = p.column(Field::sound_speed),
             approach = p.column(Field::approach_speed);
  const bool compresses = p.has(Field::compression_rate);
  // What a signal crosses first: the shortest axis of a smoothing ellipsoid. Where gradients are exact, it is no longer
  // than at the start: a particle with few neighbours widens h, but those that it has are as near as before, and as
  // stiff.
  const bool tensor = p.has(Field::smoothing_metric);
  const double longest =
      corrects_gradients(sim.scene, sim.materials) ? numerics.nodes_per_h * sim.scene.spacing : never;
  const auto body = p.label(Label::body);
  auto within = [&](std::size_t i, double length) {
    return std::min(length, longest * sim.scene.bodies[static_cast<std::size_t>(body[i])].spacing_factor);
  };
  auto crossing = [&](std::size_t i) {
    return within(i, tensor ? axes_of<Dim>(p.symmetric(Field::smoothing_metric, i)).shortest : h[i]);
  };
  // One pass over the particles finds the smallest; the reason is worked out for that particle alone.
  auto courant = [&](std::size_t i, double length) {
    // What the viscosity takes from a difference of velocities grows by alpha c + 2 beta mu: the quadratic term counts
    // twice. Monaghan (1992) counts it once; cold matter of low sound speed then overshoots, and loses its energy.
    const double viscous = numerics.viscosity_alpha * sound[i] + 2 * numerics.viscosity_beta * approach[i];
    return length / (sound[i] + 0.6 * viscous);
  };
  auto acceleration = [&](std::size_t i, double length) {
    return std::sqrt(length / p.vector(Field::acceleration, i).norm());
  };
  auto compression = [&](std::size_t i) {
    return compresses ? 1 / std::abs(p.column(Field::compression_rate)[i]) : never;
  };
  auto shortest = [&](std::size_t i, double length) {
    return std::min({courant(i, length), acceleration(i, length), compression(i)});
  };
  // Bounds on the axes tell most particles apart from the one sought, and spare them the eigenvalues.
  auto bound = [&](std::size_t i) {
    return shortest(i, within(i, tensor ? shortest_axis_bound<Dim>(p.symmetric(Field::smoothing_metric, i)) : h[i]));
  };
  IndexedMin least = parallel_min(p.size(), never, bound);
  if (tensor && least.index < p.size()) {
    const double known = shortest(least.index, crossing(least.index));
    least = parallel_min(p.size(), never,
                         [&](std::size_t i) { return bound(i) > known ? never : shortest(i, crossing(i)); });
  }
  if (least.index == p.size()) return {never, "end of run", p.size()};
  const double length = crossing(least.index);
  const std::string_view reason = least.value == courant(least.index, length)        ? "Courant condition"
                                  : least.value == acceleration(least.index, length) ? "acceleration"
                                                                                     : "compression";
  return {numerics.courant * least.value, reason, least.index};
}

template <int Dim>
std::string describe_particle(const Simulation<Dim>& sim, std::size_t i) {
  const Particles<Dim>& p = sim.particles;
  auto components = [&](Field f) {
    std::string text;
    for (int a = 0; a < Dim; ++a) text += fmt::format("{}{:.6g}", a ? ", " : "", p.column(f, a)[i]);
    return text;
  };
  const auto body = static_cast<std::size_t>(p.label(Label::body)[i]);
  const auto material = static_cast<std::size_t>(p.label(Label::material)[i]);
  return fmt::format(
      "particle {} (body \"{}\", material \"{}\") at ({}) m, velocity ({}) m/s, density {:.6g} kg/m^3, specific energy "
      "{:.6g} J/kg, smoothing length {:.6g} m",
      p.label(Label::id)[i], sim.scene.bodies[body].name, sim.materials[material].name, components(Field::position),
      components(Field::velocity), p.column(Field::density)[i], p.column(Field::specific_energy)[i],
      p.column(Field::smoothing_length)[i]);
}

namespace {

/// The first stage that wrote something not finite to the particle, else where the failure was noticed.
template <int Dim>
std::string origin_of_failure(const Simulation<Dim>& sim, std::size_t i, std::string_view noticed) {
  for (const Stage<Dim>& stage : sim.stages)
    for (Field f : stage.writes)
      for (int k = 0; k < components(info(f).shape, Dim); ++k)
        if (!std::isfinite(sim.particles.column(f, k)[i]))
          return fmt::format("stage \"{}\" (field {})", stage.name, info(f).name);
  return fmt::format("after {}", noticed);
}

}  // namespace

template <int Dim>
void check_health(const Simulation<Dim>& sim, std::string_view stage) {
  const Particles<Dim>& p = sim.particles;
  auto healthy = [&](std::size_t i) {
    double sum = p.column(Field::specific_energy)[i] + p.column(Field::density)[i];
    for (int a = 0; a < Dim; ++a)
      sum += p.column(Field::position, a)[i] + p.column(Field::velocity, a)[i] + p.column(Field::acceleration, a)[i];
    return std::isfinite(sum) && p.column(Field::density)[i] > 0;
  };
  const IndexedMin worst = parallel_min(p.size(), 0.5, [&](std::size_t i) { return healthy(i) ? 1.0 : 0.0; });
  if (worst.index == p.size()) return;
  throw SimulationError(fmt::format("time {:.6g} s, step {}, {}: state not finite or density not positive: {}",
                                    sim.clock.time, sim.clock.step, origin_of_failure(sim, worst.index, stage),
                                    describe_particle(sim, worst.index)));
}

template TimeStepVote vote_time_step<2>(const Simulation<2>&);
template void check_health<2>(const Simulation<2>&, std::string_view);
template std::string describe_particle<2>(const Simulation<2>&, std::size_t);
template TimeStepVote vote_time_step<3>(const Simulation<3>&);
template void check_health<3>(const Simulation<3>&, std::string_view);
template std::string describe_particle<3>(const Simulation<3>&, std::size_t);

}  // namespace ejecta
