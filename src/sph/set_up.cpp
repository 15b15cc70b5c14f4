#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "material/material_reader.hpp"
#include "particles/smoothing_metric.hpp"
#include "reference/charge_start.hpp"
#include "scene/units.hpp"
#include "schemes/kernels.hpp"
#include "schemes/lattice_sums.hpp"
#include "schemes/pair_records.hpp"
#include "sph/assemble.hpp"
#include "sph/criteria.hpp"
#include "sph/detonation.hpp"
#include "sph/diagnostics.hpp"
#include "sph/pieces.hpp"
#include "sph/stages.hpp"

namespace ejecta {

std::vector<int> number_materials(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<int> numbers;
  for (const Body& body : scene.bodies) {
    int m = 0;
    while (materials[static_cast<std::size_t>(m)].name != body.material) ++m;
    numbers.push_back(m);
  }
  return numbers;
}

namespace {

/// A particle meets each other one once in a periodic box, and itself not at all, only if the box is wider than the
/// kernel reaches; images are made one box length away and no further.
void check_periodic_width(const Scene& scene) {
  constexpr std::array axes{"x", "y", "z"};
  double spacing = 0;
  for (const Body& body : scene.bodies) spacing = std::max(spacing, scene.spacing * body.spacing_factor);
  const double reach = list_reach(scene.numerics) * scene.numerics.nodes_per_h * spacing;
  std::vector<std::string> problems;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
    const double width = scene.boundary.length(a);
    if (scene.boundary.periodic(a) && width < reach)
      problems.push_back(
          fmt::format("{}: boundary.{}: expected a periodic box wider than the kernel reaches at the "
                      "start, {}, got {}",
                      scene.file, axes[a], format_quantity(reach, "m"), format_quantity(width, "m")));
  }
  if (!problems.empty()) throw InputError(problems);
}

/// Puts the formulas of the bodies in place of their uniform values.
template <int Dim>
void apply_profiles(Sph<Dim>& sph, const std::vector<Placement<Dim>>& placements) {
  Particles<Dim>& p = sph.particles;
  for (std::size_t b = 0; b < sph.scene.bodies.size(); ++b) {
    const Body& body = sph.scene.bodies[b];
    const Profile& profile = body.profile;
    const Material& material = sph.materials[static_cast<std::size_t>(sph.body_material[b])];
    const auto evaluate = [&](const std::string& key, const std::string& text, auto&& store) {
      if (text.empty()) return;
      const Formula formula(text);
      for (std::size_t i = 0; i < placements.size(); ++i) {
        if (placements[i].body != static_cast<int>(b)) continue;
        const FormulaPoint point = formula_point<Dim>(body, placements[i].x, placements[i].spacing);
        const double value = formula(point);
        if (!std::isfinite(value)) refuse_value(body, key, "a finite number", value, point);
        store(i, value);
      }
    };
    evaluate("specific_energy", profile.specific_energy, [&](std::size_t i, double value) {
      p.column(Field::specific_energy)[i] = energy_at_rest(material.eos) + value;
    });
    evaluate("pressure", profile.pressure, [&](std::size_t i, double value) {
      const double density = p.column(Field::density)[i];
      p.column(Field::specific_energy)[i] = specific_energy_at(material.eos, density, value).value();
    });
    for (std::size_t a = 0; a < profile.velocity.size(); ++a)
      evaluate("velocity", profile.velocity[a],
               [&](std::size_t i, double value) { p.column(Field::velocity, static_cast<int>(a))[i] = value; });
    for (std::size_t k = 0; k < profile.deviatoric_stress.size(); ++k)
      evaluate("deviatoric_stress", profile.deviatoric_stress[k], [&](std::size_t i, double value) {
        p.column(Field::deviatoric_stress, static_cast<int>(k))[i] = value;
      });
  }
}

/// Single precision must hold a mass exactly: both sides of a pair then use the same two masses.
double mass_of(const Scene& scene, double mass) {
  return scene.numerics.precision == Precision::mixed ? static_cast<float>(mass) : mass;
}

template <int Dim>
void fill_columns(Sph<Dim>& sph, const std::vector<Placement<Dim>>& placements) {
  Particles<Dim>& p = sph.particles;
  const Scene& scene = sph.scene;
  std::vector<double> per_body(scene.bodies.size(), 0);
  for (const auto& s : placements) per_body[static_cast<std::size_t>(s.body)] += 1;
  parallel_for(0, placements.size(), [&](std::size_t i) {
    const auto& s = placements[i];
    const Body& body = scene.bodies[static_cast<std::size_t>(s.body)];
    const Material& material = sph.materials[static_cast<std::size_t>(s.material)];
    p.set_vector(Field::position, i, s.x);
    for (int a = 0; a < Dim; ++a) p.column(Field::velocity, a)[i] = body.velocity[static_cast<std::size_t>(a)];
    p.column(Field::mass)[i] = mass_of(scene, s.density * s.volume);
    p.column(Field::density)[i] = s.density;
    p.column(Field::specific_energy)[i] = initial_energy(body, material, s.density);
    p.column(Field::smoothing_length)[i] = scene.numerics.nodes_per_h * s.spacing;
    if (p.has(Field::smoothing_metric))
      p.set_symmetric(Field::smoothing_metric, i, s.shape / std::pow(scene.numerics.nodes_per_h * s.spacing, 2));
    p.label(Label::id)[i] = static_cast<std::int32_t>(i);
    p.label(Label::body)[i] = s.body;
    p.label(Label::material)[i] = s.material;
    if (p.has(Field::distension))
      p.column(Field::distension)[i] = material.porosity ? material.porosity->initial_distension() : 1.0;
    if (p.has(Field::bond)) {
      p.set_vector(Field::start_position, i, s.x);
      p.column(Field::bond)[i] = scene.numerics.bonds == Switch::on
                                     ? material.solid() && !material.damage && !material.porosity
                                     : material.stretches();
      p.column(Field::stretch)[i] = 1;
    }
    if (p.has(Field::viscosity_factor)) p.column(Field::viscosity_factor)[i] = 1;
    if (p.has(Field::shock_switch)) p.column(Field::shock_switch)[i] = 1;
    if (p.has(Field::stress_factor)) p.column(Field::stress_factor)[i] = 1;
    if (material.damage) {
      const double solid_volume = s.density * s.volume / reference_density(material.eos);
      const std::uint64_t key = position_key<Dim>(s.site, s.spacing);
      if (material.damage->growth == CrackLaw::benz_asphaug) {
        const Flaws flaws =
            draw_flaws(*material.damage, solid_volume, per_body[static_cast<std::size_t>(s.body)], scene.seed, key);
        p.column(Field::flaw_strain)[i] = flaws.strain;
        p.column(Field::flaw_exponent)[i] = flaws.exponent;
        p.column(Field::flaw_count)[i] = flaws.count;
      } else {
        p.column(Field::flaw_strain)[i] = draw_weakest_flaw(*material.damage, solid_volume, scene.seed, key);
      }
    }
  });
  p.set_material_ranges(ranges_of_materials(p.label(Label::material), sph.materials.size()));
  if (p.has(Field::intact_share)) std::ranges::fill(p.column(Field::intact_share), 1.0);
}

/// What a blast has become in one dimension in place of what the scene says: each particle has the mass, momentum and
/// energy of the cube that it stands for.
template <int Dim>
void lay_blast(Sph<Dim>& sph, const RadialState& blast, const std::vector<Placement<Dim>>& placements) {
  const MatterAt<Dim> matter(sph.scene, sph.materials, sph.scene.spacing, &blast);
  Particles<Dim>& p = sph.particles;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const Placement<Dim>& s = placements[i];
    if (!matter.is_around(s.x, s.spacing)) continue;
    const auto u = matter.mean(s.x, s.spacing, cell_samples<Dim>);
    if (!u) continue;  // another body is that near
    const double density = (*u)[0];
    double squares = 0;
    for (int a = 0; a < Dim; ++a) {
      const double velocity = p.column(Field::velocity, a)[i] = (*u)[static_cast<std::size_t>(1 + a)] / density;
      squares += velocity * velocity;
    }
    p.column(Field::density)[i] = density;
    p.column(Field::mass)[i] = mass_of(sph.scene, density * s.volume);
    p.column(Field::specific_energy)[i] = (*u)[Dim + 1] / density - 0.5 * squares;
  }
  sph.clock.time = blast.time;
}

}  // namespace

