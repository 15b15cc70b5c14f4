#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "material/tensor_damage.hpp"
#include "particles/smoothing_metric.hpp"
#include "sph/particle_state.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Local strain, or a bound on it where that is below the weakest flaw: the largest principal stress is at most
/// -P + 2 sqrt(J2/3). True for most particles, and it saves them the solution of a cubic.
template <int Dim>
double opening_strain(double pressure, const Deviator<Dim>& s, double weakest, double young, double alpha) {
  const double bound = local_strain(2 * std::sqrt(second_invariant<Dim>(s) / 3) - pressure, 0, young, alpha);
  if (bound < weakest) return bound;
  return local_strain(largest_principal_stress<Dim>(pressure, s), 0, young, alpha);
}

template <int Dim>
OpenCracks cracks_of(const Particles<Dim>& p, const Material& material, std::size_t i) {
  const double weakest = p.column(Field::flaw_strain)[i];
  if (material.damage->growth == CrackLaw::benz_asphaug)
    return dealt_cracks({weakest, p.column(Field::flaw_exponent)[i], p.column(Field::flaw_count)[i]});
  return weibull_cracks(*material.damage, Dim, p.column(Field::mass)[i] / reference_density(material.eos), weakest);
}

/// Radius of the region that cracks relieve [m]: of a sphere (a disc) of the particle's volume, or R_s = h.
template <int Dim>
double relieved_radius(const Particles<Dim>& p, const Material& material, std::size_t i) {
  if (material.damage->growth == CrackLaw::benz_asphaug) return p.column(Field::smoothing_length)[i];
  const double volume = p.column(Field::mass)[i] / p.column(Field::density)[i];
  return Dim == 2 ? std::sqrt(volume / std::numbers::pi) : std::cbrt(volume / (4 * std::numbers::pi / 3));
}

template <int Dim>
double crack_speed(const Particles<Dim>& p, const Material& material, std::size_t i) {
  return material.damage->crack_speed_factor * p.column(Field::sound_speed)[i];
}

/// Scalar damage: carries the crack to the end of the step and returns the tensile damage reached. Pressure and
/// deviator are still those before damage, so the strain is that of the undamaged solid: it does not depend on the
/// damage, and what the damage becomes is an integral.
template <int Dim>
double scalar_damage(Particles<Dim>& p, const Material& material, std::size_t i, double dt) {
  double& crack = p.column(Field::crack_length)[i];
  double& strain = p.column(Field::local_strain)[i];
  const double weakest = p.column(Field::flaw_strain)[i], before = strain;
  strain = opening_strain<Dim>(p.column(Field::pressure)[i], deviator<Dim>(p, i), weakest, material.elastic->young(),
                               distension_of(p, material, i));
  if (std::max(before, strain) >= weakest && crack < 1)
    crack = longer_crack(crack, before, strain, cracks_of(p, material, i),
                         dt * crack_speed(p, material, i) / relieved_radius(p, material, i));
  return crack_damage(crack, material.damage->crack_power(Dim));
}

/// The region that cracks relieve: a sphere (a disc) of the particle's volume, or its smoothing ellipsoid.
template <int Dim>
Mat<Dim> relieved_metric(const Particles<Dim>& p, const Material& material, std::size_t i) {
  if (material.damage->growth == CrackLaw::benz_asphaug && p.has(Field::smoothing_metric))
    return p.symmetric(Field::smoothing_metric, i);
  return round_metric<Dim>(relieved_radius(p, material, i));
}

/// Tensor damage: carries D and the strain to the end of the step and returns the largest eigenvalue of D.
template <int Dim>
double tensor_damage(Particles<Dim>& p, const Material& material, std::size_t i, double dt) {
  Mat<Dim> damage = p.symmetric(Field::damage_tensor, i);
  const Mat<Dim> gradient = straining_gradient(p, material, i), turn = rotation<Dim>(gradient, dt);
  const Mat<Dim> before = turned<Dim>(p.symmetric(Field::strain_history, i), turn);
  const Mat<Dim> after = material.damage->remembers_strain()
                             ? Mat<Dim>(before + dt * straining<Dim>(material.damage->strain, gradient))
                             : stress_strain<Dim>(p.column(Field::pressure)[i], deviator(p, i),
                                                  material.elastic->young(), distension_of(p, material, i));
  p.set_symmetric(Field::strain_history, i, after);
  if (!damage.isZero(0)) damage = turned<Dim>(damage, turn);
  const double weakest = p.column(Field::flaw_strain)[i];
  if (std::max(before.squaredNorm(), after.squaredNorm()) >= weakest * weakest)
    grow_cracks<Dim>(damage, before, after,
                     {cracks_of(p, material, i), crack_speed(p, material, i), relieved_metric(p, material, i)}, dt);
  if (damage.isZero(0)) return 0;
  p.set_symmetric(Field::damage_tensor, i, damage);
  return largest_eigenvalue<Dim>(damage);
}

/// Share of the deviator that damage without a direction leaves.
double left_by(const Material& material, double damage) {
  return material.strength ? std::visit([&](const auto& s) { return s.intact_fraction(damage); }, *material.strength)
                           : 1 - damage;
}

}  // namespace

template <int Dim>
void damage(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Material& material = sph.materials[m];
    if (!material.solid()) continue;
    const bool crushes = material.porosity && material.porosity->crush_damage;
    const bool shears = material.breaks_in_shear();
    if (!material.damage && !crushes && !shears) continue;
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      if (driven(p, sph.scene, i)) {
        p.column(Field::intact_share)[i] = 1;
        return;
      }
      double& broken = p.column(Field::damage)[i];
      double& pressure = p.column(Field::pressure)[i];
      // Nothing is left to grow where scalar damage is complete.
      if (broken >= 1 && !material.tensor_damage()) {
        pressure = damaged_pressure(pressure, 1);
        p.column(Field::intact_share)[i] = left_by(material, 1);
        return;
      }
      // Without a direction: crushed pores, and rock broken in shear.
      const double crushed =
          (crushes ? pore_damage(distension_of(p, material, i), material.porosity->initial_distension()) : 0) +
          (shears ? p.column(Field::shear_damage)[i] : 0);
      double total = crushed;
      if (material.tensor_damage())
        total += tensor_damage(p, material, i, sph.clock.dt);
      else if (material.damage)
        total += scalar_damage(p, material, i, sph.clock.dt);
      // What is broken stays broken.
      broken = total = std::clamp(total, broken, 1.0);
      pressure = damaged_pressure(pressure, total);
      // Cracks with a direction take the deviator away pair by pair.
      p.column(Field::intact_share)[i] = left_by(material, material.cuts_pairs() ? crushed : total);
    });
  }
}

template void damage<2>(Sph<2>&);
template void damage<3>(Sph<3>&);

}  // namespace ejecta
