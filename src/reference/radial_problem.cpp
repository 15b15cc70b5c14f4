#include "reference/radial_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/errors.hpp"
#include "material/matter_at.hpp"
#include "scene/shape_geometry.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

constexpr double cells_of_a_charge = 100;
constexpr double finer_than_the_run = 4;  ///< its spacing over that of the reference
constexpr double most_cells = 2e7;

[[noreturn]] void refuse(const Scene& scene, const std::string& key, const std::string& message) {
  throw InputError(fmt::format("{}: {}: {}", scene.file, key, message));
}

/// The one material, which must be a fluid: one dimension knows no deviatoric stress.
const Material& only_material(const Scene& scene, const std::vector<Material>& materials) {
  if (materials.size() != 1)
    refuse(scene, "bodies",
           fmt::format("expected one material for a one-dimensional reference, got {} and {}", materials[0].name,
                       materials[1].name));
  const Material& material = materials[0];
  if (material.solid() || material.porosity)
    refuse(scene, "bodies",
           fmt::format("expected a gas or another fluid for a one-dimensional reference, got {}, which has {}",
                       material.name, material.solid() ? "strength" : "pores"));
  if (material.explosive())
    refuse(scene, "bodies", fmt::format("expected matter that does not burn, got {}", material.name));
  return material;
}

/// Matter at `origin` + r along x.
template <int Dim>
std::function<LinePoint(double)> line(const Scene& scene, const std::vector<Material>& materials,
                                      const Triple& origin) {
  const auto matter_at = std::make_shared<MatterAt<Dim>>(scene, materials, scene.spacing);
  const Vec<Dim> zero = first_components<Dim>(origin);
  return [matter_at, zero, &scene](double r) {
    Vec<Dim> x = zero;
    x[0] += r;
    const auto matter = (*matter_at)(x);
    if (!matter)
      refuse(
          scene, "bodies",
          fmt::format("expected matter everywhere along the line of the one-dimensional reference, got none at x = {}",
                      format_quantity(x[0], "m")));
    for (int a = 1; a < Dim; ++a)
      if (matter->velocity[a] != 0)
        refuse(scene, fmt::format("body {}", scene.bodies[matter->body].name),
               fmt::format("expected motion along the line of the one-dimensional reference only, got {} across it",
                           format_quantity(matter->velocity[a], "m/s")));
    return LinePoint{matter->body, matter->density, matter->velocity[0], matter->specific_energy};
  };
}

std::function<LinePoint(double)> line(const Scene& scene, const std::vector<Material>& materials,
                                      const Triple& origin) {
  return scene.dimension == 2 ? line<2>(scene, materials, origin) : line<3>(scene, materials, origin);
}

/// The lowest or highest x that bodies reach [m]; `side` is -1 or 1.
double reach(const Scene& scene, double side) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Body& body : scene.bodies) {
    const auto half = [&](const auto& shape) { return shape.half_extent()[0]; };
    const double extent = scene.dimension == 2 ? with_shape<2>(body, half) : with_shape<3>(body, half);
    if (!is_set(extent))
      refuse(scene, "gas", "expected boundary.min and boundary.max along x for a one-dimensional reference");
    farthest = std::max(farthest, side * body.center[0] + extent);
  }
  return side * farthest;
}

RadialEdge edge(BoundaryKind kind) {
  if (mirrors(kind)) return RadialEdge::mirror;
  return kind == BoundaryKind::periodic ? RadialEdge::periodic : RadialEdge::open;
}

RadialProblem blast_problem(const Scene& scene, const std::vector<Material>& materials, Geometry geometry) {
  if (!scene.gas) refuse(scene, "charge", "expected a [gas] around it for a one-dimensional reference");
  if (scene.bodies.size() > 2)
    refuse(scene, "bodies", "expected none beside [charge] and [gas] for a one-dimensional reference");
  const Charge& charge = *scene.charge;
  RadialProblem problem{.geometry = geometry,
                        .eos = only_material(scene, materials).eos,
                        .start = 0,
                        .end = charge.radius,
                        .lower = RadialEdge::mirror,
                        .upper = RadialEdge::quiet,
                        .at = line(scene, materials, charge.center),
                        .uniform_bodies = true,
                        .bodies = 2,
                        .blast = {},
                        .default_spacing = charge.radius / cells_of_a_charge};
  const LinePoint inside = problem.at(0), outside = problem.at(2 * charge.radius);
  const double both_sides = geometry == Geometry::planar ? 2 : 1;
  problem.blast =
      Blast{.radius = charge.radius,
            .energy = both_sides * all_directions(geometry) * shell_volume(geometry, 0, charge.radius) *
                      inside.density * inside.specific_energy,
            .ambient_density = outside.density,
            .ambient_pressure = std::visit(
                [&](const auto& eos) { return eos.evaluate(outside.density, outside.specific_energy).pressure; },
                problem.eos)};
  return problem;
}

}  // namespace