template <int Dim>
std::unique_ptr<Sph<Dim>> set_up(const Scene& scene, const std::vector<Material>& materials) {
  const auto blast = charge_start(scene, materials);
  const auto placements =
      place_bodies<Dim>(blast ? with_charge_of(*blast, scene) : scene, materials, number_materials(scene, materials));
  return assemble<Dim>(scene, materials, choose_stages<Dim>(scene, materials), placements, [&](Sph<Dim>& sph) {
    apply_profiles(sph, placements);
    if (sph.particles.has(Field::lighting_time))
      std::ranges::copy(lighting_times<Dim>(scene, materials, placements),
                        sph.particles.column(Field::lighting_time).begin());
    if (blast) lay_blast(sph, *blast, placements);
  });
}

template <int Dim>
std::unique_ptr<Sph<Dim>> assemble(const Scene& scene, const std::vector<Material>& materials,
                                   std::vector<Stage<Dim>> stages, const std::vector<Placement<Dim>>& placements,
                                   const std::function<void(Sph<Dim>&)>& lay) {
  check_periodic_width(scene);
  auto sph = std::make_unique<Sph<Dim>>();
  sph->scene = scene;
  sph->materials = materials;
  sph->body_material = number_materials(scene, materials);
  sph->stages = std::move(stages);
  sph->particles.allocate(placements.size(), fields_of(sph->stages));
  fill_columns(*sph, placements);
  lay(*sph);

  const Numerics& numerics = scene.numerics;
  PairPassSettings settings;
  settings.kernel = numerics.kernel;
  settings.precision = numerics.precision;
  settings.bonded = sph->particles.has(Field::bond);
  settings.gradient_correction = settings.bonded || corrects_gradients(scene, materials);
  settings.stress = settings.gradient_correction || sph->particles.has(Field::deviatoric_stress);
  settings.velocity_gradient = sph->particles.has(Field::velocity_gradient);
  settings.asph = sph->particles.has(Field::smoothing_metric);
  settings.cracked = sph->particles.has(Field::uncut_gradient);
  for (const Material& m : materials) {
    settings.rules.reference_density.push_back(m.bulk_density());
    settings.rules.cut_by_cracks.push_back(m.cuts_pairs());
  }
  for (const Body& body : scene.bodies) settings.rules.sizes.push_back(scene.spacing * body.spacing_factor);
  settings.rules.pieces = pieces_of(scene, materials, sph->body_material);
  settings.contacts = settings.bonded || anything_touches(scene, settings.rules.pieces);
  settings.friction = scene.contact.friction;
  // Sums of masses spread a contact over a kernel, and weights by mass go with them as far as those hold; densities by
  // continuity jump there.
  settings.alike = numerics.density == DensityMethod::summation ? 64 : 4;
  settings.viscosity_alpha = numerics.viscosity_alpha;
  settings.viscosity_beta = numerics.viscosity_beta;
  settings.length_unit = power_of_two_below(scene.spacing);
  if (numerics.godunov()) {
    const LatticeSums lattice = lattice_sums(numerics.kernel, Dim, numerics.nodes_per_h);
    settings.godunov = {numerics.riemann,
                        numerics.limiter,
                        numerics.faces,
                        lattice.density,
                        lattice.gradient,
                        numerics.linear_conduction,
                        numerics.quadratic_conduction};
  }
  sph->pass = make_pair_pass<Dim>(settings);
  sph->support = std::make_unique<SupportSize>(numerics.kernel, Dim, numerics.nodes_per_h);

  sph->criteria = choose_criteria<Dim>(scene);

  sph->evaluate();
  sph->check_health();
  // The first step has no step before it: its previous rates are the present ones.
  for (int a = 0; a < Dim; ++a)
    std::ranges::copy(sph->particles.column(Field::acceleration, a),
                      sph->particles.previous(Field::acceleration, a).begin());
  sph->initial = totals(sph->particles);
  sph->outset = outset(sph->particles, scene, materials);
  return sph;
}

template std::unique_ptr<Sph<2>> assemble<2>(const Scene&, const std::vector<Material>&, std::vector<Stage<2>>,
                                             const std::vector<Placement<2>>&, const std::function<void(Sph<2>&)>&);
template std::unique_ptr<Sph<3>> assemble<3>(const Scene&, const std::vector<Material>&, std::vector<Stage<3>>,
                                             const std::vector<Placement<3>>&, const std::function<void(Sph<3>&)>&);
template std::unique_ptr<Sph<2>> set_up<2>(const Scene&, const std::vector<Material>&);
template std::unique_ptr<Sph<3>> set_up<3>(const Scene&, const std::vector<Material>&);

}  // namespace ejecta
