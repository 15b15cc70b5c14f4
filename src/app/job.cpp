#include "app/job.hpp"

#include <algorithm>

#include "app/options.hpp"
#include "app/resources.hpp"
#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "insitu/gl_probe.hpp"
#include "insitu/pipelines.hpp"
#include "model/package_kind.hpp"
#include "observe/measured.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {

namespace {

/// Everything that pipelines can colour: what packages show, and what frames add.
std::map<std::string, std::string> colourable_fields() {
  std::map<std::string, std::string> units = package_fields();
  units.insert({{"aspect", "1"}, {"target_mass", "kg"}, {"longest_semi_axis", "m"}});
  return units;
}

}  // namespace

Job read_input(const std::string& scene_file, const std::vector<std::string>& overrides) {
  Job job;
  job.scene = read_scene(scene_file, overrides, {package_sections(), colourable_fields()});
  job.materials = read_materials(job.scene, material_library());
  job.resolved = resolved_toml(job.scene, job.materials);
  return job;
}

Job read_job(const std::string& scene_file, const std::vector<std::string>& overrides) {
  Job job = read_input(scene_file, overrides);
  set_threads(std::min(job.scene.threads.value_or(available_cores()), available_cores()));
  check_memory(job.scene, job.materials.list);
  if (const std::string& caught = job.scene.fragments.measured; !caught.empty()) measured_masses(caught);
  const InSitu& insitu = job.scene.insitu;
  if (!insitu.enabled) return job;
  check_pipeline_scripts(pipelines_of(job.scene));
  // The question takes a second.
  if (insitu.on_error == OnError::abort && !gl_works())
    throw InputError(job.scene.file + ": insitu.on_error: expected rendering to work here, got no OpenGL context");
  return job;
}

}  // namespace ejecta