RadialProblem radial_problem(const Scene& scene, const std::vector<Material>& materials,
                             std::optional<Geometry> asked) {
  if (scene.charge)
    return blast_problem(scene, materials,
                         asked.value_or(scene.dimension == 2 ? Geometry::cylindrical : Geometry::spherical));
  const Geometry geometry = asked.value_or(Geometry::planar);
  const bool planar = geometry == Geometry::planar;
  const Boundary& box = scene.boundary;
  Triple origin = scene.bodies.front().center;
  if (planar) origin[0] = 0;
  if (!planar && box.periodic(0))
    refuse(scene, "boundary.x", "expected no periodic faces for a reference in cylinders or spheres");
  const bool varies = std::ranges::any_of(scene.bodies, [](const Body& body) {
    const Profile& p = body.profile;
    return !(p.density.empty() && p.pressure.empty() && p.specific_energy.empty() && p.velocity.empty());
  });
  return {.geometry = geometry,
          .eos = only_material(scene, materials).eos,
          .start = !planar              ? 0
                   : is_set(box.min[0]) ? box.min[0]
                                        : reach(scene, -1),
          .end = (is_set(box.max[0]) ? box.max[0] : reach(scene, 1)) - origin[0],
          .lower = planar ? edge(box.lower[0]) : RadialEdge::mirror,
          .upper = edge(box.upper[0]),
          .at = line(scene, materials, origin),
          .uniform_bodies = !varies,
          .bodies = scene.bodies.size(),
          .blast = {},
          .default_spacing = scene.spacing / finer_than_the_run};
}

double fitting_spacing(const RadialProblem& problem, double wanted) {
  if (problem.blast) return wanted;
  const double length = problem.end - problem.start;
  return length / (2 * std::max(4.0, std::round(0.5 * length / wanted)));
}

RadialFlow start_flow(const RadialProblem& problem, double spacing) {
  const auto volume = [&](double a, double b) { return shell_volume(problem.geometry, a, b); };
  // Of a piece of a cell in one body.
  const auto add = [&](RadialCell& sum, double a, double b) {
    const LinePoint p = problem.at(0.5 * (a + b));
    const double mass = p.density * volume(a, b);
    sum.density += mass;
    sum.momentum += mass * p.velocity;
    sum.energy += mass * (p.specific_energy + 0.5 * p.velocity * p.velocity);
  };
  const auto add_piece = [&](RadialCell& sum, double a, double b) {
    double low = a + 1e-9 * (b - a), high = b - 1e-9 * (b - a);
    const std::size_t body = problem.at(low).body;
    if (problem.at(high).body == body) return add(sum, a, b);
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
      (problem.at(middle).body == body ? low : high) = middle;
    add(sum, a, low);
    add(sum, low, b);
  };
  const double length = problem.end - problem.start;
  const double count = problem.blast ? std::ceil(length / spacing) + 16 : std::round(length / spacing);
  if (!(length > 0)) throw InputError("reference: expected matter along +x from the centre of the first body");
  if (count > most_cells)
    throw InputError(fmt::format("--spacing: expected at most {:g} cells, got {:.4g} in {}", most_cells, count,
                                 format_quantity(length, "m")));
  constexpr int pieces = 4;
  std::vector<RadialCell> cells(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto face = [&](int k) {
      return problem.start + (static_cast<double>(i) + static_cast<double>(k) / pieces) * spacing;
    };
    RadialCell& cell = cells[i];
    cell = {};
    for (int k = 0; k < pieces; ++k) add_piece(cell, face(k), face(k + 1));
    const double whole = volume(face(0), face(pieces));
    cell = {cell.density / whole, cell.momentum / whole, cell.energy / whole};
  }
  return {problem.eos,
          {.geometry = problem.geometry,
           .start = problem.start,
           .spacing = spacing,
           .lower = problem.lower,
           .upper = problem.upper},
          cells};
}

}  // namespace ejecta
