#include <algorithm>

#include "base/parallel.hpp"
#include "sph/stages.hpp"

namespace ejecta {

template <int Dim>
void peaks(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const auto pressure = p.column(Field::pressure), energy = p.column(Field::specific_energy);
  const auto density = p.column(Field::density);
  const auto pressure_peak = p.column(Field::pressure_peak), energy_peak = p.column(Field::specific_energy_peak);
  const auto density_low = p.column(Field::density_low);
  if (sph.clock.step == 0) {
    std::ranges::copy(pressure, pressure_peak.begin());
    std::ranges::copy(energy, energy_peak.begin());
    std::ranges::copy(density, density_low.begin());
    for (int a = 0; a < Dim; ++a)
      std::ranges::copy(p.column(Field::position, a), p.column(Field::initial_position, a).begin());
    return;
  }
  parallel_for(0, p.size(), [&](std::size_t i) {
    pressure_peak[i] = std::max(pressure_peak[i], pressure[i]);
    energy_peak[i] = std::max(energy_peak[i], energy[i]);
    density_low[i] = std::min(density_low[i], density[i]);
  });
}

template void peaks<2>(Sph<2>&);
template void peaks<3>(Sph<3>&);

}  // namespace ejecta
