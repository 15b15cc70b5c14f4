#include "material/eos_loop.hpp"

#include <algorithm>
#include <cassert>

namespace ejecta {

std::int64_t equation_of_state(const Material& material, const EosColumns& columns, const DistensionSearch& search) {
  [[maybe_unused]] const std::size_t n = columns.density.size();
  assert(columns.specific_energy.size() == n && columns.pressure.size() == n && columns.sound_speed.size() == n);
  assert(!material.porosity || columns.distension.size() == n);
  assert(!material.variable_shear() || columns.shear_modulus.size() == n);
  return std::visit(
      [&]<class EosT>(const EosT& eos) -> std::int64_t {
        const auto run = [&](const auto& shear) -> std::int64_t {
          if constexpr (!reacts<EosT>)
            if (material.porosity) return porous_states(eos, *material.porosity, search, shear, columns);
          assert(!material.porosity);
          dense_states(eos, shear, columns);
          return 0;
        };
        const double constant = material.solid() ? material.elastic->shear_modulus : 0;
        if (!material.variable_shear()) {
          std::ranges::fill(columns.shear_modulus, constant);
          return run(ConstantShear{constant});
        }
        return std::visit(
            [&]<class Model>(const Model& model) -> std::int64_t {
              if constexpr (varies_shear<Model>)
                return run([&](std::size_t i, const EosPoint& solid, double rho, double e) {
                  const double factor =
                      model.shear_factor(solid.pressure, rho / eos.reference_density(), warmth(eos, rho, e));
                  return columns.shear_modulus[i] = constant * factor;
                });
              else
                return 0;
            },
            *material.strength);
      },
      material.eos);
}

}  // namespace ejecta
