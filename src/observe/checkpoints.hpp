#pragma once
/// Checkpoints that a run can go on from bit for bit, and full snapshots on request.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "observe/frames.hpp"
#include "observe/outputs.hpp"
#include "observe/schedule.hpp"
#include "output/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// All that the packages persist. Valid while the simulation is untouched.
CheckpointView checkpoint_view(const Simulation& sim, const std::string& resolved);

/// A key of the scene that has another value than in a checkpoint.
struct ChangedKey {
  std::string key, then, now;
};
/// Those that matter. What may change on any restart is left out: scene.title, time.end, time.max_steps, run.threads,
/// all of [insitu], and all of [output] but peaks. `resolved`: the scene as in resolved.toml, of the scene `file`.
std::vector<ChangedKey> changed_keys(const Checkpoint& checkpoint, const std::string& resolved,
                                     const std::string& file);

/// Throws InputError, with both values of every key that matters and differs.
void check_same_scene(const Checkpoint& checkpoint, const std::string& resolved, const std::string& file);

/// Puts a freshly set-up simulation of the same scene into the state of the checkpoint. Throws InputError if the
/// checkpoint belongs to another scene.
void restore(Simulation& sim, const Checkpoint& checkpoint);

/// Size of a full dump [bytes].
double dump_bytes(const Simulation& sim);

class Checkpoints final : public Observer {
 public:
  /// `resume_at`: where a restart goes on.
  Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene, Frames& frames, Outputs& outputs,
              const std::optional<Clock>& resume_at);
  double next_time() const override { return std::min(next_snapshot_, times_.next()); }
  void observe(Simulation& sim, bool last) override;
  /// One is written at the end of this step, and the log says so.
  void ask() { asked_ = true; }
  /// The state of a failed step, for a look at it or a restart with another scene: checkpoints/failed_<step>.h5.
  void write_failed(const Simulation& sim);

 private:
  using WallClock = std::chrono::steady_clock;
  void write(Simulation& sim);
  CheckpointView view(const Simulation& sim);

  std::filesystem::path folder_;
  std::string resolved_;
  Frames& frames_;
  Outputs& outputs_;
  WallClock::time_point written_ = WallClock::now();
  double wait_;              ///< wall time from then to the next checkpoint [s]
  double every_, next_ = 0;  ///< simulated time between checkpoints, and of the next one [s]
  bool asked_ = false;
  double snapshot_interval_, next_snapshot_;
  OutputTimes times_;

  /// Whether a snapshot is due at this time [s]; the next one then comes later.
  bool pass_snapshots(double time);
};

}  // namespace ejecta
