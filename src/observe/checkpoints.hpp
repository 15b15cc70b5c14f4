#pragma once
/// Checkpoints that a run can go on from bit for bit, and full snapshots on request.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "observe/schedule.hpp"
#include "output/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// All that the packages persist. Valid while the simulation is untouched.
CheckpointView checkpoint_view(const Simulation& sim, const std::string& resolved);

/// Throws InputError naming every key of the scene that differs from that of the checkpoint, with both values, unless
/// it may change on a restart: scene.title, time.end, time.max_steps, run.threads, all of [insitu], and all of [output]
/// but peaks. `resolved`: the scene as in resolved.toml; `file` begins each message.
void check_same_scene(const Checkpoint& checkpoint, const std::string& resolved, const std::string& file);

/// Puts a freshly set-up simulation of the same scene into the state of the checkpoint. Throws InputError if the
/// checkpoint belongs to another scene.
void restore(Simulation& sim, const Checkpoint& checkpoint);

/// Size of a full dump [bytes].
double dump_bytes(const Simulation& sim);

class Checkpoints final : public Observer {
 public:
  /// `resume_at`: where a restart goes on [s].
  Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene, std::optional<double> resume_at);
  double next_time() const override { return std::min(next_snapshot_, times_.next()); }
  void observe(Simulation& sim, bool last) override;
  /// The state of a failed step, for a look at it: checkpoints/failed_<step>.h5.
  void write_failed(const Simulation& sim) const;

 private:
  using clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  std::string resolved_;
  clock::time_point written_ = clock::now();
  double wait_;  ///< wall time until the next checkpoint [s]
  double snapshot_interval_, next_snapshot_;
  OutputTimes times_;

  /// Whether a snapshot is due at this time [s]; the next one then comes later.
  bool pass_snapshots(double time);
};

}  // namespace ejecta
