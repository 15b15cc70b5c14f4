#include "simulation/diagnostics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace ejecta {

Totals& Totals::operator+=(const Totals& o) {
  mass += o.mass;
  momentum += o.momentum;
  angular_momentum += o.angular_momentum;
  momentum_scale += o.momentum_scale;
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
    t.kinetic = 0.5 * mass[i] * v.squaredNorm();
    t.internal = mass[i] * energy[i];
    return t;
  });
}

ConservationErrors conservation_errors(const Totals& initial, const Totals& now) {
  auto relative = [](double difference, double scale) { return scale > 0 ? difference / scale : difference; };
  return {relative(std::abs(now.mass - initial.mass), initial.mass),
          relative((now.momentum - initial.momentum).norm(), std::max(initial.momentum_scale, now.momentum_scale)),
          relative(now.energy() - initial.energy(), std::max(std::abs(initial.energy()), initial.kinetic))};
}

template Totals totals<2>(const Particles<2>&);
template Totals totals<3>(const Particles<3>&);

}  // namespace ejecta
