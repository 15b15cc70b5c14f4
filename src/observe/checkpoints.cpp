#include "observe/checkpoints.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/errors.hpp"
#include "output/archives.hpp"
#include "scene/document.hpp"

namespace ejecta {

namespace {

constexpr double first_wait = 60;  ///< s: a young run is worth a checkpoint sooner
constexpr double retry_wait = 30;  ///< s: after one that could not be written
constexpr double never = std::numeric_limits<double>::infinity();

/// Begins the names of what observers have noted.
const std::string note = "note: ";

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
  view.scalars = {
      {"wall_seconds", sim.wall_seconds}, {"insitu_seconds", sim.insitu_seconds}, {"time_before", sim.clock.before}};
  for (const auto& [name, value] : sim.notes) view.scalars[note + name] = value;
  for (const auto& package : sim.packages) save(*package, view);
  return view;
}

std::vector<ChangedKey> changed_keys(const Checkpoint& checkpoint, const std::string& resolved,
                                     const std::string& file) {
  const Document then = parse_document(checkpoint.scene, checkpoint.file.string()),
                 now = parse_document(resolved, file);
  std::set<std::string> keys;
  for (const Document* document : {&then, &now})
    for (const auto& [key, item] : document->items) keys.insert(key);
  const auto value = [](const Document& document, const std::string& key) {
    const auto item = document.items.find(key);
    return item == document.items.end() ? std::string("no value") : to_text(item->second.literal);
  };
  std::vector<ChangedKey> changed;
  for (const std::string& key : keys)
    if (const std::string old = value(then, key), given = value(now, key); old != given && !may_change(key))
      changed.push_back({with_names(now, key), old, given});
  return changed;
}

void check_same_scene(const Checkpoint& checkpoint, const std::string& resolved, const std::string& file) {
  std::vector<std::string> problems;
  for (const ChangedKey& c : changed_keys(checkpoint, resolved, file))
    problems.push_back(fmt::format("{}: {}: expected {} as in the checkpoint {}, got {}", file, c.key, c.then,
                                   checkpoint.file.filename().string(), c.now));
  if (!problems.empty()) throw InputError(problems);
}

void restore(Simulation& sim, const Checkpoint& checkpoint) {
  const auto scalar = [&](const char* name, double in_earlier_versions) {
    return checkpoint.scalars.contains(name) ? checkpoint.scalar(name) : in_earlier_versions;
  };
  sim.clock = {checkpoint.time, checkpoint.dt, checkpoint.step, scalar("time_before", checkpoint.time - checkpoint.dt)};
  sim.wall_seconds = checkpoint.scalar("wall_seconds");
  sim.insitu_seconds = scalar("insitu_seconds", sim.insitu_seconds);
  for (const auto& [name, value] : checkpoint.scalars)
    if (name.starts_with(note)) sim.notes[name.substr(note.size())] = value;
  for (const auto& package : sim.packages) load(*package, checkpoint);
}

double dump_bytes(const Simulation& sim) {
  const CheckpointView view = checkpoint_view(sim, "");
  std::size_t bytes = 0;
  for (const auto& column : view.columns) bytes += column.values.size_bytes();
  for (const auto& label : view.labels) bytes += label.values.size_bytes();
  return static_cast<double>(bytes);
}

Checkpoints::Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene, Frames& frames,
                         Outputs& outputs, const std::optional<Clock>& resume_at)
    : folder_(std::move(folder)),
      resolved_(std::move(resolved)),
      frames_(frames),
      outputs_(outputs),
      wait_(std::min(scene.output.checkpoint_interval, first_wait)),
      every_(is_set(scene.output.checkpoint_every) ? scene.output.checkpoint_every : never),
      next_(every_),
      snapshot_interval_(scene.output.snapshots > 0 ? scene.time_end / scene.output.snapshots : never),
      next_snapshot_(snapshot_interval_),
      times_(scene.output.times) {
  if (!resume_at) return;
  pass_snapshots(resume_at->time);
  while (next_ <= resume_at->time) next_ += every_;
}

CheckpointView Checkpoints::view(const Simulation& sim) {
  CheckpointView all = checkpoint_view(sim, resolved_);
  frames_.save(all);
  return all;
}

bool Checkpoints::pass_snapshots(double time) {
  bool passed = false;
  for (; time >= next_snapshot_ * (1 - 1e-12); next_snapshot_ += snapshot_interval_) passed = true;
  return times_.pass(time) || passed;
}

void Checkpoints::observe(Simulation& sim, bool last) {
  // Before a checkpoint, so that a run killed between the two makes the snapshot when it is restarted.
  if (pass_snapshots(sim.clock.time))
    sim.timers.time("snapshots", [&] {
      outputs_.write("snapshots", Outputs::Loss::for_good, [&] {
        write_checkpoint(folder_ / fmt::format("snapshots/snapshot_{:06d}.h5", sim.clock.step), view(sim));
      });
    });
  const double waited = std::chrono::duration<double>(WallClock::now() - written_).count();
  const bool by_wall = is_set(sim.scene.output.checkpoint_interval) && waited > wait_;
  if (by_wall || sim.clock.time >= next_ || asked_ || last) write(sim);
}

void Checkpoints::write(Simulation& sim) {
  std::filesystem::path file;
  const bool written = outputs_.write("checkpoints", Outputs::Loss::until_next, [&] {
    sim.timers.time("checkpoints", [&] {
      file = write_rotating_checkpoint(folder_ / "checkpoints", view(sim), sim.scene.output.checkpoints_kept);
    });
  });
  if (asked_ && written) spdlog::info("checkpoint {} as asked", file.filename().string());
  asked_ = false;
  written_ = WallClock::now();
  const double interval = sim.scene.output.checkpoint_interval;
  wait_ = written ? interval : std::min(interval, retry_wait);
  while (next_ <= sim.clock.time) next_ += every_;
}

void Checkpoints::write_failed(const Simulation& sim) {
  outputs_.write("checkpoints", Outputs::Loss::for_good, [&] {
    write_checkpoint(folder_ / fmt::format("checkpoints/failed_{:06d}.h5", sim.clock.step), view(sim));
  });
}

}  // namespace ejecta
