#include "material/strength_loop.hpp"

#include <algorithm>
#include <cassert>

#include "base/parallel.hpp"

namespace ejecta {

template <int Dim>
void apply_strength(const Material& material, const StrengthColumns<Dim>& c, double dt) {
  assert(material.solid() && material.strength);
  const bool porous = material.porosity.has_value(), damaged = !c.damage.empty(), varies = !c.shear_modulus.empty();
  std::visit(
      [&]<class Model>(const Model& model, const auto& eos) {
        parallel_for(0, c.pressure.size(), [&](std::size_t i) {
          // The model speaks of the solid: its pressure is alpha P, and the body bears 1/alpha of its stress.
          const double alpha = porous ? c.distension[i] : 1.0, e = c.specific_energy[i];
          const double shear = varies ? c.shear_modulus[i] : material.elastic->shear_modulus;
          StrengthState state{.pressure = alpha * c.pressure[i], .damage = damaged ? c.damage[i] : 0.0};
          Deviator<Dim> trial;
          for (std::size_t k = 0; k < c.deviatoric_stress.size(); ++k)
            trial[static_cast<int>(k)] = c.deviatoric_stress[k][i];
          RadialReturn r;
          if constexpr (hardens<Model>) {
            state.plastic_strain = c.plastic_strain[i];
            state.shear_factor = shear / material.elastic->shear_modulus;
            if constexpr (!varies_shear<Model>)  // else the modulus has brought the temperature with it
              state.warmth = warmth(eos, alpha * c.density[i], e);
            r = radial_return<Dim>(alpha * trial, model, state, shear, dt);
          } else {
            const double yield = model.yield(state) * melt_factor(e, material.melt_energy);
            r = radial_return<Dim>(trial, yield / alpha, shear / alpha);
          }
          if (r.scale == 1) return;
          for (const std::span<double>& component : c.deviatoric_stress) component[i] *= r.scale;
          c.plastic_strain[i] += r.plastic_strain;
          if constexpr (may_break_in_shear<Model>)
            if (model.breaks_in_shear()) {
              double& broken = c.shear_damage[i];
              broken = std::min(broken + r.plastic_strain / model.failure_strain(state.pressure), 1.0);
            }
        });
      },
      *material.strength, material.eos);
}

template void apply_strength<2>(const Material&, const StrengthColumns<2>&, double);
template void apply_strength<3>(const Material&, const StrengthColumns<3>&, double);

}  // namespace ejecta
