#include "sph/stages.hpp"

#include <algorithm>

namespace ejecta {

namespace {

/// What a switch means; automatic: yes unless all is gas that has never been condensed.
bool holds(Switch choice, const std::vector<Material>& materials) {
  const auto gas = [](const Material& m) { return m.gas() && !m.explosive(); };
  return choice == Switch::on || (choice == Switch::automatic && !std::all_of(materials.begin(), materials.end(), gas));
}

/// Fields of a stage: those that it always has, with those that a scene may bring.
struct Fields {
  std::vector<Field> list;
  Fields(std::initializer_list<Field> always) : list(always) {}
  Fields& with(bool condition, std::initializer_list<Field> more) {
    if (condition) list.insert(list.end(), more);
    return *this;
  }
};

}  // namespace

bool corrects_gradients(const Scene& scene, const std::vector<Material>& materials) {
  return !scene.numerics.godunov() && holds(scene.numerics.gradient_correction, materials);
}

template <int Dim>
std::vector<Stage<Dim>> choose_stages(const Scene& scene, const std::vector<Material>& materials) {
  using enum Field;
  auto any = [&](auto has) { return std::any_of(materials.begin(), materials.end(), has); };
  const bool solid = any([](const Material& m) { return m.solid(); });
  const bool yields = any([](const Material& m) { return m.solid() && m.strength; });
  const bool porous = any([](const Material& m) { return m.porosity.has_value(); });
  const bool variable_shear = any([](const Material& m) { return m.variable_shear(); });
  const bool shears = any([](const Material& m) { return m.breaks_in_shear(); });
  const bool crushes = any([](const Material& m) { return m.porosity && m.porosity->crush_damage && m.solid(); });
  const bool breaks = shears || crushes || any([](const Material& m) { return m.damage.has_value(); });
  const bool grady_kipp = any([](const Material& m) { return m.damage.has_value(); });
  const bool scalar_cracks = any([](const Material& m) { return m.damage && !m.tensor_damage(); });
  const bool tensor_cracks = any([](const Material& m) { return m.tensor_damage(); });
  const bool coupled = any([](const Material& m) { return m.cuts_pairs(); });
  const bool dealt = any([](const Material& m) { return m.damage && m.damage->growth == CrackLaw::benz_asphaug; });
  const bool warms = any([](const Material& m) { return m.yield_needs_temperature(); });
  const bool burns = any([](const Material& m) { return m.explosive().has_value(); });
  const bool driven = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) { return b.driven; });
  const bool continuity = scene.numerics.density == DensityMethod::continuity;
  const bool balsara = holds(scene.numerics.balsara, materials);
  const bool switched = holds(scene.numerics.shock_switch, materials);
  const bool bonded = scene.numerics.bonds == Switch::on || (scene.numerics.bonds == Switch::automatic &&
                                                             any([](const Material& m) { return m.stretches(); }));
  const bool tensor = scene.numerics.tensors();
  const bool godunov = scene.numerics.godunov();
  const bool conducts = scene.numerics.conducts();
  const Switch filling_asked = scene.numerics.fill_space;
  // First order with uncorrected faces needs no slopes.
  const bool slopes =
      godunov && (tensor || continuity || conducts || filling_asked == Switch::on ||
                  scene.numerics.limiter != PairLimiter::none || scene.numerics.faces == PairFaces::renormalised);
  const bool fills =
      slopes && !continuity &&
      (filling_asked == Switch::on || (filling_asked == Switch::automatic && !is_set(scene.numerics.pilot_width)));
  const bool gradient = solid || continuity || balsara || switched || tensor || corrects_gradients(scene, materials);

  std::vector<Stage<Dim>> stages;
  auto add_work = [&](std::string name, Fields reads, Fields writes, StageWork<Dim> work) {
    stages.push_back({std::move(work), std::move(name), std::move(reads.list), std::move(writes.list)});
  };
  auto add = [&](std::string name, Fields reads, Fields writes, void (*run)(Sph<Dim>&)) {
    add_work(std::move(name), std::move(reads), std::move(writes), {.run = run});
  };
  if (tensor)
    add("carried smoothing", Fields{velocity_gradient, smoothing_metric}.with(bonded, {bond}),
        {smoothing_metric, smoothing_length}, carry_smoothing<Dim>);
  add_work("neighbours", Fields{position, velocity, smoothing_length}.with(tensor, {smoothing_metric}),
           Fields{}.with(scene.boundary.bounded(), {position, velocity}), neighbours<Dim>());
  if (tensor)
    add_work("shapes", Fields{position, mass, smoothing_length, smoothing_metric}.with(bonded, {bond}),
             {smoothing_length, smoothing_metric, zeroth_moment}, vote_shapes<Dim>());
  if (!continuity)
    add("density",
        Fields{position, smoothing_length, mass}.with(
            fills, {density, pressure, sound_speed, density_gradient, pressure_gradient, volume_excess}),
        Fields{density, zeroth_moment, smoothing_length}.with(fills, {filling, volume_excess}), summation_density<Dim>);
  if (burns) add("burn", {density, lighting_time, burnt}, {burnt}, burn<Dim>);
  add("equation of state", Fields{density, specific_energy}.with(burns, {burnt}).with(porous, {distension}),
      Fields{pressure, sound_speed}
          .with(porous, {distension})
          .with(porous && solid, {stress_factor})
          .with(variable_shear, {shear_modulus}),
      equation_of_state<Dim>);
  if (yields)
    add("strength",
        Fields{deviatoric_stress, pressure, specific_energy, plastic_strain}
            .with(warms, {density})
            .with(porous, {distension})
            .with(breaks, {Field::damage})
            .with(shears, {shear_damage})
            .with(variable_shear, {shear_modulus}),
        Fields{deviatoric_stress, plastic_strain}.with(shears, {shear_damage}), strength<Dim>);
  if (bonded) add("bonds", Fields{stretch, density, bond}.with(yields, {plastic_strain}), {bond}, bonds<Dim>);
  if (breaks)
    add("damage",
        Fields{Field::damage, pressure}
            .with(crushes || porous, {distension})
            .with(shears, {shear_damage})
            .with(grady_kipp, {deviatoric_stress, density, mass, sound_speed, flaw_strain})
            .with(dealt, {flaw_exponent, flaw_count})
            .with(dealt && (scalar_cracks || !tensor), {smoothing_length})
            .with(dealt && tensor_cracks && tensor, {smoothing_metric})
            .with(scalar_cracks, {crack_length, local_strain})
            .with(tensor_cracks, {damage_tensor, strain_history})
            .with(tensor_cracks && !coupled, {velocity_gradient})
            .with(coupled, {uncut_gradient}),
        Fields{Field::damage, intact_share, pressure}
            .with(scalar_cracks, {crack_length, local_strain})
            .with(tensor_cracks, {damage_tensor, strain_history}),
        ejecta::damage<Dim>);
  if (slopes)
    add("slopes",
        Fields{position, velocity, smoothing_length, mass, density, pressure, sound_speed}.with(tensor,
                                                                                                {smoothing_metric}),
        {density_gradient, pressure_gradient, velocity_gradient, face_correction}, ejecta::slopes<Dim>);
  add("pair rates",
      Fields{position, velocity, smoothing_length, mass, density, pressure, sound_speed}
          .with(tensor, {smoothing_metric})
          .with(solid, {deviatoric_stress})
          .with(breaks, {intact_share})
          .with(coupled, {damage_tensor})
          .with(gradient, {velocity_gradient})
          .with(slopes, {density_gradient, pressure_gradient, velocity_gradient, face_correction})
          .with(conducts, {specific_energy})
          .with(balsara, {viscosity_factor})
          .with(switched, {Field::shock_switch})
          .with(bonded, {start_position, bond}),
      Fields{acceleration, specific_energy_rate, zeroth_moment, largest_mu}
          .with(gradient && !godunov, {velocity_gradient})
          .with(continuity && godunov, {compression_rate})
          .with(coupled, {uncut_gradient})
          .with(bonded, {stretch}),
      pair_rates<Dim>);
  if (driven) add("driven bodies", {acceleration, velocity, mass, position}, {acceleration}, driven_bodies<Dim>);
  if ((continuity || solid) && !godunov)  // what faces sweep is among the pair rates
    add("strain rates",
        Fields{velocity_gradient}
            .with(continuity, {density, zeroth_moment, smoothing_length, mass, specific_energy, sound_speed})
            .with(solid, {deviatoric_stress})
            .with(porous && solid, {distension, stress_factor})
            .with(coupled, {uncut_gradient})
            .with(variable_shear, {shear_modulus}),
        Fields{}.with(continuity, {density, compression_rate}).with(solid, {stress_rate}), strain_rates<Dim>);
  if (balsara || switched)
    add("viscosity switches",
        Fields{velocity_gradient, sound_speed, smoothing_length}.with(switched, {Field::shock_switch}),
        Fields{}.with(balsara, {viscosity_factor}).with(switched, {Field::shock_switch}), viscosity_switches<Dim>);
  if (continuity && scene.numerics.smoothing_growth > 1)
    add("smoothing lengths",
        Fields{zeroth_moment, smoothing_length}.with(tensor, {smoothing_metric}).with(bonded, {bond}),
        Fields{smoothing_length}.with(tensor, {smoothing_metric}), smoothing_lengths<Dim>);
  if (scene.output.peaks)
    add("peaks", {position, pressure, specific_energy, density, pressure_peak, specific_energy_peak, density_low},
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
