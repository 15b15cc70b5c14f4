#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "material/distension_solver.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {

/// Speed of longitudinal waves from that of the fluid: c^2 + 4 G / (3 rho_s). Solid expanded beyond its rest density
/// has broken or melted; counting its shear modulus in full would let a few stray particles dictate the time step.
double longitudinal(double fluid_speed, double shear_modulus, double solid_density, double rest_density) {
  return std::sqrt(fluid_speed * fluid_speed + 4 * shear_modulus / (3 * std::max(solid_density, rest_density)));
}

template <int Dim>
Deviator<Dim> deviator(const Particles<Dim>& particles, std::size_t i) {
  Deviator<Dim> s;
  for (int k = 0; k < deviator_size<Dim>; ++k) s[k] = particles.column(Field::deviatoric_stress, k)[i];
  return s;
}

template <int Dim, class EosT>
void porous_state(Simulation<Dim>& sim, const Material& material, const EosT& eos, Range range) {
  Particles<Dim>& p = sim.particles;
  const Porosity& porosity = *material.porosity;
  const Numerics& numerics = sim.scene.numerics;
  const double shear = material.solid() ? material.elastic->shear_modulus : 0;
  const auto rho = p.column(Field::density), e = p.column(Field::specific_energy);
  auto pressure = p.column(Field::pressure), sound = p.column(Field::sound_speed), alpha = p.column(Field::distension);
  const bool coupled = p.has(Field::stress_factor);
  sim.unconverged += parallel_sum<std::int64_t>(range.size(), [&](std::size_t k) -> std::int64_t {
    const std::size_t i = range.begin + k;
    const DistensionResult r = solve_distension(porosity.curve, eos, rho[i], e[i], alpha[i], numerics.distension_solver,
                                                numerics.distension_tolerance);
    alpha[i] = r.alpha;
    pressure[i] = bulk_pressure(r.solid, r.alpha);
    const double solid_density = r.alpha * rho[i];
    const double solid_speed = longitudinal(ejecta::sound_speed(r.solid, solid_density, eos.sound_speed_floor()), shear,
                                            solid_density, eos.reference_density());
    sound[i] = porous_sound_speed(porosity, solid_speed, r.alpha);
    if (coupled)
      p.column(Field::stress_factor)[i] =
          porosity.stress_factor ? ejecta::stress_factor(porosity.curve, r.solid, rho[i], r.alpha) : 1.0;
    return r.converged ? 0 : 1;
  });
}

template <int Dim, class EosT>
void dense_state(Simulation<Dim>& sim, const Material& material, const EosT& eos, Range range) {
  Particles<Dim>& p = sim.particles;
  const double shear = material.solid() ? material.elastic->shear_modulus : 0;
  const auto rho = p.column(Field::density), e = p.column(Field::specific_energy);
  auto pressure = p.column(Field::pressure), sound = p.column(Field::sound_speed);
  parallel_for(range.begin, range.end, [&](std::size_t i) {
    const EosPoint point = eos.evaluate(rho[i], e[i]);
    pressure[i] = point.pressure;
    sound[i] = longitudinal(ejecta::sound_speed(point, rho[i], eos.sound_speed_floor()), shear, rho[i],
                            eos.reference_density());
  });
}

/// Local strain, or 0 where a bound on the largest principal stress, -P + 2 sqrt(J2/3), shows that it cannot reach the
/// weakest flaw: true for most particles, and it saves them the solution of a cubic.
template <int Dim>
double opening_strain(double pressure, const Deviator<Dim>& s, double weakest, double young, double alpha) {
  const double bound = 2 * std::sqrt(second_invariant<Dim>(s) / 3) - pressure;
  if (local_strain(bound, 0, young, alpha) < weakest) return 0;
  return local_strain(largest_principal_stress<Dim>(pressure, s), 0, young, alpha);
}

/// Distension of a particle; 1 where its material has no pores.
template <int Dim>
double distension_of(const Particles<Dim>& p, const Material& material, std::size_t i) {
  return material.porosity ? p.column(Field::distension)[i] : 1.0;
}

}  // namespace

