#include "simulation/diagnostics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "particles/boundary_images.hpp"
#include "simulation/particle_state.hpp"

namespace ejecta {

Totals& Totals::operator+=(const Totals& o) {
  mass += o.mass;
  mass_moment += o.mass_moment;
  momentum += o.momentum;
  angular_momentum += o.angular_momentum;
  momentum_scale += o.momentum_scale;
  angular_scale += o.angular_scale;
  kinetic += o.kinetic;
  internal += o.internal;
  return *this;
}

template <int Dim>
Totals totals(const Particles<Dim>& particles) {
  const auto mass = particles.column(Field::mass), energy = particles.column(Field::specific_energy);
  Totals sum = parallel_sum<Totals>(particles.size(), [&](std::size_t i) {
    Vec<3> x = Vec<3>::Zero(), v = Vec<3>::Zero();
    x.template head<Dim>() = particles.vector(Field::position, i);
    v.template head<Dim>() = particles.vector(Field::velocity, i);
    Totals t;
    t.mass = mass[i];
    t.mass_moment = mass[i] * x;
    t.momentum = mass[i] * v;
    t.angular_momentum = mass[i] * x.cross(v);
    t.momentum_scale = mass[i] * v.norm();
    t.kinetic = 0.5 * mass[i] * v.squaredNorm();
    t.internal = mass[i] * energy[i];
    return t;
  });
  const Vec<Dim> centre = sum.mass_moment.template head<Dim>() / sum.mass;
  sum.angular_scale = parallel_sum<double>(particles.size(), [&](std::size_t i) {
    return mass[i] * (particles.vector(Field::position, i) - centre).norm() *
           particles.vector(Field::velocity, i).norm();
  });
  return sum;
}

ExternalLoad& ExternalLoad::operator+=(const ExternalLoad& o) {
  force += o.force;
  power += o.power;
  torque += o.torque;
  impulse += o.impulse;
  angular_impulse += o.angular_impulse;
  work += o.work;
  return *this;
}

template <int Dim>
ExternalLoad holding_load(const Particles<Dim>& particles, const Scene& scene) {
  return parallel_sum<ExternalLoad>(particles.size(), [&](std::size_t i) {
    ExternalLoad load;
    if (!driven(particles, scene, i)) return load;
    const Vec<Dim> force = -particles.column(Field::mass)[i] * particles.vector(Field::acceleration, i);
    load.force.template head<Dim>() = force;
    Vec<3> x = Vec<3>::Zero();
    x.template head<Dim>() = particles.vector(Field::position, i);
    load.torque = x.cross(load.force);
    load.power = force.dot(particles.vector(Field::velocity, i));
    return load;
  });
}

void add_step(ExternalLoad& total, const ExternalLoad& before, const ExternalLoad& after, double dt) {
  total.impulse += 0.5 * dt * (before.force + after.force);
  total.angular_impulse += 0.5 * dt * (before.torque + after.torque);
  total.work += 0.5 * dt * (before.power + after.power);
}

ConservationErrors conservation_errors(const Totals& initial, const Totals& now, const ExternalLoad& external) {
  auto relative = [](double difference, double scale) { return scale > 0 ? difference / scale : difference; };
  return {relative(std::abs(now.mass - initial.mass), initial.mass),
          relative((now.momentum - initial.momentum - external.impulse).norm(),
                   std::max(initial.momentum_scale, now.momentum_scale)),
          relative((now.angular_momentum - initial.angular_momentum - external.angular_impulse).norm(),
                   std::max(initial.angular_scale, now.angular_scale)),
          relative(now.energy() - initial.energy() - external.work,
                   std::max({std::abs(initial.energy()), initial.kinetic, std::abs(external.work)}))};
}

template <int Dim>
PeakPressures peak_pressures(const Particles<Dim>& particles, std::int32_t body) {
  const auto label = particles.label(Label::body);
  const auto mass = particles.column(Field::mass), peak = particles.column(Field::pressure_peak);
  std::vector<std::pair<double, double>> seen;  // peak, mass
  double left = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (label[i] != body) continue;
    seen.emplace_back(peak[i], mass[i]);
    left += 0.5 * mass[i];
  }
  std::ranges::sort(seen, std::greater<>());
  auto median = seen.begin();
  while (median + 1 != seen.end() && (left -= median->second) > 0) ++median;
  return {seen.front().first, median->first};
}

bool keeps_momentum(const Boundary& boundary) {
  return std::ranges::none_of(boundary.kind, mirrors);
}

bool keeps_angular_momentum(const Boundary& boundary) {
  return std::ranges::all_of(boundary.kind, [](BoundaryKind k) { return k == BoundaryKind::open; });
}

template Totals totals<2>(const Particles<2>&);
template Totals totals<3>(const Particles<3>&);
template PeakPressures peak_pressures<2>(const Particles<2>&, std::int32_t);
template PeakPressures peak_pressures<3>(const Particles<3>&, std::int32_t);
template ExternalLoad holding_load<2>(const Particles<2>&, const Scene&);
template ExternalLoad holding_load<3>(const Particles<3>&, const Scene&);

}  // namespace ejecta
