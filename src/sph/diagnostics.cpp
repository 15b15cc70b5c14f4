#include "sph/diagnostics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "sph/particle_state.hpp"

namespace ejecta {

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

template <int Dim>
double median_peak_pressure(const Particles<Dim>& particles, std::int32_t body) {
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
  return median->first;
}

Kept kept_between(const Boundary& boundary) { return {!boundary.any(mirrors), !boundary.bounded()}; }

template Totals totals<2>(const Particles<2>&);
template Totals totals<3>(const Particles<3>&);
template double median_peak_pressure<2>(const Particles<2>&, std::int32_t);
template double median_peak_pressure<3>(const Particles<3>&, std::int32_t);
template ExternalLoad holding_load<2>(const Particles<2>&, const Scene&);
template ExternalLoad holding_load<3>(const Particles<3>&, const Scene&);

}  // namespace ejecta
