#pragma once
/// Checkpoints that a run can go on from bit for bit, and full snapshots on request.
#include <chrono>
#include <filesystem>

#include "output/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// All that the packages persist. Valid while the simulation is untouched.
CheckpointView checkpoint_view(const Simulation& sim, const std::string& resolved);

/// Puts a freshly set-up simulation of the same scene into the state of the checkpoint. Throws InputError if the
/// checkpoint belongs to another scene.
void restore(Simulation& sim, const Checkpoint& checkpoint);

/// Size of a full dump [bytes].
double dump_bytes(const Simulation& sim);

class Checkpoints final : public Observer {
 public:
  Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene);
  double next_time() const override { return next_snapshot_; }
  void observe(Simulation& sim, bool last) override;

 private:
  using clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  std::string resolved_;
  clock::time_point written_ = clock::now();
  double snapshot_interval_, next_snapshot_;
};

}  // namespace ejecta
