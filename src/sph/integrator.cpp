#include "sph/integrator.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace ejecta {

namespace {

/// Calls body(state, rate, component) for every component of every pair present, but for motion, which is advanced by
/// itself, and density, whose logarithm is.
template <int Dim, class Body>
void for_pair_columns(Particles<Dim>& particles, Body&& body) {
  for (const FieldInfo& f : field_catalogue()) {
    if (f.role != Role::rate || f.rate_of == Field::velocity || f.rate_of == Field::density) continue;
    if (!particles.has(f.field) || !particles.has(f.rate_of)) continue;
    for (int k = 0; k < components(f.shape, Dim); ++k) body(f.rate_of, f.field, k);
  }
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
void predict(Particles<Dim>& particles, double dt, double previous_dt, bool damped_density) {
  auto energy = particles.column(Field::specific_energy);
  const double ahead = previous_dt > 0 ? std::min(dt / previous_dt, 2.0) : 0;
  for_blocks(particles.size(), [&](std::size_t begin, std::size_t end) {
    // The opening kick of length dt/2 starts from the corrected velocity, v* + previous_dt/2 (a - a_previous), so
    // vbar - v* = dt/4 a + previous_dt/2 (a - a_previous).
    for (int k = 0; k < Dim; ++k) {
      const auto a = particles.column(Field::acceleration, k), before = particles.previous(Field::acceleration, k);
      auto v = particles.column(Field::velocity, k), x = particles.column(Field::position, k);
      for (std::size_t i = begin; i < end; ++i) {
        energy[i] -= 0.5 * dt * a[i] * (0.25 * dt * a[i] + 0.5 * previous_dt * (a[i] - before[i]));
        x[i] += dt * (v[i] + 0.5 * dt * a[i]);
        v[i] += dt * a[i];
      }
    }
    // Calls advance(i, change) with the change of particle i in the step.
    auto extrapolate = [&](Field rate, int k, double ahead, auto&& advance) {
      const auto now = particles.column(rate, k), before = particles.previous(rate, k);
      auto then = particles.expected(rate, k);
      for (std::size_t i = begin; i < end; ++i) {
        then[i] = now[i] + ahead * (now[i] - before[i]);
        advance(i, 0.5 * dt * (now[i] + then[i]));
      }
    };
    for_pair_columns(particles, [&](Field state, Field rate, int k) {
      auto y = particles.column(state, k);
      extrapolate(rate, k, ahead, [&](std::size_t i, double change) { y[i] += change; });
    });
    if (!particles.has(Field::compression_rate)) return;
    auto density = particles.column(Field::density);
    extrapolate(Field::compression_rate, 0, damped_density ? 0 : ahead,
                [&](std::size_t i, double change) { density[i] *= growth(change); });
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
      auto v = particles.column(Field::velocity, k);
      for (std::size_t i = begin; i < end; ++i) {
        energy[i] -= 0.5 * dt * a[i] * (0.25 * dt * a[i] - 0.5 * dt * before[i]);
        v[i] += 0.5 * dt * (a[i] - before[i]);
      }
    }
    for_pair_columns(particles, [&](Field state, Field rate, int k) {
      auto y = particles.column(state, k);
      const auto now = particles.column(rate, k), expected = particles.expected(rate, k);
      for (std::size_t i = begin; i < end; ++i) y[i] += 0.5 * dt * (now[i] - expected[i]);
    });
    if (!particles.has(Field::compression_rate)) return;
    const auto now = particles.column(Field::compression_rate), expected = particles.expected(Field::compression_rate);
    auto density = particles.column(Field::density);
    for (std::size_t i = begin; i < end; ++i) density[i] *= growth(0.5 * dt * (now[i] - expected[i]));
  });
}

template void predict<2>(Particles<2>&, double, double, bool);
template void predict<3>(Particles<3>&, double, double, bool);
template void correct<2>(Particles<2>&, double);
template void correct<3>(Particles<3>&, double);

}  // namespace ejecta
