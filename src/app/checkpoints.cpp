#include "app/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/errors.hpp"

namespace ejecta {

namespace {

std::string column_name(const FieldInfo& f, int dim, int component) {
  return components(f.shape, dim) == 1 ? std::string(f.name) : fmt::format("{}_{}", f.name, component);
}
const std::pair<Label, const char*> labels[] = {
    {Label::id, "id"}, {Label::body, "body"}, {Label::material, "material"}};

}  // namespace

template <int Dim>
CheckpointView checkpoint_view(const Simulation<Dim>& sim, const std::string& resolved) {
  CheckpointView view;
  view.time = sim.clock.time;
  view.dt = sim.clock.dt;
  view.step = sim.clock.step;
  view.scene = resolved;
  const Totals& t = sim.initial;
  const ExternalLoad& e = sim.external;
  view.scalars = {{"wall_seconds", sim.wall_seconds},
                  {"initial_mass", t.mass},
                  {"initial_kinetic", t.kinetic},
                  {"initial_internal", t.internal},
                  {"initial_angular_momentum_x", t.angular_momentum[0]},
                  {"initial_angular_momentum_y", t.angular_momentum[1]},
                  {"initial_angular_momentum_z", t.angular_momentum[2]},
                  {"initial_angular_scale", t.angular_scale},
                  {"initial_scale", t.momentum_scale},
                  {"initial_momentum_x", t.momentum[0]},
                  {"initial_momentum_y", t.momentum[1]},
                  {"initial_momentum_z", t.momentum[2]},
                  {"external_power", e.power},
                  {"external_work", e.work}};
  for (int a = 0; a < 3; ++a) {
    view.scalars[fmt::format("external_force_{}", a)] = e.force[a];
    view.scalars[fmt::format("external_torque_{}", a)] = e.torque[a];
    view.scalars[fmt::format("external_impulse_{}", a)] = e.impulse[a];
    view.scalars[fmt::format("external_angular_impulse_{}", a)] = e.angular_impulse[a];
  }
  const Particles<Dim>& p = sim.particles;
  for (Field field : p.fields()) {
    const FieldInfo& f = info(field);
    for (int k = 0; k < components(f.shape, Dim); ++k) {
      view.columns.push_back({column_name(f, Dim, k), std::string(f.unit), p.column(field, k)});
      if (f.role == Role::rate)
        view.columns.push_back({"previous_" + column_name(f, Dim, k), std::string(f.unit), p.previous(field, k)});
    }
  }
  for (const auto& [label, name] : labels) view.labels.push_back({name, "1", p.label(label)});
  return view;
}

template <int Dim>
void restore(Simulation<Dim>& sim, const Checkpoint& c) {
  Particles<Dim>& p = sim.particles;
  if (c.particles != p.size())
    throw InputError(fmt::format("{}: expected a checkpoint of {} particles, got {}: it belongs to another scene",
                                 c.file.string(), p.size(), c.particles));
  for (Field field : p.fields()) {
    const FieldInfo& f = info(field);
    for (int k = 0; k < components(f.shape, Dim); ++k) {
      std::ranges::copy(c.column(column_name(f, Dim, k)), p.column(field, k).begin());
      if (f.role == Role::rate)
        std::ranges::copy(c.column("previous_" + column_name(f, Dim, k)), p.previous(field, k).begin());
    }
  }
  for (const auto& [label, name] : labels) std::ranges::copy(c.label(name), p.label(label).begin());
  sim.clock = {c.time, c.dt, c.step};
  sim.wall_seconds = c.scalar("wall_seconds");
  Totals& t = sim.initial;
  t.mass = c.scalar("initial_mass");
  t.kinetic = c.scalar("initial_kinetic");
  t.internal = c.scalar("initial_internal");
  t.momentum_scale = c.scalar("initial_scale");
  t.angular_scale = c.scalar("initial_angular_scale");
  t.angular_momentum = {c.scalar("initial_angular_momentum_x"), c.scalar("initial_angular_momentum_y"),
                        c.scalar("initial_angular_momentum_z")};
  t.momentum = {c.scalar("initial_momentum_x"), c.scalar("initial_momentum_y"), c.scalar("initial_momentum_z")};
  sim.external.power = c.scalar("external_power");
  sim.external.work = c.scalar("external_work");
  for (int a = 0; a < 3; ++a) {
    sim.external.force[a] = c.scalar(fmt::format("external_force_{}", a));
    sim.external.torque[a] = c.scalar(fmt::format("external_torque_{}", a));
    sim.external.impulse[a] = c.scalar(fmt::format("external_impulse_{}", a));
    sim.external.angular_impulse[a] = c.scalar(fmt::format("external_angular_impulse_{}", a));
  }
  sim.lists.invalidate();
}

template <int Dim>
double Checkpoints<Dim>::dump_bytes(const Simulation<Dim>& sim) {
  const CheckpointView view = checkpoint_view(sim, "");
  return static_cast<double>(sim.particles.size()) *
         static_cast<double>(view.columns.size() * sizeof(double) + view.labels.size() * sizeof(std::int32_t));
}

template <int Dim>
Checkpoints<Dim>::Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene)
    : folder_(std::move(folder)),
      resolved_(std::move(resolved)),
      snapshot_interval_(scene.output.snapshots > 0 ? scene.time_end / scene.output.snapshots
                                                    : std::numeric_limits<double>::infinity()),
      next_snapshot_(snapshot_interval_) {}

template <int Dim>
void Checkpoints<Dim>::observe(Simulation<Dim>& sim, bool last) {
  const double interval = sim.scene.output.checkpoint_interval;
  const bool due = interval > 0 && std::chrono::duration<double>(clock::now() - written_).count() > interval;
  if (due || last) {
    sim.timers.time("checkpoints",
                    [&] { write_rotating_checkpoint(folder_ / "checkpoints", checkpoint_view(sim, resolved_)); });
    written_ = clock::now();
  }
  if (sim.clock.time >= next_snapshot_ * (1 - 1e-12)) {
    sim.timers.time("snapshots", [&] {
      std::filesystem::create_directories(folder_ / "snapshots");
      write_checkpoint(folder_ / fmt::format("snapshots/snapshot_{:06d}.h5", sim.clock.step),
                       checkpoint_view(sim, resolved_));
    });
    next_snapshot_ += snapshot_interval_;
  }
}

template CheckpointView checkpoint_view<2>(const Simulation<2>&, const std::string&);
template CheckpointView checkpoint_view<3>(const Simulation<3>&, const std::string&);
template void restore<2>(Simulation<2>&, const Checkpoint&);
template void restore<3>(Simulation<3>&, const Checkpoint&);
template class Checkpoints<2>;
template class Checkpoints<3>;

}  // namespace ejecta
