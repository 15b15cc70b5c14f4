#include "app/saved_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "material/material_reader.hpp"
#include "model/package_kind.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

Scene scene_of(const Checkpoint& checkpoint, const std::vector<std::string>& overrides) {
  return parse_scene(checkpoint.scene, checkpoint.file.string(), overrides, {package_sections(), {}});
}

}  // namespace

std::vector<SavedState> saved_states(const fs::path& run, const StateChoice& choice) {
  std::map<std::int64_t, SavedState> by_step;
  for (const char* folder : {"snapshots", "checkpoints"}) {
    std::error_code not_there;
    for (const fs::directory_entry& entry : fs::directory_iterator(run / folder, not_there)) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(".h5") || !(name.starts_with("snapshot_") || name.starts_with("checkpoint_"))) continue;
      const CheckpointClock clock = read_checkpoint_clock(entry.path());
      by_step[clock.step] = {entry.path(), clock.time, clock.step};
    }
  }
  if (by_step.empty())
    throw InputError(run.string() + ": expected a run folder with a checkpoint or a snapshot, found none");
  std::vector<SavedState> states;
  for (const auto& [step, state] : by_step) states.push_back(state);
  if (choice.all) return states;
  if (!choice.at) return {states.back()};
  return {*std::ranges::min_element(states, {}, [&](const SavedState& s) { return std::abs(s.time - *choice.at); })};
}

SavedRun::SavedRun(const SavedState& first, const std::vector<std::string>& overrides)
    : SavedRun(read_checkpoint(first.file), overrides) {}

SavedRun::SavedRun(const Checkpoint& checkpoint, const std::vector<std::string>& overrides) {
  const Scene scene = scene_of(checkpoint, overrides);
  sim_ = set_up_simulation(scene, read_materials(scene, material_library()).list);
  restore(sim_, checkpoint);
}

void SavedRun::go_to(const SavedState& state) { restore(sim_, read_checkpoint(state.file)); }

}  // namespace ejecta
