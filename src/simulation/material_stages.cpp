#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "material/distension_solver.hpp"
#include "simulation/particle_state.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {

/// Speed of longitudinal waves from that of the fluid: c^2 + 4 G / (3 rho_s). Solid expanded beyond its rest density
/// has broken or melted; counting its shear modulus in full would let a few stray particles dictate the time step.
double longitudinal(double fluid_speed, double shear_modulus, double solid_density, double rest_density) {
  return std::sqrt(fluid_speed * fluid_speed + 4 * shear_modulus / (3 * std::max(solid_density, rest_density)));
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
            const RadialReturn r =
                radial_return<Dim>(deviator<Dim>(p, i), yield, material.elastic->shear_modulus / alpha);
            if (r.scale == 1) return;
            for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::deviatoric_stress, k)[i] *= r.scale;
            p.column(Field::plastic_strain)[i] += r.plastic_strain;
          });
        },
        *material.strength);
  }
}

template void equation_of_state<2>(Simulation<2>&);
template void equation_of_state<3>(Simulation<3>&);
template void strength<2>(Simulation<2>&);
template void strength<3>(Simulation<3>&);

}  // namespace ejecta
