#include "observe/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/errors.hpp"
#include "output/archives.hpp"
#include "scene/document.hpp"

namespace ejecta {

namespace {

/// A young run is worth a checkpoint sooner: the time between them doubles from this share of the interval on, so that
/// a crash costs little more than half of the run, and never more than the interval.
constexpr double first_wait = 0.1;

/// Whether a restart may give the key another value: nothing that the particles have been through depends on it.
bool may_change(const std::string& key) {
  for (const char* free : {"scene.title", "time.end", "time.max_steps", "run.threads"})
    if (key == free) return true;
  // Peaks not followed from the start would be wrong.
  return key.starts_with("insitu.") || (key.starts_with("output.") && key != "output.peaks");
}

}  // namespace

CheckpointView checkpoint_view(const Simulation& sim, const std::string& resolved) {
  CheckpointView view;
  view.time = sim.clock.time;
  view.dt = sim.clock.dt;
  view.step = sim.clock.step;
  view.scene = resolved;
  view.scalars = {{"wall_seconds", sim.wall_seconds}, {"insitu_seconds", sim.insitu_seconds}};
  for (const auto& package : sim.packages) save(*package, view);
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
      problems.push_back(fmt::format("{}: {}: expected {} as in the checkpoint {}, got {}", file, with_names(now, key),
                                     old, checkpoint.file.filename().string(), given));
  if (!problems.empty()) throw InputError(problems);
}

void restore(Simulation& sim, const Checkpoint& checkpoint) {
  sim.clock = {checkpoint.time, checkpoint.dt, checkpoint.step};
  sim.wall_seconds = checkpoint.scalar("wall_seconds");
  if (checkpoint.scalars.contains("insitu_seconds"))  // not in checkpoints of earlier versions
    sim.insitu_seconds = checkpoint.scalar("insitu_seconds");
  for (const auto& package : sim.packages) load(*package, checkpoint);
}

double dump_bytes(const Simulation& sim) {
  const CheckpointView view = checkpoint_view(sim, "");
  std::size_t bytes = 0;
  for (const auto& column : view.columns) bytes += column.values.size_bytes();
  for (const auto& label : view.labels) bytes += label.values.size_bytes();
  return static_cast<double>(bytes);
}

void Checkpoints::write_failed(const Simulation& sim) const {
  std::filesystem::create_directories(folder_ / "checkpoints");
  write_checkpoint(folder_ / fmt::format("checkpoints/failed_{:06d}.h5", sim.clock.step),
                   checkpoint_view(sim, resolved_));
}

Checkpoints::Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene,
                         std::optional<double> resume_at)
    : folder_(std::move(folder)),
      resolved_(std::move(resolved)),
      wait_(scene.output.checkpoint_interval * first_wait),
      snapshot_interval_(scene.output.snapshots > 0 ? scene.time_end / scene.output.snapshots
                                                    : std::numeric_limits<double>::infinity()),
      next_snapshot_(snapshot_interval_),
      times_(scene.output.times) {
  if (resume_at) pass_snapshots(*resume_at);
}

bool Checkpoints::pass_snapshots(double time) {
  bool passed = false;
  for (; time >= next_snapshot_ * (1 - 1e-12); next_snapshot_ += snapshot_interval_) passed = true;
  return times_.pass(time) || passed;
}

void Checkpoints::observe(Simulation& sim, bool last) {
  const double interval = sim.scene.output.checkpoint_interval;
  const bool due = is_set(interval) && std::chrono::duration<double>(clock::now() - written_).count() > wait_;
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

}  // namespace ejecta
