#include <algorithm>

#include "base/parallel.hpp"
#include "material/eos_loop.hpp"
#include "material/strength_loop.hpp"
#include "sph/particle_state.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// The particles of one material in a column; empty if this run has no such field.
template <int Dim>
std::span<double> part(Particles<Dim>& p, Range range, Field field, int component = 0) {
  return p.has(field) ? p.column(field, component).subspan(range.begin, range.size()) : std::span<double>{};
}

/// Matter that is drawn out or shocked beyond this goes on without the neighbours of the start.
constexpr double longest_stretch = 2, most_compressed = 1.25;

}  // namespace

template <int Dim>
void equation_of_state(Sph<Dim>& sph) {
  const Numerics& numerics = sph.scene.numerics;
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const auto of = [&](Field f) { return part(sph.particles, sph.particles.material_ranges()[m], f); };
    sph.unconverged += equation_of_state(sph.materials[m],
                                         {.density = of(Field::density),
                                          .specific_energy = of(Field::specific_energy),
                                          .reacted = of(Field::burnt),
                                          .pressure = of(Field::pressure),
                                          .sound_speed = of(Field::sound_speed),
                                          .distension = of(Field::distension),
                                          .stress_factor = of(Field::stress_factor),
                                          .shear_modulus = of(Field::shear_modulus)},
                                         {numerics.distension_solver, numerics.distension_tolerance});
  }
}

template <int Dim>
void strength(Sph<Dim>& sph) {
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Material& material = sph.materials[m];
    if (!material.solid() || !material.strength) continue;
    const Range range = sph.particles.material_ranges()[m];
    const auto of = [&](Field f, int component = 0) { return part(sph.particles, range, f, component); };
    StrengthColumns<Dim> columns{.density = of(Field::density),
                                 .specific_energy = of(Field::specific_energy),
                                 .pressure = of(Field::pressure),
                                 .distension = of(Field::distension),
                                 .damage = of(Field::damage),
                                 .shear_modulus = of(Field::shear_modulus),
                                 .deviatoric_stress = {},
                                 .plastic_strain = of(Field::plastic_strain),
                                 .shear_damage = of(Field::shear_damage)};
    for (int k = 0; k < deviator_size<Dim>; ++k)
      columns.deviatoric_stress[static_cast<std::size_t>(k)] = of(Field::deviatoric_stress, k);
    apply_strength<Dim>(material, columns, sph.clock.dt);
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
