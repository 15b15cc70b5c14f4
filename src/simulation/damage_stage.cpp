#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "material/tensor_damage.hpp"
#include "simulation/particle_state.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {

/// Local strain, or 0 where a bound on the largest principal stress, -P + 2 sqrt(J2/3), shows that it cannot reach the
/// weakest flaw: true for most particles, and it saves them the solution of a cubic.
template <int Dim>
double opening_strain(double pressure, const Deviator<Dim>& s, double weakest, double young, double alpha) {
  const double bound = 2 * std::sqrt(second_invariant<Dim>(s) / 3) - pressure;
  if (local_strain(bound, 0, young, alpha) < weakest) return 0;
  return local_strain(largest_principal_stress<Dim>(pressure, s), 0, young, alpha);
}

template <int Dim>
Flaws flaws_of(const Particles<Dim>& p, std::size_t i) {
  return {p.column(Field::flaw_strain)[i], p.column(Field::flaw_exponent)[i], p.column(Field::flaw_count)[i]};
}

/// Scalar damage: sets the growth of the crack length and returns the tensile damage reached. Pressure and deviator are
/// still those before damage, so the strain is that of the undamaged solid.
template <int Dim>
double scalar_damage(Particles<Dim>& p, const Material& material, std::size_t i) {
  // A last step may carry the crack length beyond 1; cutting it off there would let the corrector heal it.
  const double crack = std::min(p.column(Field::crack)[i], 1.0);
  const Flaws flaws = flaws_of(p, i);
  const double active =
      active_flaws(opening_strain<Dim>(p.column(Field::pressure)[i], deviator<Dim>(p, i), flaws.strain,
                                       material.elastic->young(), distension_of(p, material, i)),
                   flaws);
  const double crack_speed = material.damage->crack_speed_factor * p.column(Field::sound_speed)[i];
  p.column(Field::crack_rate)[i] = crack < crack_limit(active, flaws)
                                       ? crack_growth_rate(active, crack_speed, p.column(Field::smoothing_length)[i])
                                       : 0.0;
  return crack * crack * crack;
}

/// G of a particle; I/h^2 without ASPH.
template <int Dim>
Mat<Dim> metric_of(const Particles<Dim>& p, std::size_t i) {
  if (p.has(Field::smoothing_metric)) return p.symmetric(Field::smoothing_metric, i);
  const double h = p.column(Field::smoothing_length)[i];
  return Mat<Dim>(Mat<Dim>::Identity()) / (h * h);
}

/// The strain that opens flaws, brought to the end of the step; `turn` is the rotation of the matter in it.
template <int Dim>
Mat<Dim> crack_strain(Particles<Dim>& p, const Material& material, std::size_t i, const Mat<Dim>& gradient,
                      const Mat<Dim>& turn, double dt) {
  const CrackStrain choice = material.damage->strain;
  if (!material.damage->remembers_strain())
    return stress_strain<Dim>(p.column(Field::pressure)[i], deviator(p, i), material.elastic->young(),
                              distension_of(p, material, i));
  const Mat<Dim> strain =
      turned<Dim>(p.symmetric(Field::strain_history, i), turn) + dt * straining<Dim>(choice, gradient);
  p.set_symmetric(Field::strain_history, i, strain);
  return strain;
}

/// Tensor damage: carries D and the strain to the end of the step and returns the largest eigenvalue of D.
template <int Dim>
double tensor_damage(Particles<Dim>& p, const Material& material, std::size_t i, double dt) {
  Mat<Dim> damage = p.symmetric(Field::damage_tensor, i);
  const bool broken = !damage.isZero(0);
  const bool moves = broken || material.damage->remembers_strain();
  const Mat<Dim> gradient = moves ? straining_gradient(p, material, i) : Mat<Dim>(Mat<Dim>::Zero());
  const Mat<Dim> turn = rotation<Dim>(gradient, dt);
  const Mat<Dim> strain = crack_strain(p, material, i, gradient, turn, dt);
  if (broken) damage = turned<Dim>(damage, turn);
  const double crack_speed = material.damage->crack_speed_factor * p.column(Field::sound_speed)[i];
  const CrackGrowth<Dim> growth{flaws_of(p, i), crack_speed, metric_of(p, i)};
  p.column(Field::damage_tensor_growth)[i] = grow_cracks<Dim>(damage, strain, growth, dt);
  p.set_symmetric(Field::damage_tensor, i, damage);
  return largest_eigenvalue<Dim>(damage);
}

}  // namespace

template <int Dim>
void damage(Simulation<Dim>& sim) {
  Particles<Dim>& p = sim.particles;
  for (std::size_t m = 0; m < sim.materials.size(); ++m) {
    const Material& material = sim.materials[m];
    if (!material.solid()) continue;
    const bool crushes = material.porosity && material.porosity->crush_damage;
    if (!material.damage && !crushes) continue;
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      if (driven(p, sim.scene, i)) {
        sim.intact[i] = 1;
        return;
      }
      const double pores =
          crushes ? pore_damage(distension_of(p, material, i), material.porosity->initial_distension()) : 0;
      double total = pores;
      if (material.tensor_damage())
        total += tensor_damage(p, material, i, sim.clock.dt);
      else if (material.damage)
        total += scalar_damage(p, material, i);
      // What is broken stays broken, also where the corrector takes back part of the crack that was predicted.
      double& broken = p.column(Field::damage)[i];
      broken = total = std::clamp(total, broken, 1.0);
      double& pressure = p.column(Field::pressure)[i];
      pressure = damaged_pressure(pressure, total);
      // Cracks with a direction take the deviator away pair by pair; crushed pores have none.
      const double everywhere = material.cuts_pairs() ? pores : total;
      sim.intact[i] = material.strength
                          ? std::visit([&](const auto& s) { return s.intact_fraction(everywhere); }, *material.strength)
                          : 1 - everywhere;
    });
  }
}

template void damage<2>(Simulation<2>&);
template void damage<3>(Simulation<3>&);

}  // namespace ejecta
