#pragma once
/// What `run` and `check` ask of a scene before the first particle is made.
#include <filesystem>
#include <string>
#include <vector>

#include "material/material_reader.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// What a run is given once input has been checked.
struct Job {
  Scene scene;
  Materials materials;
  std::string resolved;   ///< text of resolved.toml
  bool catalyst = false;  ///< images by ParaView: wanted, and possible here
  std::filesystem::path folder;
  bool restart = false, overwrite = false, accept_changes = false;
  std::filesystem::path from;  ///< checkpoint to go on from; empty: the latest
};

/// Reads scene and materials and nothing more. Throws InputError with what is wrong in them.
Job read_input(const std::string& scene_file, const std::vector<std::string>& overrides);

/// Reads scene and materials, and takes the threads that the scene asks for, as far as there are cores. Throws
/// InputError with what is wrong in them, if they need more memory than is free, and if pipelines are no Python or
/// cannot be drawn as the scene insists.
Job read_job(const std::string& scene_file, const std::vector<std::string>& overrides);

}  // namespace ejecta
