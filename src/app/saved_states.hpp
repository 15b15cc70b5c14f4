#pragma once
/// Checkpoints and snapshots of a run folder, to look at again.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "observe/checkpoints.hpp"

namespace ejecta {

struct SavedState {
  std::filesystem::path file;
  double time = 0;  ///< s
  std::int64_t step = 0;
};

/// In order of time, one a step. Throws InputError if the run folder holds none.
std::vector<SavedState> saved_states(const std::filesystem::path& run, const StateChoice& choice);

/// A simulation in the states of a run, one after the other.
class SavedRun {
 public:
  /// In the first state. `overrides`: of the scene that is kept with the state. Throws InputError.
  SavedRun(const SavedState& first, const std::vector<std::string>& overrides);
  void go_to(const SavedState& state);
  Simulation& simulation() { return sim_; }

 private:
  SavedRun(const Checkpoint& checkpoint, const std::vector<std::string>& overrides);
  Simulation sim_;
};

}  // namespace ejecta
