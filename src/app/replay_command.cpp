#include <filesystem>

#include "observe/frames.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "base/errors.hpp"
#include "insitu/gl_probe.hpp"
#include "material/material_reader.hpp"
#include "model/package_kind.hpp"
#include "observe/checkpoints.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {

namespace {

int replay(const Scene& scene, const Materials& materials, const Checkpoint& checkpoint,
              const std::filesystem::path& out) {
  Simulation sim = set_up_simulation(scene, materials.list);
  restore(sim, checkpoint);
  std::filesystem::create_directories(out);
  Outputs outputs;
  const std::unique_ptr<Frames> frames = make_frames(sim, out, outputs, gl_works());
  frames->observe(sim, true);
  if (!outputs.missing().empty()) return exit_code::failed;
  spdlog::info("{} images in {}", frames->images(), (out / "images").string());
  return 0;
}

}  // namespace

int replay_command(const std::string& folder, const std::string& out) {
  const std::filesystem::path run = folder;
  const auto file = latest_checkpoint(run / "checkpoints");
  if (!file) throw InputError(folder + ": expected a run folder with a checkpoint, found none");
  const Checkpoint checkpoint = read_checkpoint(*file);
  const Scene scene = parse_scene(checkpoint.scene, file->string(), {}, {package_sections(), {}});
  const Materials materials = read_materials(scene, material_library());
  const std::filesystem::path to = out.empty() ? run / "replay" : std::filesystem::path(out);
  return replay(scene, materials, checkpoint, to);
}

}  // namespace ejecta
