#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "simulation/particle_state.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {

/// Magnitude of the curl [1/s].
template <int Dim>
double curl(const Mat<Dim>& L) {
  if constexpr (Dim == 2) return std::abs(L(1, 0) - L(0, 1));
  if constexpr (Dim == 3) return Vec<3>(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1)).norm();
}

/// Continuity knows a solid particle's density by its neighbours alone: one that is being torn off all of them would
/// come to nothing, and the time step with it. Thinner than this, relative to the body, it expands no further.
constexpr double least_relative_density = 1e-3;

}  // namespace

template <int Dim>
void summation_density(Simulation<Dim>& sim) {
  // At the start the smoothing lengths are iterated to their fixed point; later one update a step keeps them there.
  const int iterations = sim.clock.step == 0 ? 8 : 1;
  for (int k = 0; k < iterations; ++k) {
    sim.pass->density(sim.particles, sim.lists);
    smoothing_lengths(sim);
    renew_lists(sim);  // h may have outgrown the margin of the lists, and a missed pair has a force on one side only
  }
  if (sim.clock.step == 0) sim.pass->density(sim.particles, sim.lists);
}

template <int Dim>
void pair_rates(Simulation<Dim>& sim) {
  sim.pass->rates(sim.particles, sim.lists, sim.intact);
}

template <int Dim>
void strain_rates(Simulation<Dim>& sim) {
  Particles<Dim>& p = sim.particles;
  const bool continuity = p.has(Field::density_rate), variable_shear = p.has(Field::shear_modulus);
  for (std::size_t m = 0; m < sim.materials.size(); ++m) {
    const Material& material = sim.materials[m];
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      const Mat<Dim> L = p.tensor(Field::velocity_gradient, i);
      const double compression = -L.trace();  // (1/rho) drho/dt
      const double density = p.column(Field::density)[i];
      const bool torn = material.solid() && density < least_relative_density * material.bulk_density();
      if (continuity)
        p.column(Field::density_rate)[i] = torn ? std::max(0.0, density * compression) : density * compression;
      if (!material.solid()) return;
      double shear = variable_shear ? p.column(Field::shear_modulus)[i] : material.elastic->shear_modulus;
      double distension_rate = 0;
      if (material.porosity) {
        // S = S_s/alpha, and the solid sees the share f of the strain rate, with f = 1 + (rho/alpha) d(alpha)/d(rho):
        // dS/dt = f 2G e'/alpha + (W S - S W) - S (d(alpha)/dt)/alpha   [Jutzi, Benz & Michel 2008, eqs 29-31]
        const double f = p.column(Field::stress_factor)[i];
        shear *= f / p.column(Field::distension)[i];
        distension_rate = std::min(0.0, (f - 1) * compression);  // (1/alpha) d(alpha)/dt
      }
      const Deviator<Dim> s = deviator<Dim>(p, i);
      const Deviator<Dim> rate = stress_rate<Dim>(straining_gradient(p, material, i), s, shear) - distension_rate * s;
      for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::stress_rate, k)[i] = rate[k];
    });
  }
}

template <int Dim>
void shear_switch(Simulation<Dim>& sim) {
  // Balsara (1995): |div v| / (|div v| + |curl v| + 1e-4 c/h)
  Particles<Dim>& p = sim.particles;
  parallel_for(0, p.size(), [&](std::size_t i) {
    const Mat<Dim> L = p.tensor(Field::velocity_gradient, i);
    const double divergence = std::abs(L.trace());
    const double floor = 1e-4 * p.column(Field::sound_speed)[i] / p.column(Field::smoothing_length)[i];
    p.column(Field::shear_switch)[i] = divergence / (divergence + curl<Dim>(L) + floor);
  });
}

template void summation_density<2>(Simulation<2>&);
template void summation_density<3>(Simulation<3>&);
template void pair_rates<2>(Simulation<2>&);
template void pair_rates<3>(Simulation<3>&);
template void strain_rates<2>(Simulation<2>&);
template void strain_rates<3>(Simulation<3>&);
template void shear_switch<2>(Simulation<2>&);
template void shear_switch<3>(Simulation<3>&);

}  // namespace ejecta
