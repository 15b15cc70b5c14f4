#pragma once
/// Checkpoints that a run can go on from bit for bit, and full snapshots on request.
#include <chrono>
#include <filesystem>

#include "output/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// Every column of the simulation, with what else it must remember. Valid while the simulation is untouched.
template <int Dim>
CheckpointView checkpoint_view(const Simulation<Dim>& sim, const std::string& resolved);

/// Puts a freshly set-up simulation of the same scene into the state of the checkpoint. Throws InputError if the
/// checkpoint belongs to another scene.
template <int Dim>
void restore(Simulation<Dim>& sim, const Checkpoint& checkpoint);

template <int Dim>
class Checkpoints final : public Observer<Dim> {
 public:
  Checkpoints(std::filesystem::path folder, std::string resolved, const Scene& scene);
  double next_time() const override { return next_snapshot_; }
  void observe(Simulation<Dim>& sim, bool last) override;
  /// Bytes of a full dump of all columns [bytes].
  static double dump_bytes(const Simulation<Dim>& sim);

 private:
  using clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  std::string resolved_;
  clock::time_point written_ = clock::now();
  double snapshot_interval_, next_snapshot_;
};

}  // namespace ejecta
