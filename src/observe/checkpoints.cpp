#include "observe/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "output/archives.hpp"

namespace ejecta {

CheckpointView checkpoint_view(const Simulation& sim, const std::string& resolved) {
  CheckpointView view;
  view.time = sim.clock.time;
  view.dt = sim.clock.dt;
  view.step = sim.clock.step;
  view.scene = resolved;
  view.scalars = {{"wall_seconds", sim.wall_seconds}};
  for (const auto& package : sim.packages) save(*package, view);
  return view;
}

void restore(Simulation& sim, const Checkpoint& checkpoint) {
  sim.clock = {checkpoint.time, checkpoint.dt, checkpoint.step};
  sim.wall_seconds = checkpoint.scalar("wall_seconds");
  for (const auto& package : sim.packages) load(*package, checkpoint);
}

double dump_bytes(const Simulation& sim) {
  const CheckpointView view = checkpoint_view(sim, "");
  std::size_t bytes = 0;
  for (const auto& column : view.columns) bytes += column.values.size_bytes();
  for (const auto& label : view.labels) bytes += label.values.size_bytes();
  return static_cast<double>(bytes);
}

Checkpoints::Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene)
    : folder_(std::move(folder)),
      resolved_(std::move(resolved)),
      snapshot_interval_(scene.output.snapshots > 0 ? scene.time_end / scene.output.snapshots
                                                    : std::numeric_limits<double>::infinity()),
      next_snapshot_(snapshot_interval_) {}

void Checkpoints::observe(Simulation& sim, bool last) {
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

}  // namespace ejecta
