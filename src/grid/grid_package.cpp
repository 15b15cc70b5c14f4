#include "grid/grid_package.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/parallel.hpp"
#include "grid/grid.hpp"
#include "grid/grid_fill.hpp"
#include "material/matter_at.hpp"
#include "scene/shape_geometry.hpp"

namespace ejecta {

namespace {

/// Of one core, measured in 2D and 3D with an ideal gas (AVX-512 at 2.1 GHz).
constexpr double cell_steps_per_s[] = {20e6, 8e6};

/// The box of the scene, or where it grows with a blast what that will have swept; half of it is at rest on the average.
template <int Dim>
Estimate estimate(const Scene& scene, const std::vector<Material>& materials) {
  const Material& fluid = grid_material(scene, materials);
  const Box<Dim> box = box_of<Dim>(scene);
  Estimate e{.element = "cell", .elements = static_cast<double>(box.size())};
  double fastest = 0;  // with it the steps are counted
  const MatterAt<Dim> matter(scene, materials, scene.spacing);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Matter<Dim> m = matter.of_body(b, first_components<Dim>(scene.bodies[b].center));
    fastest = std::max(fastest, m.velocity.norm() + std::visit(
                                                        [&](const auto& eos) {
                                                          return sound_speed(eos.evaluate(m.density, m.specific_energy),
                                                                             m.density, eos.sound_speed_floor());
                                                        },
                                                        fluid.eos));
  }
  const bool grows = std::ranges::any_of(box.grows_lower, std::identity{}) || std::ranges::any_of(box.grows_upper, std::identity{});
  double steps_per_s = fastest / box.spacing;
  if (scene.charge && scene.gas) {
    const double ambient = ambient_of<Dim>(scene, materials)[0], t = scene.time_end;
    const double reach = std::pow(scene.charge->energy_in(Dim) / ambient * t * t, 1.0 / (Dim + 2));
    if (grows) e.elements = std::max(e.elements, std::pow(2.2 * reach / box.spacing, Dim));
    // The first step of the charge is short, but the blast soon slows down: the shock moves with 2/(Dim + 2) R/t.
    steps_per_s = 4 * reach / t / box.spacing;
  }
  const GridSettings* settings = nullptr;
  if (const auto found = scene.sections.find("grid"); found != scene.sections.end())
    settings = dynamic_cast<const GridSettings*>(found->second.get());
  e.bytes_each = 2 * (Dim + 2) * sizeof(double);
  e.steps = scene.time_end * steps_per_s / (settings ? *settings : GridSettings{}).courant_in(Dim);
  if (scene.max_steps) e.steps = std::min(e.steps, static_cast<double>(*scene.max_steps));
  e.seconds = (grows ? 0.5 : 1) * e.elements * e.steps /
              (cell_steps_per_s[Dim - 2] * scene.threads.value_or(available_cores()));
  return e;
}

}  // namespace

PackageKind grid_package() {
  PackageKind kind;
  kind.section = {"grid", "finite volumes: how fluxes are found", [] { return std::make_shared<GridSettings>(); }, "fvm"};
  kind.set_up = [](const Scene& scene, const std::vector<Material>& materials) -> std::unique_ptr<Package> {
    if (scene.dimension == 2) return std::make_unique<Grid<2>>(scene, materials);
    return std::make_unique<Grid<3>>(scene, materials);
  };
  kind.fields = {{"density", "kg/m^3"}, {"pressure", "Pa"}, {"velocity", "m/s"}, {"specific_energy", "J/kg"}, {"mach", "1"}};
  kind.estimate = [](const Scene& scene, const std::vector<Material>& materials) {
    return scene.dimension == 2 ? estimate<2>(scene, materials) : estimate<3>(scene, materials);
  };
  kind.takes_part = [](const Scene& scene) { return scene.numerics.scheme == SchemeKind::fvm; };
  return kind;
}

}  // namespace ejecta
