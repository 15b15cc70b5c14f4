#include "grid/grid_fill.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"
#include "material/matter_at.hpp"
#include "scene/shape_geometry.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

constexpr std::array axes{"x", "y", "z"};

/// Points along an edge of a cell: to see whether states meet in it.
template <int Dim>
constexpr int probes = 4;

}  // namespace

template <int Dim>
Box<Dim> box_of(const Scene& scene, double reached) {
  std::vector<std::string> problems;
  const auto report = [&](const std::string& key, const std::string& text) {
    problems.push_back(fmt::format("{}: {}: {}", scene.file, key, text));
  };
  Box<Dim> box;
  box.spacing = scene.spacing;
  const double dx = scene.spacing;
  for (std::size_t a = 0; a < Dim; ++a) {
    box.lower[a] = scene.boundary.lower[a];
    box.upper[a] = scene.boundary.upper[a];
    double low = scene.boundary.min[a], high = scene.boundary.max[a];
    // What the bodies need.
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Body& body : scene.bodies) {
      if (body.implied && body.name == Gas::name) continue;
      double half = with_shape<Dim>(body, [](const auto& shape) { return shape.half_extent(); })[static_cast<int>(a)];
      if (body.implied) half = std::max(half, reached);
      least = std::min(least, body.center[a] - half);
      most = std::max(most, body.center[a] + half);
    }
    if (!is_set(low) || !is_set(high)) {
      if (!(least < most)) {
        report("boundary",
               fmt::format("needs min and max along {}: there is no body that the grid could begin around", axes[a]));
        continue;
      }
      box.grows_lower[a] = scene.gas && !is_set(low);
      box.grows_upper[a] = scene.gas && !is_set(high);
      // Room for the first steps, in whole cells from the face that is given, or from the middle of the bodies.
      constexpr int room = 8;
      const double middle = is_set(low) ? low : is_set(high) ? high : 0.5 * (least + most);
      if (!is_set(low)) low = scene.gas ? middle - (std::ceil((middle - least) / dx - 1e-9) + room) * dx : least;
      if (!is_set(high)) high = scene.gas ? middle + (std::ceil((most - middle) / dx - 1e-9) + room) * dx : most;
    }
    const double exact = (high - low) / dx;
    box.cells[a] = static_cast<int>(std::lround(exact));
    if (!(box.cells[a] >= 1) || std::abs(exact - box.cells[a]) > 1e-6 * exact)
      report("boundary", fmt::format("expected a whole number of cells of {} along {}, got {:.6g} between {} and {}",
                                     format_quantity(dx, "m"), axes[a], exact, format_quantity(low, "m"),
                                     format_quantity(high, "m")));
    box.corner[static_cast<int>(a)] = low;
    if (!scene.charge) continue;
    const double low_end = scene.charge->center[a] - scene.charge->radius,
                 high_end = scene.charge->center[a] + scene.charge->radius;
    const double round_off = 1e-9 * dx;
    const bool cut = (!mirrors(box.lower[a]) && low_end < low - round_off) ||
                     (!mirrors(box.upper[a]) && high_end > high + round_off);
    const bool outside = scene.charge->center[a] < low - round_off || scene.charge->center[a] > high + round_off;
    if (cut || outside)
      report("boundary", fmt::format("expected a box that holds the charge, from {} to {} along {}, got {} to {}",
                                     format_quantity(low_end, "m"), format_quantity(high_end, "m"), axes[a],
                                     format_quantity(low, "m"), format_quantity(high, "m")));
  }
  if (!problems.empty()) throw InputError(problems);
  return box;
}

template <int Dim>
Conserved<Dim> fill_cells(const Scene& scene, const std::vector<Material>& materials, const Box<Dim>& box,
                          const RadialState* start) {
  const MatterAt<Dim> matter(scene, materials, scene.spacing, start);
  const bool formulas = matter.varies();
  Conserved<Dim> cells;
  for (auto& column : cells) column.resize(box.size());
  const auto refuse = [&](const Vec<Dim>& x) {
    throw InputError(
        fmt::format("{}: bodies: expected something in every cell of the grid, got nothing in that at ({}) m; "
                    "[gas] fills what bodies leave",
                    scene.file, fmt::join(x.begin(), x.end(), ", ")));
  };
  for (std::size_t i = 0; i < box.size(); ++i) {
    const Vec<Dim> centre = box.centre(box.cell(i));
    const auto middle = matter(centre);
    if (!middle) refuse(centre);
    const bool around = matter.is_around(centre, box.spacing), varies = formulas || around;
    bool mixed = false;
    for_points<Dim>(centre, box.spacing, probes<Dim>, [&](const Vec<Dim>& x) {
      const auto other = matter(x);
      if (!other) refuse(centre);
      mixed = mixed || (varies ? other->body != middle->body : !other->same_state(*middle));
    });
    auto u = middle->conserved();
    if (mixed || varies) {
      const auto mean = matter.mean(centre, box.spacing, mixed || around ? cell_samples<Dim> : probes<Dim>);
      if (!mean) refuse(centre);
      u = *mean;
    }
    for (std::size_t c = 0; c < u.size(); ++c) cells[c][i] = u[c];
  }
  return cells;
}

template <int Dim>
std::array<double, Dim + 2> ambient_of(const Scene& scene, const std::vector<Material>& materials) {
  if (!scene.gas) return {};
  return MatterAt<Dim>(scene, materials, scene.spacing).of_body(scene.bodies.size() - 1, Vec<Dim>::Zero()).conserved();
}

const Material& grid_material(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<std::string> problems;
  for (const Body& body : scene.bodies) {
    const Material& m = *std::ranges::find(materials, body.material, &Material::name);
    const auto report = [&](const std::string& text) {
      problems.push_back(fmt::format("{}: bodies.{}: {}", body.origin, body.name, text));
    };
    if (m.solid())
      report(fmt::format("expected a fluid, got {}: numerics.scheme = \"fvm\" carries no strength", m.name));
    if (m.porosity)
      report(fmt::format("expected matter without pores, got {}: numerics.scheme = \"fvm\" does not crush", m.name));
    if (body.material != scene.bodies[0].material)
      report(fmt::format("expected {}, as {} is made of, got {}: a grid carries one material", scene.bodies[0].material,
                         scene.bodies[0].name, m.name));
    if (body.driven) report("driven: expected false, got true: cells do not move with a body");
    if (!body.profile.displacement.empty()) report("profile.displacement: moves particles, and there are none");
  }
  const auto refuse = [&](bool asked, const char* key, const char* why) {
    if (asked)
      problems.push_back(
          fmt::format("{}: {}: expected false with numerics.scheme = \"fvm\": {}", scene.file, key, why));
  };
  refuse(scene.fragments.enabled, "fragments.enabled", "a fluid has no pieces");
  refuse(scene.output.peaks, "output.peaks", "cells do not follow matter");
  refuse(scene.insitu.column_density, "insitu.column_density", "it is drawn of particles");
  if (!problems.empty()) throw InputError(problems);
  return *std::ranges::find(materials, scene.bodies[0].material, &Material::name);
}

template Box<2> box_of<2>(const Scene&, double);
template Box<3> box_of<3>(const Scene&, double);
template Conserved<2> fill_cells<2>(const Scene&, const std::vector<Material>&, const Box<2>&, const RadialState*);
template Conserved<3> fill_cells<3>(const Scene&, const std::vector<Material>&, const Box<3>&, const RadialState*);
template std::array<double, 4> ambient_of<2>(const Scene&, const std::vector<Material>&);
template std::array<double, 5> ambient_of<3>(const Scene&, const std::vector<Material>&);

}  // namespace ejecta
