#include "grid/grid_package.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "grid/blast_reach.hpp"
#include "grid/grid.hpp"
#include "grid/grid_fill.hpp"
#include "material/matter_at.hpp"
#include "scene/shape_geometry.hpp"

namespace ejecta {

namespace {

/// Of one core, measured in 2D and 3D with an ideal gas (tests/performance, AVX-512).
constexpr double cell_steps_per_s[] = {20e6, 9.5e6};

/// The box of the scene, or where it grows with a blast what that will sweep; of a blast half of it is at rest on the
/// average, and signals behind its shock are 1.3 times as fast as that.
template <int Dim>
Estimate estimate(const Scene& scene, const std::vector<Material>& materials) {
  const Eos& eos = grid_material(scene, materials).eos;
  const Box<Dim> box = box_of<Dim>(scene);
  Estimate e{.element = "cell", .elements = static_cast<double>(box.size())};
  double crossings = 0;  // of a cell by the fastest signal, until the end
  if (scene.charge && scene.gas) {
    const double cells = 1.3 * blast_reach(scene, ambient_of<Dim>(scene, materials)[0]) / box.spacing;
    double swept = 1;
    for (std::size_t a = 0; a < Dim; ++a)
      swept *= std::max<double>(box.cells[a], cells * (box.grows_lower[a] + box.grows_upper[a]));
    e.elements = swept;
    crossings = cells;
  } else {
    const MatterAt<Dim> matter(scene, materials, scene.spacing);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Matter<Dim> m = matter.of_body(b, first_components<Dim>(scene.bodies[b].center));
      const auto sound = [&](const auto& of) {
        return sound_speed(of.evaluate(m.density, m.specific_energy), m.density, of.sound_speed_floor());
      };
      crossings = std::max(crossings, (m.velocity.norm() + std::visit(sound, eos)) * scene.time_end / box.spacing);
    }
  }
  e.bytes_each = 2 * (Dim + 2) * sizeof(double);
  e.steps = crossings / grid_settings(scene).courant_in(Dim);
  if (scene.max_steps) e.steps = std::min(e.steps, static_cast<double>(*scene.max_steps));
  e.seconds = (scene.charge ? 0.5 : 1) * e.elements * e.steps / (cell_steps_per_s[Dim - 2] * max_threads());
  return e;
}

}  // namespace

PackageKind grid_package() {
  PackageKind kind;
  kind.section = {"grid",
                  "finite volumes: how fluxes are found",
                  [] { return std::make_shared<GridSettings>(); },
                  {"fvm", "hybrid"}};
  kind.set_up = [](const Scene& scene, const std::vector<Material>& materials) -> std::unique_ptr<Package> {
    if (scene.dimension == 2) return std::make_unique<Grid<2>>(scene, materials);
    return std::make_unique<Grid<3>>(scene, materials);
  };
  kind.fields = {
      {"density", "kg/m^3"}, {"pressure", "Pa"}, {"velocity", "m/s"}, {"specific_energy", "J/kg"}, {"mach", "1"}};
  kind.estimate = [](const Scene& scene, const std::vector<Material>& materials) {
    return scene.dimension == 2 ? estimate<2>(scene, materials) : estimate<3>(scene, materials);
  };
  kind.takes_part = [](const Scene& scene) { return scene.numerics.scheme == SchemeKind::fvm; };
  return kind;
}

}  // namespace ejecta
