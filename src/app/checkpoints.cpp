#include "app/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/errors.hpp"

namespace ejecta {

namespace {

/// A young run is worth a checkpoint sooner: the time between them doubles from this share of the interval on, so that
/// a crash costs little more than half of the run, and never more than the interval.
constexpr double first_wait = 0.1;

std::string column_name(const FieldInfo& f, int dim, int component) {
  return components(f.shape, dim) == 1 ? std::string(f.name) : fmt::format("{}_{}", f.name, component);
}
const std::pair<Label, const char*> labels[] = {
    {Label::id, "id"}, {Label::body, "body"}, {Label::material, "material"}};

/// Whether a restart may give the key another value: nothing that the particles have been through depends on it.
bool may_change(const std::string& key) {
  for (const char* free : {"scene.title", "time.end", "time.max_steps", "run.threads"})
    if (key == free) return true;
  // Peaks not followed from the start would be wrong.
  return key.starts_with("insitu.") || (key.starts_with("output.") && key != "output.peaks");
}

/// bodies[1].velocity -> bodies.projectile.velocity
std::string with_name_of_body(const std::string& key, const Document& scene) {
  if (!key.starts_with("bodies[")) return key;
  const std::size_t end = key.find(']') + 1;
  const auto name = scene.items.find(key.substr(0, end) + ".name");
  return name == scene.items.end() ? key
                                   : "bodies." + std::get<std::string>(name->second.literal.value) + key.substr(end);
}

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

void check_same_scene(const Checkpoint& checkpoint, const std::string& resolved, const std::string& file) {
  const Document then = parse_document(checkpoint.scene, checkpoint.file.string()),
                 now = parse_document(resolved, file);
  std::set<std::string> keys;
  for (const Document* document : {&then, &now})
    for (const auto& [key, item] : document->items) keys.insert(key);
  const auto value = [](const Document& document, const std::string& key) {
    const auto item = document.items.find(key);
    return item == document.items.end() ? std::string("no value") : to_text(item->second.literal);
  };
  std::vector<std::string> problems;
  for (const std::string& key : keys)
    if (const std::string old = value(then, key), given = value(now, key); old != given && !may_change(key))
      problems.push_back(fmt::format("{}: {}: expected {} as in the checkpoint {}, got {}", file,
                                     with_name_of_body(key, now), old, checkpoint.file.filename().string(), given));
  if (!problems.empty()) throw InputError(problems);
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
void Checkpoints<Dim>::write_failed(const Simulation<Dim>& sim) const {
  std::filesystem::create_directories(folder_ / "checkpoints");
  write_checkpoint(folder_ / fmt::format("checkpoints/failed_{:06d}.h5", sim.clock.step),
                   checkpoint_view(sim, resolved_));
}

template <int Dim>
double Checkpoints<Dim>::dump_bytes(const Simulation<Dim>& sim) {
  const CheckpointView view = checkpoint_view(sim, "");
  return static_cast<double>(sim.particles.size()) *
         static_cast<double>(view.columns.size() * sizeof(double) + view.labels.size() * sizeof(std::int32_t));
}

template <int Dim>
Checkpoints<Dim>::Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene, double time)
    : folder_(std::move(folder)),
      resolved_(std::move(resolved)),
      wait_(scene.output.checkpoint_interval * first_wait),
      snapshot_interval_(scene.output.snapshots > 0 ? scene.time_end / scene.output.snapshots
                                                    : std::numeric_limits<double>::infinity()),
      next_snapshot_(snapshot_interval_) {
  pass_snapshots(time);
}

template <int Dim>
bool Checkpoints<Dim>::pass_snapshots(double time) {
  bool passed = false;
  for (; time >= next_snapshot_ * (1 - 1e-12); next_snapshot_ += snapshot_interval_) passed = true;
  return passed;
}

template <int Dim>
void Checkpoints<Dim>::observe(Simulation<Dim>& sim, bool last) {
  const double interval = sim.scene.output.checkpoint_interval;
  const bool due = interval > 0 && std::chrono::duration<double>(clock::now() - written_).count() > wait_;
  if (due || last) {
    sim.timers.time("checkpoints",
                    [&] { write_rotating_checkpoint(folder_ / "checkpoints", checkpoint_view(sim, resolved_)); });
    written_ = clock::now();
    wait_ = std::min(2 * wait_, interval);
  }
  if (pass_snapshots(sim.clock.time))
    sim.timers.time("snapshots", [&] {
      std::filesystem::create_directories(folder_ / "snapshots");
      write_checkpoint(folder_ / fmt::format("snapshots/snapshot_{:06d}.h5", sim.clock.step),
                       checkpoint_view(sim, resolved_));
    });
}

template CheckpointView checkpoint_view<2>(const Simulation<2>&, const std::string&);
template CheckpointView checkpoint_view<3>(const Simulation<3>&, const std::string&);
template void restore<2>(Simulation<2>&, const Checkpoint&);
template void restore<3>(Simulation<3>&, const Checkpoint&);
template class Checkpoints<2>;
template class Checkpoints<3>;

}  // namespace ejecta
