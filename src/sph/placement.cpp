#include "sph/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/random.hpp"
#include "scene/shape_geometry.hpp"
#include "sph/shells.hpp"

namespace ejecta {

template <int Dim>
std::uint64_t position_key(const Vec<Dim>& x, double spacing) {
  std::uint64_t key = 0x9e3779b97f4a7c15ull;
  for (int a = 0; a < Dim; ++a) key = mix_bits(key ^ static_cast<std::uint64_t>(std::llround(x[a] / spacing * 64)));
  return key;
}

namespace {

/// Bodies touch that share no more than this of a particle: what scaling the cloud of a round body may move it by.
constexpr double touching = 0.25;

/// Whether a point of a body is beyond no face of the boundary. Behind a periodic one a body goes on until it would
/// meet itself.
template <int Dim>
bool within(const Boundary& boundary, const Body& body, const Vec<Dim>& x) {
  const Vec<Dim> image = nearest_image<Dim>(boundary, body, x);
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (boundary.periodic(k) ? image[a] != x[a] : !boundary.within(k, x[a])) return false;
  }
  return true;
}

/// Several formulas of one body: a vector or a tensor.
std::vector<Formula> compile(const std::vector<std::string>& texts) {
  return std::vector<Formula>(texts.begin(), texts.end());
}

/// The points of a body, in shells or on the lattice of the scene unless it has its own.
template <int Dim>
PointCloud<Dim> points_of(const Scene& scene, const Body& body) {
  const double spacing = scene.spacing * body.spacing_factor;
  if (body.lattice == BodyLattice::shells)
    return lay_shells<Dim>(body, spacing, scene.boundary.any(mirrors), scene.seed);
  const Lattice lattice = body.lattice == BodyLattice::of_scene    ? scene.lattice
                          : body.lattice == BodyLattice::cubic     ? Lattice::cubic
                          : body.lattice == BodyLattice::hexagonal ? Lattice::hexagonal
                                                                   : Lattice::glass;
  return fill<Dim>(body, spacing, lattice, scene.seed);
}

/// Of a cell of a shell, all of whose edges along it are alike.
template <int Dim>
Mat<Dim> shape_of(const ShellCell<Dim>& cell) {
  const double cube = std::pow(cell.volume, 1.0 / Dim), along = std::pow(cell.volume / cell.thickness, 1.0 / (Dim - 1));
  const Mat<Dim> across = cell.normal * cell.normal.transpose();
  return across * std::pow(cube / cell.thickness, 2) + (Mat<Dim>::Identity() - across) * std::pow(cube / along, 2);
}

/// Where the particles of a body stand: the lattice cut by the shape and the boundary box, then moved. Those beyond a
/// periodic face are put in at the other one by the first step's neighbours, so that formulas see one body.
template <int Dim>
std::vector<Placement<Dim>> fill_body(const Scene& scene, std::size_t b, const Material& material, int number) {
  const Body& body = scene.bodies[b];
  const PointCloud<Dim> cloud = points_of<Dim>(scene, body);
  const std::vector<Formula> displacement = compile(body.profile.displacement);
  const std::vector<Formula> density =
      body.profile.density.empty() ? std::vector<Formula>{} : compile({body.profile.density});
  const double uniform = is_set(body.density) ? body.density : material.bulk_density();
  std::vector<Placement<Dim>> placements;
  for (std::size_t k = 0; k < cloud.points.size(); ++k) {
    const Vec<Dim>& site = cloud.points[k];
    if (!within<Dim>(scene.boundary, body, site)) continue;
    const double width = std::pow(cloud.volume_of(k), 1.0 / Dim);
    Placement<Dim> s{site, site, cloud.volume_of(k), width, uniform, static_cast<int>(b), number};
    if (!cloud.cells.empty()) s.shape = shape_of(cloud.cells[k]);
    for (int a = 0; a < Dim; ++a) {
      if (body.jitter > 0)
        s.x[a] +=
            body.jitter * width *
            (2 * uniform_random(scene.seed, position_key<Dim>(site, width), static_cast<std::uint64_t>(3 + a)) - 1);
      if (displacement.empty()) continue;
      const FormulaPoint point = formula_point<Dim>(body, site, width);
      const double moved = displacement[static_cast<std::size_t>(a)](point);
      if (!std::isfinite(moved)) refuse_value(body, "displacement", "a finite number", moved, point);
      s.x[a] += moved;
    }
    if (!density.empty()) {
      const FormulaPoint point = formula_point<Dim>(body, s.x, width);
      s.density = density.front()(point);
      if (!(s.density > 0 && std::isfinite(s.density))) refuse_value(body, "density", "a number > 0", s.density, point);
    }
    placements.push_back(s);
  }
  return placements;
}

}  // namespace

template <int Dim>
std::vector<Placement<Dim>> place_bodies(const Scene& scene, const std::vector<Material>& materials,
                                         const std::vector<int>& body_material) {
  std::vector<std::string> problems;
  std::vector<std::vector<Placement<Dim>>> by_material(materials.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const auto report = [&](const std::string& text) {
      problems.push_back(fmt::format("{}: bodies.{}: {}", body.origin, body.name, text));
    };
    auto placements = fill_body<Dim>(scene, b, materials[static_cast<std::size_t>(body_material[b])], body_material[b]);
    if (body.name == Gas::name && body.implied)  // it yields to whatever is there
      std::erase_if(placements, [&](const Placement<Dim>& s) {
        return std::any_of(
            scene.bodies.begin(), scene.bodies.begin() + static_cast<std::ptrdiff_t>(b),
            [&](const Body& other) { return inside<Dim>(other, nearest_image<Dim>(scene.boundary, other, s.site)); });
      });
    if (placements.empty())
      report(fmt::format("expected room for at least one particle, got none at a spacing of {:.4g} m",
                         scene.spacing * body.spacing_factor));
    for (std::size_t other = 0; other < b; ++other) {
      const auto shared = std::ranges::count_if(placements, [&](const Placement<Dim>& s) {
        const Body& earlier = scene.bodies[other];
        return depth<Dim>(earlier, nearest_image<Dim>(scene.boundary, earlier, s.site)) > touching * s.spacing;
      });
      if (shared > 0)
        report(fmt::format("expected a body clear of all earlier ones, got an overlap of {} particles with {}", shared,
                           scene.bodies[other].name));
    }
    auto& group = by_material[static_cast<std::size_t>(body_material[b])];
    group.insert(group.end(), placements.begin(), placements.end());
  }
  if (!problems.empty()) throw InputError(problems);
  std::vector<Placement<Dim>> all;
  for (auto& group : by_material) all.insert(all.end(), group.begin(), group.end());
  return all;
}

template std::vector<Placement<2>> place_bodies<2>(const Scene&, const std::vector<Material>&, const std::vector<int>&);
template std::vector<Placement<3>> place_bodies<3>(const Scene&, const std::vector<Material>&, const std::vector<int>&);
template std::uint64_t position_key<2>(const Vec<2>&, double);
template std::uint64_t position_key<3>(const Vec<3>&, double);

}  // namespace ejecta
