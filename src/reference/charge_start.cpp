#include "reference/charge_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "reference/radial_problem.hpp"
#include "scene/shape_geometry.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

/// Spacings that the shock has come, unless charge.start says more.
constexpr double resolved = 16;
/// Spacings that must be free around the wave: the methods look that far.
constexpr double clearance = 3;
/// Of the run that may go by before it begins.
constexpr double most_of_the_run = 0.1;
/// As the reference has by itself.
constexpr double cells_of_a_charge = 100;

/// How far a wave from the centre of the charge may come before it meets a face or another body [m].
template <int Dim>
double free_distance(const Scene& scene) {
  const Charge& charge = *scene.charge;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < Dim; ++a)
    for (const bool upper : {false, true}) {
      const double face = upper ? scene.boundary.max[a] : scene.boundary.min[a];
      const BoundaryKind kind = upper ? scene.boundary.upper[a] : scene.boundary.lower[a];
      if (!is_set(face)) continue;
      const double distance = std::abs(face - charge.center[a]);
      const bool splits = mirrors(kind) && distance < 1e-9 * scene.spacing;  // the charge: it is half of one
      if (!splits) nearest = std::min(nearest, distance);
    }
  for (const Body& body : scene.bodies) {
    if (body.implied) continue;
    const Vec<Dim> half = with_shape<Dim>(body, [](const auto& shape) -> Vec<Dim> { return shape.half_extent(); });
    const Vec<Dim> d = first_components<Dim>(body.center) - first_components<Dim>(charge.center);
    nearest = std::min(nearest, (d.cwiseAbs() - half).cwiseMax(0.0).norm());
  }
  return nearest - clearance * scene.spacing;
}

/// Farthest cell that is not at rest any more [m].
double reach(const RadialFlow& flow) {
  std::size_t i = flow.velocity().size();
  while (i > 0 && flow.velocity()[i - 1] == 0) --i;
  return i == 0 ? 0 : flow.position()[i - 1];
}

RadialState state_of(const RadialFlow& flow, const Scene& scene, double spacing, double charge_mass) {
  RadialState state;
  state.center = scene.charge->center;
  state.time = flow.time();
  state.spacing = spacing;
  const auto copy = [](std::span<const double> column) { return std::vector<double>(column.begin(), column.end()); };
  state.density = copy(flow.density());
  state.velocity = copy(flow.velocity());
  state.specific_energy = copy(flow.specific_energy());
  const Geometry geometry = scene.dimension == 2 ? Geometry::cylindrical : Geometry::spherical;
  double mass = 0;
  for (std::size_t i = 0; i < state.density.size() && mass < charge_mass; ++i) {
    state.charge_radius = (static_cast<double>(i) + 1) * spacing;
    mass += state.density[i] * shell_volume(geometry, state.charge_radius - spacing, state.charge_radius);
  }
  return state;
}

}  // namespace

std::optional<RadialState> charge_start(const Scene& scene, const std::vector<Material>& materials) {
  if (!scene.charge) return std::nullopt;
  const Charge& charge = *scene.charge;
  const bool asked = is_set(charge.start);
  if (asked && charge.start == 0) return std::nullopt;
  const auto refuse = [&](const std::string& text) {
    throw InputError(fmt::format("{}: charge.start: {}", scene.file, text));
  };
  if (asked && !(charge.start < scene.time_end))
    refuse(fmt::format("expected a time before the end, {}, got {}", format_quantity(scene.time_end, "s"),
                       format_quantity(charge.start, "s")));
  const auto implied = [&](const char* name) {
    return std::ranges::find_if(scene.bodies, [&](const Body& b) { return b.implied && b.name == name; });
  };
  const auto body = implied(Charge::name), gas = implied(Gas::name);
  if (gas == scene.bodies.end() || gas->material != body->material) {
    if (asked) refuse("expected 0 for a charge without [gas] or of another material");
    return std::nullopt;
  }
  const double room = scene.dimension == 2 ? free_distance<2>(scene) : free_distance<3>(scene);
  const double wanted = asked ? room : std::min(room, resolved * scene.spacing);
  if (!asked && wanted < 2 * charge.radius) return std::nullopt;

  Scene alone = scene;
  alone.bodies = {*body, *gas};
  const std::vector<Material> one{*std::ranges::find(materials, body->material, &Material::name)};
  const RadialProblem problem = radial_problem(alone, one);
  const double spacing = charge.radius / cells_of_a_charge;
  RadialFlow flow = start_flow(problem, spacing);
  double latest = asked ? charge.start : most_of_the_run * scene.time_end;
  if (!asked)
    for (const double t : scene.output.times) latest = std::min(latest, t);
  // Slowly at first, then by a twentieth of the time that has passed.
  for (double step = 1e-3 * charge.radius / std::sqrt(body->specific_energy);
       flow.time() < latest && reach(flow) < wanted; step = std::max(step, 0.05 * flow.time()))
    flow.advance_to(std::min(latest, flow.time() + step));
  if (asked && reach(flow) >= wanted)
    refuse(fmt::format("expected a time at which the wave has met neither faces nor bodies, {} away, got {}",
                       format_quantity(std::max(room, 0.0), "m"), format_quantity(charge.start, "s")));
  const Geometry geometry = problem.geometry;
  return state_of(flow, scene, spacing, charge.density * shell_volume(geometry, 0, charge.radius));
}

Scene with_charge_of(const RadialState& start, Scene scene) {
  for (Body& body : scene.bodies)
    if (body.implied && body.name == Charge::name) body.radius = start.charge_radius;
  return scene;
}

}  // namespace ejecta
