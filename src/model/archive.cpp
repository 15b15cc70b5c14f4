#include "model/archive.hpp"

#include <array>

namespace ejecta {

namespace {
void vector(Archive& archive, const std::string& name, std::array<const char*, 3> axes, Vec<3>& value) {
  for (int a = 0; a < 3; ++a) archive.number(name + "_" + axes[static_cast<std::size_t>(a)], value[a]);
}
}  // namespace

void persist(Archive& archive, Clock& clock, Totals& initial, ExternalLoad& external) {
  if (archive.has("clock_time")) {
    archive.number("clock_time", clock.time);
    archive.number("clock_dt", clock.dt);
    archive.integer("clock_step", clock.step);
  }
  constexpr std::array<const char*, 3> letters{"x", "y", "z"}, digits{"0", "1", "2"};
  archive.number("initial_mass", initial.mass);
  archive.number("initial_kinetic", initial.kinetic);
  archive.number("initial_internal", initial.internal);
  vector(archive, "initial_momentum", letters, initial.momentum);
  archive.number("initial_scale", initial.momentum_scale);
  vector(archive, "initial_angular_momentum", letters, initial.angular_momentum);
  archive.number("initial_angular_scale", initial.angular_scale);
  vector(archive, "external_force", digits, external.force);
  vector(archive, "external_torque", digits, external.torque);
  vector(archive, "external_impulse", digits, external.impulse);
  vector(archive, "external_angular_impulse", digits, external.angular_impulse);
  archive.number("external_power", external.power);
  archive.number("external_work", external.work);
  if (archive.has("external_mass")) archive.number("external_mass", external.mass);
}

}  // namespace ejecta
