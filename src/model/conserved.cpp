#include "model/conserved.hpp"

#include <algorithm>
#include <cmath>

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

ExternalLoad& ExternalLoad::operator+=(const ExternalLoad& o) {
  force += o.force;
  power += o.power;
  torque += o.torque;
  impulse += o.impulse;
  angular_impulse += o.angular_impulse;
  work += o.work;
  mass += o.mass;
  return *this;
}

void add_step(ExternalLoad& total, const ExternalLoad& before, const ExternalLoad& after, double dt) {
  total.impulse += 0.5 * dt * (before.force + after.force);
  total.angular_impulse += 0.5 * dt * (before.torque + after.torque);
  total.work += 0.5 * dt * (before.power + after.power);
}

ConservationErrors conservation_errors(const Totals& initial, const Totals& now, const ExternalLoad& external) {
  auto relative = [](double difference, double scale) { return scale > 0 ? difference / scale : difference; };
  return {relative(std::abs(now.mass - initial.mass - external.mass), initial.mass + std::max(0.0, external.mass)),
          relative((now.momentum - initial.momentum - external.impulse).norm(),
                   std::max(initial.momentum_scale, now.momentum_scale)),
          relative((now.angular_momentum - initial.angular_momentum - external.angular_impulse).norm(),
                   std::max(initial.angular_scale, now.angular_scale)),
          relative(now.energy() - initial.energy() - external.work,
                   std::max({std::abs(initial.energy()), initial.kinetic, std::abs(external.work)}))};
}

}  // namespace ejecta
