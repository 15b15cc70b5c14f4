#include "simulation/diagnostics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "simulation/particle_state.hpp"

namespace ejecta {

Totals& Totals::operator+=(const Totals& o) {
  mass += o.mass;
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
  return parallel_sum<Totals>(particles.size(), [&](std::size_t i) {
    Vec<3> x = Vec<3>::Zero(), v = Vec<3>::Zero();
    x.template head<Dim>() = particles.vector(Field::position, i);
    v.template head<Dim>() = particles.vector(Field::velocity, i);
    Totals t;
    t.mass = mass[i];
    t.momentum = mass[i] * v;
    t.angular_momentum = mass[i] * x.cross(v);
    t.momentum_scale = mass[i] * v.norm();
    t.angular_scale = x.norm() * t.momentum_scale;
    t.kinetic = 0.5 * mass[i] * v.squaredNorm();
    t.internal = mass[i] * energy[i];
    return t;
  });
}

ExternalLoad& ExternalLoad::operator+=(const ExternalLoad& o) {
  force += o.force;
  power += o.power;
  impulse += o.impulse;
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
    load.power = force.dot(particles.vector(Field::velocity, i));
    return load;
  });
}

void add_step(ExternalLoad& total, const ExternalLoad& before, const ExternalLoad& after, double dt) {
  total.impulse += 0.5 * dt * (before.force + after.force);
  total.work += 0.5 * dt * (before.power + after.power);
}

ConservationErrors conservation_errors(const Totals& initial, const Totals& now, const ExternalLoad& external) {
  auto relative = [](double difference, double scale) { return scale > 0 ? difference / scale : difference; };
  return {relative(std::abs(now.mass - initial.mass), initial.mass),
          relative((now.momentum - initial.momentum - external.impulse).norm(),
                   std::max(initial.momentum_scale, now.momentum_scale)),
          relative((now.angular_momentum - initial.angular_momentum).norm(),
                   std::max(initial.angular_scale, now.angular_scale)),
          relative(now.energy() - initial.energy() - external.work,
                   std::max({std::abs(initial.energy()), initial.kinetic, std::abs(external.work)}))};
}

template Totals totals<2>(const Particles<2>&);
template Totals totals<3>(const Particles<3>&);
template ExternalLoad holding_load<2>(const Particles<2>&, const Scene&);
template ExternalLoad holding_load<3>(const Particles<3>&, const Scene&);

}  // namespace ejecta
