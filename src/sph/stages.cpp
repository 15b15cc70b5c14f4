#include "sph/stages.hpp"

#include <algorithm>

namespace ejecta {

namespace {

/// What a switch means; automatic: yes unless all is ideal gas.
bool holds(Switch choice, const std::vector<Material>& materials) {
  const auto gas = [](const Material& m) { return std::holds_alternative<IdealGas>(m.eos); };
  return choice == Switch::on || (choice == Switch::automatic && !std::all_of(materials.begin(), materials.end(), gas));
}

}  // namespace

bool corrects_gradients(const Scene& scene, const std::vector<Material>& materials) {
  return holds(scene.numerics.gradient_correction, materials);
}

template <int Dim>
std::vector<Stage<Dim>> choose_stages(const Scene& scene, const std::vector<Material>& materials) {
  using enum Field;
  auto any = [&](auto has) { return std::any_of(materials.begin(), materials.end(), has); };
  const bool solid = any([](const Material& m) { return m.solid(); });
  const bool yields = any([](const Material& m) { return m.solid() && m.strength; });
  const bool porous = any([](const Material& m) { return m.porosity.has_value(); });
  const bool variable_shear = any([](const Material& m) { return m.variable_shear() != nullptr; });
  const bool shears = any([](const Material& m) { return m.breaks_in_shear(); });
  const bool crushes = any([](const Material& m) { return m.porosity && m.porosity->crush_damage && m.solid(); });
  const bool breaks = shears || crushes || any([](const Material& m) { return m.damage.has_value(); });
  const bool grady_kipp = any([](const Material& m) { return m.damage.has_value(); });
  const bool scalar_cracks = any([](const Material& m) { return m.damage && !m.tensor_damage(); });
  const bool tensor_cracks = any([](const Material& m) { return m.tensor_damage(); });
  const bool coupled = any([](const Material& m) { return m.cuts_pairs(); });
  const bool dealt = any([](const Material& m) { return m.damage && m.damage->growth == CrackLaw::benz_asphaug; });
  const bool driven = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) { return b.driven; });
  const bool continuity = scene.numerics.density == DensityMethod::continuity;
  const bool balsara = holds(scene.numerics.balsara, materials);
  const bool switched = holds(scene.numerics.shock_switch, materials);
  const bool bonded = scene.numerics.bonds == Switch::on || (scene.numerics.bonds == Switch::automatic &&
                                                             any([](const Material& m) { return m.stretches(); }));
  const bool tensor = scene.numerics.scheme == SchemeKind::asph;
  const bool gradient = solid || continuity || balsara || switched || tensor || corrects_gradients(scene, materials);

  std::vector<Stage<Dim>> stages;
  auto add = [&](std::string name, std::vector<Field> reads, std::vector<Field> writes,
                 std::function<void(Sph<Dim>&)> run) {
    stages.push_back({std::move(name), std::move(reads), std::move(writes), std::move(run)});
  };
  auto extended = [](std::vector<Field> fields, bool condition, std::initializer_list<Field> more) {
    if (condition) fields.insert(fields.end(), more);
    return fields;
  };

  if (tensor)
    add("carried smoothing", {velocity_gradient, smoothing_metric}, {smoothing_metric, smoothing_length},
        carry_smoothing<Dim>);
  add("neighbours", {position, velocity, smoothing_length, mass}, {}, neighbours<Dim>());
  if (tensor)
    add("shapes", {position, mass, smoothing_length, smoothing_metric},
        {smoothing_length, smoothing_metric, neighbour_sum}, vote_shapes<Dim>());
  if (!continuity)
    add("density", {position, smoothing_length, mass}, {density, neighbour_sum, smoothing_length},
        summation_density<Dim>);
  add("equation of state", extended({density, specific_energy}, porous, {distension}),
      extended(extended({pressure, sound_speed}, porous,
                        solid ? std::initializer_list<Field>{distension, stress_factor}
                              : std::initializer_list<Field>{distension}),
               variable_shear, {shear_modulus}),
      equation_of_state<Dim>);
  if (yields)
    add("strength",
        extended(extended({deviatoric_stress, pressure, specific_energy}, breaks, {Field::damage}), variable_shear,
                 {shear_modulus}),
        extended({deviatoric_stress, plastic_strain}, shears, {shear_damage}), strength<Dim>);
  if (bonded) add("bonds", extended({stretch, density}, yields, {plastic_strain}), {bond}, bonds<Dim>);
  if (breaks)
    add("damage",
        extended(
            extended(extended(extended(extended({pressure, deviatoric_stress, density, mass}, grady_kipp, {flaw_strain}),
                                       dealt, {flaw_exponent, flaw_count, smoothing_length}),
                              scalar_cracks, {crack, local_strain}),
                     tensor_cracks, {damage_tensor, strain_history, velocity_gradient}),
            shears, {shear_damage}),
        extended(extended({Field::damage, intact_share, pressure}, scalar_cracks, {crack, local_strain}),
                 tensor_cracks, {damage_tensor, strain_history}),
        ejecta::damage<Dim>);
  add("pair rates",
      extended(extended(extended(extended({position, velocity, smoothing_length, mass, density, pressure, sound_speed},
                                          solid, {deviatoric_stress}),
                                 balsara, {viscosity_factor}),
                        switched, {shock_switch, velocity_gradient}),
               bonded, {start_position, bond}),
      extended(extended(extended({acceleration, heating, neighbour_sum, approach_speed}, gradient, {velocity_gradient}),
                        coupled, {coupled_gradient}),
               bonded, {stretch}),
      pair_rates<Dim>);
  if (driven) add("driven bodies", {acceleration, velocity, mass}, {acceleration}, driven_bodies<Dim>);
  if (continuity || solid)
    add("strain rates",
        extended(extended(extended({velocity_gradient, density}, continuity, {neighbour_sum, smoothing_length, mass}),
                          solid, {deviatoric_stress}),
                 variable_shear, {shear_modulus}),
        extended(extended({}, continuity, {compression_rate, density}), solid, {stress_rate}), strain_rates<Dim>);
  if (balsara || switched)
    add("viscosity switches", {velocity_gradient, sound_speed, smoothing_length},
        extended(extended({}, balsara, {viscosity_factor}), switched, {Field::shock_switch}),
        viscosity_switches<Dim>);
  if (continuity && scene.numerics.smoothing_growth > 1)
    add("smoothing lengths", {neighbour_sum, smoothing_length, mass}, {smoothing_length}, smoothing_lengths<Dim>);
  if (scene.output.peaks)
    add("peaks", {position, pressure, specific_energy, density},
        {pressure_peak, specific_energy_peak, density_low, initial_position}, peaks<Dim>);
  return stages;
}

template <int Dim>
std::vector<Field> fields_of(const std::vector<Stage<Dim>>& stages) {
  std::array<bool, field_count> named{};
  for (const auto& stage : stages)
    for (const auto* list : {&stage.reads, &stage.writes})
      for (Field f : *list) named[static_cast<std::size_t>(f)] = true;
  std::vector<Field> fields;
  for (const FieldInfo& f : field_catalogue())
    if (named[static_cast<std::size_t>(f.field)]) fields.push_back(f.field);
  return fields;
}

template std::vector<Stage<2>> choose_stages<2>(const Scene&, const std::vector<Material>&);
template std::vector<Stage<3>> choose_stages<3>(const Scene&, const std::vector<Material>&);
template std::vector<Field> fields_of<2>(const std::vector<Stage<2>>&);
template std::vector<Field> fields_of<3>(const std::vector<Stage<3>>&);

}  // namespace ejecta
