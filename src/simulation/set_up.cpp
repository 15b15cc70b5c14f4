#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <numeric>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "schemes/kernels.hpp"
#include "schemes/pair_records.hpp"
#include "simulation/shapes.hpp"
#include "simulation/stages.hpp"
#include "simulation/time_step.hpp"

namespace ejecta {

namespace {

/// One particle before columns exist.
template <int Dim>
struct Seedling {
  Vec<Dim> x;
  double volume, spacing;
  int body, material;
};

/// Material number of each body: its place in the list of materials by name.
std::vector<int> number_materials(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<int> numbers;
  for (const Body& body : scene.bodies) {
    int m = 0;
    while (materials[static_cast<std::size_t>(m)].name != body.material) ++m;
    numbers.push_back(m);
  }
  return numbers;
}

/// All bodies filled, those of one material together. A point that already belongs to an earlier body is an error.
template <int Dim>
std::vector<Seedling<Dim>> sow(const Scene& scene, const std::vector<int>& body_material, std::size_t materials) {
  std::vector<std::string> problems;
  std::vector<std::vector<Seedling<Dim>>> by_material(materials);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const double spacing = scene.spacing * body.spacing_factor;
    const PointCloud<Dim> cloud = fill<Dim>(body, spacing, scene.lattice);
    if (cloud.points.empty())
      problems.push_back(
          fmt::format("{}: bodies.{}: expected room for at least one particle, got none at a spacing of "
                      "{:.4g} m",
                      scene.file, body.name, spacing));
    std::size_t shared = 0;
    for (const Vec<Dim>& x : cloud.points) {
      for (std::size_t other = 0; other < b; ++other)
        if (inside<Dim>(scene.bodies[other], x)) ++shared;
      by_material[static_cast<std::size_t>(body_material[b])].push_back(
          {x, cloud.volume, std::pow(cloud.volume, 1.0 / Dim), static_cast<int>(b), body_material[b]});
    }
    if (shared > 0)
      problems.push_back(
          fmt::format("{}: bodies.{}: expected a body clear of all earlier ones, got an overlap of {} "
                      "particles",
                      scene.file, body.name, shared));
  }
  if (!problems.empty()) throw InputError(problems);
  std::vector<Seedling<Dim>> all;
  for (auto& group : by_material) all.insert(all.end(), group.begin(), group.end());
  return all;
}

/// Identifies a particle by where it was made: positions quantised to 1/64 of the spacing, mixed (splitmix64).
template <int Dim>
std::uint64_t position_key(const Vec<Dim>& x, double spacing) {
  std::uint64_t key = 0x9e3779b97f4a7c15ull;
  for (int a = 0; a < Dim; ++a) {
    key ^= static_cast<std::uint64_t>(std::llround(x[a] / spacing * 64));
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ull;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebull;
    key ^= key >> 31;
  }
  return key;
}

double initial_energy(const Body& body, const Material& material, double density) {
  if (std::isnan(body.pressure)) return body.specific_energy;
  return std::get<IdealGas>(material.eos).energy(density, body.pressure);
}

template <int Dim>
void plant(Simulation<Dim>& sim, const std::vector<Seedling<Dim>>& seedlings) {
  Particles<Dim>& p = sim.particles;
  const Scene& scene = sim.scene;
  std::vector<double> per_body(scene.bodies.size(), 0);
  std::vector<Range> ranges(sim.materials.size(), Range{0, 0});
  for (const auto& s : seedlings) {
    per_body[static_cast<std::size_t>(s.body)] += 1;
    for (std::size_t m = static_cast<std::size_t>(s.material); m < ranges.size(); ++m) {
      ranges[m].end += 1;
      if (m > static_cast<std::size_t>(s.material)) ranges[m].begin += 1;
    }
  }
  p.set_material_ranges(ranges);
  parallel_for(0, seedlings.size(), [&](std::size_t i) {
    const auto& s = seedlings[i];
    const Body& body = scene.bodies[static_cast<std::size_t>(s.body)];
    const Material& material = sim.materials[static_cast<std::size_t>(s.material)];
    const double density = std::isnan(body.density) ? material.bulk_density() : body.density;
    p.set_vector(Field::position, i, s.x);
    for (int a = 0; a < Dim; ++a) p.column(Field::velocity, a)[i] = body.velocity[static_cast<std::size_t>(a)];
    // Single precision must hold the mass exactly: both sides of a pair then use the same two masses.
    const double mass = density * s.volume;
    p.column(Field::mass)[i] = scene.numerics.precision == Precision::mixed ? static_cast<float>(mass) : mass;
    p.column(Field::density)[i] = density;
    p.column(Field::specific_energy)[i] = initial_energy(body, material, density);
    p.column(Field::smoothing_length)[i] = scene.numerics.nodes_per_h * s.spacing;
    p.label(Label::id)[i] = static_cast<std::int32_t>(i);
    p.label(Label::body)[i] = s.body;
    p.label(Label::material)[i] = s.material;
    if (p.has(Field::distension))
      p.column(Field::distension)[i] = material.porosity ? material.porosity->initial_distension() : 1.0;
    if (p.has(Field::shear_switch)) p.column(Field::shear_switch)[i] = 1;
    if (p.has(Field::stress_factor)) p.column(Field::stress_factor)[i] = 1;
    if (p.has(Field::flaw_count) && material.damage) {
      const Flaws flaws = draw_flaws(*material.damage, s.volume, per_body[static_cast<std::size_t>(s.body)], scene.seed,
                                     position_key<Dim>(s.x, s.spacing));
      p.column(Field::flaw_strain)[i] = flaws.strain;
      p.column(Field::flaw_exponent)[i] = flaws.exponent;
      p.column(Field::flaw_count)[i] = flaws.count;
    }
  });
  if (p.has(Field::damage)) sim.intact.assign(p.size(), 1.0);
}

}  // namespace

