#include "simulation/integrator.hpp"

#include "base/parallel.hpp"

namespace ejecta {

namespace {

struct StateAndRate {
  Field state, rate;
};
/// All pairs but (position, velocity), which is advanced to second order by itself, and density, whose logarithm is.
constexpr StateAndRate pairs[] = {{Field::velocity, Field::acceleration},
                                  {Field::specific_energy, Field::heating},
                                  {Field::deviatoric_stress, Field::stress_rate}};

/// Calls body(state column, rate column, previous rate column) for every component of every pair present.
template <int Dim, class Body>
void for_pair_columns(Particles<Dim>& particles, Body&& body) {
  for (const auto& [state, rate] : pairs)
    if (particles.has(state) && particles.has(rate))
      for (int k = 0; k < components(info(state).shape, Dim); ++k)
        body(particles.column(state, k), particles.column(rate, k), particles.previous(rate, k));
}

/// e^x to the fourth order of x (Pade), and positive for every x: whatever tears at it, no density falls below zero.
double growth(double x) { return (12 + x * (6 + x)) / (12 - x * (6 - x)); }

/// Calls body(begin, end) on blocks of particles that fit in the cache, so that the columns are passed through once.
template <class Body>
void for_blocks(std::size_t n, Body&& body) {
  parallel_blocks(n, 2048, body);
}

}  // namespace

template <int Dim>
void predict(Particles<Dim>& particles, double dt, double previous_dt) {
  auto energy = particles.column(Field::specific_energy);
  for_blocks(particles.size(), [&](std::size_t begin, std::size_t end) {
    // The opening kick of length dt/2 starts from the corrected velocity, v* + previous_dt/2 (a - a_previous), so
    // vbar - v* = dt/4 a + previous_dt/2 (a - a_previous).
    for (int k = 0; k < Dim; ++k) {
      const auto a = particles.column(Field::acceleration, k), before = particles.previous(Field::acceleration, k);
      const auto v = particles.column(Field::velocity, k);
      auto x = particles.column(Field::position, k);
      for (std::size_t i = begin; i < end; ++i) {
        energy[i] -= 0.5 * dt * a[i] * (0.25 * dt * a[i] + 0.5 * previous_dt * (a[i] - before[i]));
        x[i] += dt * (v[i] + 0.5 * dt * a[i]);
      }
    }
    for_pair_columns(particles, [&](auto y, auto rate, auto) {
      for (std::size_t i = begin; i < end; ++i) y[i] += dt * rate[i];
    });
    if (!particles.has(Field::compression_rate)) return;
    const auto rate = particles.column(Field::compression_rate);
    auto density = particles.column(Field::density);
    for (std::size_t i = begin; i < end; ++i) density[i] *= growth(dt * rate[i]);
  });
  particles.swap_rates();
}

template <int Dim>
void correct(Particles<Dim>& particles, double dt) {
  auto energy = particles.column(Field::specific_energy);
  for_blocks(particles.size(), [&](std::size_t begin, std::size_t end) {
    // The closing kick of length dt/2 ends at the corrected velocity: vbar - v* = dt/4 a_new - dt/2 a_old.
    for (int k = 0; k < Dim; ++k) {
      const auto a = particles.column(Field::acceleration, k), before = particles.previous(Field::acceleration, k);
      for (std::size_t i = begin; i < end; ++i)
        energy[i] -= 0.5 * dt * a[i] * (0.25 * dt * a[i] - 0.5 * dt * before[i]);
    }
    for_pair_columns(particles, [&](auto y, auto now, auto before) {
      for (std::size_t i = begin; i < end; ++i) y[i] += 0.5 * dt * (now[i] - before[i]);
    });
    if (!particles.has(Field::compression_rate)) return;
    const auto now = particles.column(Field::compression_rate), before = particles.previous(Field::compression_rate);
    auto density = particles.column(Field::density);
    for (std::size_t i = begin; i < end; ++i) density[i] *= growth(0.5 * dt * (now[i] - before[i]));
  });
}

template void predict<2>(Particles<2>&, double, double);
template void predict<3>(Particles<3>&, double, double);
template void correct<2>(Particles<2>&, double);
template void correct<3>(Particles<3>&, double);

}  // namespace ejecta
