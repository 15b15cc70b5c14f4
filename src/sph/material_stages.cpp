#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "material/distension_solver.hpp"
#include "sph/particle_state.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Speed of longitudinal waves from that of the fluid: c^2 + 4 G / (3 rho_s). Solid expanded beyond its rest density
/// has broken or melted; counting its shear modulus in full would let a few stray particles dictate the time step.
double longitudinal(double fluid_speed, double shear_modulus, double solid_density, double rest_density) {
  return std::sqrt(fluid_speed * fluid_speed + 4 * shear_modulus / (3 * std::max(solid_density, rest_density)));
}

/// shear(i, solid, rho_s, e) is the shear modulus of particle i with this state of its solid.
template <int Dim, class EosT, class Shear>
void porous_state(Sph<Dim>& sph, const Material& material, const EosT& eos, Range range, const Shear& shear) {
  Particles<Dim>& p = sph.particles;
  const Porosity& porosity = *material.porosity;
  const Numerics& numerics = sph.scene.numerics;
  const auto rho = p.column(Field::density), e = p.column(Field::specific_energy);
  auto pressure = p.column(Field::pressure), sound = p.column(Field::sound_speed), alpha = p.column(Field::distension);
  const bool coupled = p.has(Field::stress_factor);
  sph.unconverged += parallel_sum<std::int64_t>(range.size(), [&](std::size_t k) -> std::int64_t {
    const std::size_t i = range.begin + k;
    const DistensionResult r = solve_distension(porosity.curve, eos, rho[i], e[i], alpha[i], numerics.distension_solver,
                                                numerics.distension_tolerance);
    alpha[i] = r.alpha;
    pressure[i] = bulk_pressure(r.solid, r.alpha);
    const double solid_density = r.alpha * rho[i];
    const double solid_speed =
        longitudinal(ejecta::sound_speed(r.solid, solid_density, eos.sound_speed_floor()),
                     shear(i, r.solid, solid_density, e[i]), solid_density, eos.reference_density());
    sound[i] = porous_sound_speed(porosity, solid_speed, r.alpha);
    if (coupled)
      p.column(Field::stress_factor)[i] =
          porosity.stress_factor ? ejecta::stress_factor(porosity.curve, r.solid, rho[i], r.alpha) : 1.0;
    return r.converged ? 0 : 1;
  });
}

template <int Dim, class EosT, class Shear>
void dense_state(Sph<Dim>& sph, const EosT& eos, Range range, const Shear& shear) {
  Particles<Dim>& p = sph.particles;
  const auto rho = p.column(Field::density), e = p.column(Field::specific_energy);
  auto pressure = p.column(Field::pressure), sound = p.column(Field::sound_speed);
  parallel_for(range.begin, range.end, [&](std::size_t i) {
    const EosPoint point = eos.evaluate(rho[i], e[i]);
    pressure[i] = point.pressure;
    sound[i] = longitudinal(ejecta::sound_speed(point, rho[i], eos.sound_speed_floor()), shear(i, point, rho[i], e[i]),
                            rho[i], eos.reference_density());
  });
}

/// Matter that is drawn out or shocked beyond this goes on without the neighbours of the start.
constexpr double longest_stretch = 2, most_compressed = 1.25;

}  // namespace

template <int Dim>
void equation_of_state(Sph<Dim>& sph) {
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Material& material = sph.materials[m];
    const Range range = sph.particles.material_ranges()[m];
    std::visit(
        [&](const auto& eos) {
          const auto run = [&](const auto& shear) {
            if (material.porosity) {
              porous_state(sph, material, eos, range, shear);
            } else {
              dense_state(sph, eos, range, shear);
            }
          };
          const double constant = material.solid() ? material.elastic->shear_modulus : 0;
          if (!sph.particles.has(Field::shear_modulus)) return run([=](auto&&...) { return constant; });
          const SteinbergGuinan* model = material.variable_shear();
          auto modulus = sph.particles.column(Field::shear_modulus);
          run([&](std::size_t i, const EosPoint& solid, double rho, double e) {
            const double eta = rho / eos.reference_density();
            return modulus[i] =
                       model ? constant * model->shear_factor(solid.pressure, eta, warmth(eos, rho, e)) : constant;
          });
        },
        material.eos);
  }
}

template <int Dim>
void strength(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const bool damaged = p.has(Field::damage), variable_shear = p.has(Field::shear_modulus);
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Material& material = sph.materials[m];
    if (!material.solid() || !material.strength) continue;
    const Range range = p.material_ranges()[m];
    std::visit(
        [&](const auto& model, const auto& eos) {
          parallel_for(range.begin, range.end, [&](std::size_t i) {
            // The model speaks of the solid: its pressure is alpha P, and the body bears 1/alpha of its stress.
            const double alpha = distension_of(p, material, i), e = p.column(Field::specific_energy)[i];
            const double shear = variable_shear ? p.column(Field::shear_modulus)[i] : material.elastic->shear_modulus;
            StrengthState state{.pressure = alpha * p.column(Field::pressure)[i],
                                .damage = damaged ? p.column(Field::damage)[i] : 0.0};
            const Deviator<Dim> trial = deviator<Dim>(p, i);
            RadialReturn r;
            if constexpr (hardens<std::decay_t<decltype(model)>>) {
              state.plastic_strain = p.column(Field::plastic_strain)[i];
              state.shear_factor = shear / material.elastic->shear_modulus;
              if (!material.variable_shear())  // else the modulus has brought the temperature with it
                state.warmth = warmth(eos, alpha * p.column(Field::density)[i], e);
              r = radial_return<Dim>(alpha * trial, model, state, shear, sph.clock.dt);
            } else {
              const double yield = model.yield(state) * melt_factor(e, material.melt_energy);
              r = radial_return<Dim>(trial, yield / alpha, shear / alpha);
            }
            if (r.scale == 1) return;
            for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::deviatoric_stress, k)[i] *= r.scale;
            p.column(Field::plastic_strain)[i] += r.plastic_strain;
            if constexpr (std::is_same_v<std::decay_t<decltype(model)>, Collins>)
              if (model.breaks_in_shear()) {
                double& broken = p.column(Field::shear_damage)[i];
                broken = std::min(broken + r.plastic_strain / model.failure_strain(state.pressure), 1.0);
              }
          });
        },
        *material.strength, material.eos);
  }
}

template <int Dim>
void bonds(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const bool yields = p.has(Field::plastic_strain);
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Range range = p.material_ranges()[m];
    const double densest = most_compressed * sph.materials[m].bulk_density();
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      const bool torn = p.column(Field::stretch)[i] > longest_stretch || p.column(Field::density)[i] > densest;
      if (torn || (yields && p.column(Field::plastic_strain)[i] > 0)) p.column(Field::bond)[i] = 0;
    });
  }
}

template void bonds<2>(Sph<2>&);
template void bonds<3>(Sph<3>&);
template void equation_of_state<2>(Sph<2>&);
template void equation_of_state<3>(Sph<3>&);
template void strength<2>(Sph<2>&);
template void strength<3>(Sph<3>&);

}  // namespace ejecta