template <int Dim>
void equation_of_state(Simulation<Dim>& sim) {
  for (std::size_t m = 0; m < sim.materials.size(); ++m) {
    const Material& material = sim.materials[m];
    const Range range = sim.particles.material_ranges()[m];
    std::visit(
        [&](const auto& eos) {
          if (material.porosity) {
            porous_state(sim, material, eos, range);
          } else {
            dense_state(sim, material, eos, range);
          }
        },
        material.eos);
  }
}

template <int Dim>
void strength(Simulation<Dim>& sim) {
  Particles<Dim>& p = sim.particles;
  for (std::size_t m = 0; m < sim.materials.size(); ++m) {
    const Material& material = sim.materials[m];
    if (!material.solid() || !material.strength) continue;
    const Range range = p.material_ranges()[m];
    const bool damaged = p.has(Field::damage);
    std::visit(
        [&](const auto& model) {
          parallel_for(range.begin, range.end, [&](std::size_t i) {
            // The model speaks of the solid: its pressure is alpha P, and the body bears 1/alpha of its stress.
            const double alpha = distension_of(p, material, i);
            const double cold =
                model.yield(alpha * p.column(Field::pressure)[i], damaged ? p.column(Field::damage)[i] : 0.0);
            const double yield = cold * melt_factor(p.column(Field::specific_energy)[i], material.melt_energy) / alpha;
            const RadialReturn r = radial_return<Dim>(deviator(p, i), yield, material.elastic->shear_modulus / alpha);
            if (r.scale == 1) return;
            for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::deviatoric_stress, k)[i] *= r.scale;
            p.column(Field::plastic_strain)[i] += r.plastic_strain;
          });
        },
        *material.strength);
  }
}

template <int Dim>
void damage(Simulation<Dim>& sim) {
  Particles<Dim>& p = sim.particles;
  for (std::size_t m = 0; m < sim.materials.size(); ++m) {
    const Material& material = sim.materials[m];
    if (!material.solid()) continue;
    const bool crushes = material.porosity && material.porosity->crush_damage;
    if (!material.damage && !crushes) continue;
    const Range range = p.material_ranges()[m];
    const double young = material.elastic->young();
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      double& pressure = p.column(Field::pressure)[i];
      const double alpha = distension_of(p, material, i);
      double total = crushes ? pore_damage(alpha, material.porosity->initial_distension()) : 0;
      if (material.damage) {
        // A last step may carry the crack length beyond 1; cutting it off there would let the corrector heal it.
        const double crack = std::min(p.column(Field::crack)[i], 1.0);
        const Flaws flaws{p.column(Field::flaw_strain)[i], p.column(Field::flaw_exponent)[i],
                          p.column(Field::flaw_count)[i]};
        // Pressure and deviator are still those before damage, so the strain is that of the undamaged solid.
        const double active =
            active_flaws(opening_strain<Dim>(pressure, deviator(p, i), flaws.strain, young, alpha), flaws);
        const double crack_speed = material.damage->crack_speed_factor * p.column(Field::sound_speed)[i];
        p.column(Field::crack_rate)[i] =
            crack < crack_limit(active, flaws)
                ? crack_growth_rate(active, crack_speed, p.column(Field::smoothing_length)[i])
                : 0.0;
        total += crack * crack * crack;
      }
      // What is broken stays broken, also where the corrector takes back part of the crack that was predicted.
      double& broken = p.column(Field::damage)[i];
      broken = total = std::clamp(total, broken, 1.0);
      pressure = damaged_pressure(pressure, total);
      sim.intact[i] = material.strength
                          ? std::visit([&](const auto& s) { return s.intact_fraction(total); }, *material.strength)
                          : 1 - total;
    });
  }
}

template void equation_of_state<2>(Simulation<2>&);
template void equation_of_state<3>(Simulation<3>&);
template void strength<2>(Simulation<2>&);
template void strength<3>(Simulation<3>&);
template void damage<2>(Simulation<2>&);
template void damage<3>(Simulation<3>&);

}  // namespace ejecta
