#include <fmt/format.h>

#include <filesystem>

#include "app/log.hpp"
#include "app/options.hpp"
#include "app/saved_states.hpp"
#include "base/errors.hpp"
#include "base/json.hpp"
#include "insitu/gl_probe.hpp"
#include "insitu/pipelines.hpp"
#include "observe/frames.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// What the command line changes of the scene that was kept with the run: nothing but pictures.
std::vector<std::string> overrides_of(const ReplayOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  for (const std::string& assignment : overrides)
    if (!assignment.starts_with("insitu."))
      throw InputError(
          fmt::format("--set {}: expected a key of [insitu]: a replay changes pictures alone", assignment));
  if (!options.pipelines.empty()) {
    std::vector<std::string> scripts;
    for (const std::string& script : options.pipelines)  // beside where the user stands, or shipped
      scripts.push_back(fs::is_regular_file(script) ? fs::absolute(script).string() : script);
    overrides.push_back("insitu.pipelines=" + json_list(scripts));
  }
  overrides.push_back("insitu.enabled=true");
  return overrides;
}

/// Why nothing has been drawn.
std::string reason_of(const Frames& frames) {
  std::string text;
  for (const PipelineCount& pipeline : frames.pipelines())
    text += fmt::format("{}pipeline {} was run {} times, failed {} times and wrote nothing", text.empty() ? "" : "; ",
                        pipeline.name, pipeline.frames, pipeline.failures);
  return text;
}

}  // namespace

int replay_command(const ReplayOptions& options) {
  const fs::path run = options.folder, out = options.out.empty() ? run / "replay" : fs::path(options.out);
  const std::vector<SavedState> states = saved_states(run, options.states);
  const std::vector<std::string> overrides = overrides_of(options);
  SavedRun saved(states.front(), overrides);
  const Scene& scene = saved.simulation().scene;
  check_pipeline_scripts(pipelines_of(scene));
  fs::create_directories(out);
  Outputs outputs;
  const std::unique_ptr<Frames> frames = make_frames(saved.simulation(), out, outputs, gl_works());
  frames->ignore_triggers();
  for (const SavedState& state : states) {
    if (&state != &states.front()) saved.go_to(state);
    spdlog::info("{} at t = {}", state.file.filename().string(), format_quantity(state.time, "s"));
    frames->observe(saved.simulation(), true);
  }
  if (!outputs.missing().empty()) return exit_code::failed;
  if (frames->images() + frames->extracts() == 0) throw InputError(run.string() + ": 0 images: " + reason_of(*frames));
  spdlog::info("{} images and {} other files in {}", frames->images(), frames->extracts(), (out / "images").string());
  return exit_code::done;
}

}  // namespace ejecta
