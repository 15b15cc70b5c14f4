#include "sph/burn.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "scene/units.hpp"

namespace ejecta {

template <int Dim>
Quantities burn_quantities(const Sph<Dim>& sph) {
  const auto mass = sph.particles.column(Field::mass), burnt = sph.particles.column(Field::burnt);
  double all = 0, gone = 0, released = 0;
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const auto explosive = sph.materials[m].explosive();
    if (!explosive) continue;
    const Range range = sph.particles.material_ranges()[m];
    const auto sum = [&](auto&& value) {
      return parallel_sum<double>(range.size(), [&](std::size_t k) { return value(range.begin + k); });
    };
    const double burnt_mass = sum([&](std::size_t i) { return mass[i] * burnt[i]; });
    all += sum([&](std::size_t i) { return mass[i]; });
    gone += burnt_mass;
    released += burnt_mass * explosive->energy;
  }
  return {{"burnt mass fraction", "1", gone / all, "of the explosives", true},
          {"energy released", sph.scene.dimension == 2 ? "J/m" : "J", released,
           "by burning; it is part of the internal energy from the start"}};
}

template <int Dim>
std::vector<Remark> unlit(const Sph<Dim>& sph) {
  const auto lit = sph.particles.column(Field::lighting_time);
  const auto label = sph.particles.label(Label::body);
  std::vector<Remark> list;
  for (std::size_t b = 0; b < sph.scene.bodies.size(); ++b) {
    const Material& material = sph.materials[static_cast<std::size_t>(sph.body_material[b])];
    if (!material.explosive()) continue;
    std::size_t all = 0, never = 0;
    double last = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
      if (label[i] != static_cast<std::int32_t>(b)) continue;
      ++all;
      if (std::isfinite(lit[i]))
        last = std::max(last, lit[i]);
      else
        ++never;
    }
    if (never > 0)
      list.push_back({fmt::format("{}: no way leads from a detonator to {} of its {} particles ({}): only what "
                                  "compresses them will burn them",
                                  sph.scene.bodies[b].name, never, all, material.name),
                      true});
    else if (last > sph.scene.time_end)
      list.push_back(
          {fmt::format("{}: the run ends at {}, before all of it has been lit at {}", sph.scene.bodies[b].name,
                       format_quantity(sph.scene.time_end, "s"), format_quantity(last, "s"))});
  }
  return list;
}

template Quantities burn_quantities<2>(const Sph<2>&);
template Quantities burn_quantities<3>(const Sph<3>&);
template std::vector<Remark> unlit<2>(const Sph<2>&);
template std::vector<Remark> unlit<3>(const Sph<3>&);

}  // namespace ejecta