template <int Dim>
std::unique_ptr<Simulation<Dim>> set_up(const Scene& scene, const std::vector<Material>& materials) {
  auto sim = std::make_unique<Simulation<Dim>>();
  sim->scene = scene;
  sim->materials = materials;
  sim->body_material = number_materials(scene, materials);
  sim->stages = choose_stages<Dim>(scene, materials);
  const auto seedlings = sow<Dim>(scene, sim->body_material, materials.size());
  sim->particles.allocate(seedlings.size(), fields_of(sim->stages));
  plant(*sim, seedlings);

  const Numerics& numerics = scene.numerics;
  PairPassSettings settings;
  settings.kernel = numerics.kernel;
  settings.precision = numerics.precision;
  settings.stress = sim->particles.has(Field::deviatoric_stress);
  settings.velocity_gradient = sim->particles.has(Field::velocity_gradient);
  settings.gradient_correction = numerics.gradient_correction;
  settings.viscosity_alpha = numerics.viscosity_alpha;
  settings.viscosity_beta = numerics.viscosity_beta;
  settings.length_unit = power_of_two_below(scene.spacing);
  settings.boundary = scene.boundary;
  sim->pass = make_pair_pass<Dim>(settings);
  sim->support = std::make_unique<SupportSize>(numerics.kernel, Dim, numerics.nodes_per_h);

  evaluate(*sim);
  check_health(*sim, "set-up");
  // The first step has no step before it: its previous rates are the present ones.
  for (int a = 0; a < Dim; ++a)
    std::ranges::copy(sim->particles.column(Field::acceleration, a),
                      sim->particles.previous(Field::acceleration, a).begin());
  sim->initial = totals(sim->particles);
  return sim;
}

template std::unique_ptr<Simulation<2>> set_up<2>(const Scene&, const std::vector<Material>&);
template std::unique_ptr<Simulation<3>> set_up<3>(const Scene&, const std::vector<Material>&);

}  // namespace ejecta
