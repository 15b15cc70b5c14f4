#include "hybrid/hybrid_package.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "grid/blast_reach.hpp"
#include "grid/grid_fill.hpp"
#include "hybrid/hybrid.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

/// Measured in 2D with an ideal gas, one core with AVX-512: steps of particles, the work between steps among them.
constexpr double particle_steps_per_s = 0.75e6;
constexpr double steps_in_one = 8;             ///< of particles, within one of the grid
constexpr double share_of_other_scenes = 0.3;  ///< of the box that is filled with particles, where there is no blast

/// Particles at the end, when most of them are there, the belt included: behind the shock the air is six times as
/// dense, less so further in.
template <int Dim>
Estimate estimate(const Scene& scene, const std::vector<Material>& materials) {
  const HybridSettings settings = hybrid_settings(scene);
  Scene coarse = scene;
  coarse.spacing *= settings.ratio;
  const Box<Dim> box = box_of<Dim>(coarse);
  const double each = std::pow(settings.ratio, Dim);
  Estimate e{.element = "particle"};
  double crossings = 0;
  if (scene.charge && scene.gas) {
    const double radius = blast_reach(scene, ambient_of<Dim>(scene, materials)[0]);
    double part = 1;  // of all directions
    for (std::size_t a = 0; a < Dim; ++a) part *= box.grows_lower[a] && box.grows_upper[a] ? 1 : 0.5;
    const double surface = Dim == 2 ? 2 * std::numbers::pi * radius : 4 * std::numbers::pi * radius * radius;
    const double cells = surface * coarse.spacing / box.cell_volume();  // a layer of them
    const double belt =
        std::ceil(2 * kernel_support(scene.numerics.kernel) * scene.numerics.nodes_per_h / settings.ratio);
    constexpr double density_behind = 5;
    e.elements =
        part * cells * each *
        (settings.ahead + settings.hysteresis + belt + density_behind * (settings.behind + settings.hysteresis + belt));
    crossings = 1.3 * radius / coarse.spacing;
  } else {
    e.elements = share_of_other_scenes * static_cast<double>(box.size()) * each;
    crossings = *std::ranges::max_element(box.cells);
  }
  e.bytes_each = 700;
  e.steps = crossings / grid_settings(scene).courant_in(Dim);
  if (scene.max_steps) e.steps = std::min(e.steps, static_cast<double>(*scene.max_steps));
  e.seconds = (scene.charge ? 0.5 : 1) * e.elements * e.steps * steps_in_one / (particle_steps_per_s * max_threads());
  return e;
}

}  // namespace

PackageKind hybrid_package() {
  PackageKind kind;
  kind.section = {
      "hybrid", "particles where fronts are, on a grid", [] { return std::make_shared<HybridSettings>(); }, {"hybrid"}};
  kind.set_up = [](const Scene& scene, const std::vector<Material>& materials) -> std::unique_ptr<Package> {
    if (scene.dimension == 2) return std::make_unique<Hybrid<2>>(scene, materials);
    return std::make_unique<Hybrid<3>>(scene, materials);
  };
  kind.fields = {{"zone", "1"}};
  kind.estimate = [](const Scene& scene, const std::vector<Material>& materials) {
    return scene.dimension == 2 ? estimate<2>(scene, materials) : estimate<3>(scene, materials);
  };
  kind.takes_part = [](const Scene& scene) { return scene.numerics.scheme == SchemeKind::hybrid; };
  return kind;
}

}  // namespace ejecta
