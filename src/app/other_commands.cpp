#include <fmt/format.h>

#include "app/log.hpp"
#include "app/options.hpp"
#include "app/resources.hpp"
#include "base/data_folder.hpp"
#include "base/parallel.hpp"
#include "commit.hpp"
#include "material/material_reader.hpp"
#include "render/movie.hpp"
#include "scene/scene_reader.hpp"
#include "scene/units.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

std::string material_library() { return data_folder() / "inputs" / "materials"; }

int check_command(const std::string& scene_file, const std::vector<std::string>& overrides) {
  const Scene scene = read_scene(scene_file, overrides, package_sections());
  const Materials materials = read_materials(scene, material_library());
  check_memory(scene, materials.list);
  const Simulation sim = set_up_simulation(scene, materials.list);
  for (const auto& package : sim.packages) fmt::print("{}", package->outline());
  fmt::print("packages\n");
  for (const auto& package : sim.packages)
    fmt::print("  {:<18} {} elements, {} bytes\n", package->name(), package->elements(), package->bytes());
  const Estimate e = estimate(scene, materials.list);
  fmt::print("estimate\n");
  fmt::print("  particles          {:.0f}\n", e.particles);
  fmt::print("  memory             {:.0f} bytes a particle, {:.3g} GB in all\n", e.bytes_per_particle,
             e.particles * e.bytes_per_particle / 1e9);
  fmt::print("  steps              {:.0f}, while nothing moves faster than sound at rest\n", e.steps);
  fmt::print("  wall time          about {} on {} threads, without in-situ work\n", format_quantity(e.seconds, "s"),
             scene.threads > 0 ? scene.threads : available_cores());
  return 0;
}

int movie_command(const std::string& folder, int frames_per_second) {
  const MovieReport report = make_movies(folder, frames_per_second);
  for (const Movie& movie : report.movies) fmt::print("{} ({} frames)\n", movie.file.string(), movie.frames);
  for (const std::string& problem : report.problems) spdlog::error("{}", problem);
  return report.movies.empty() ? 2 : 0;
}

int info_command() {
  fmt::print("ejecta {} (commit {})\ncompiler g++ {}\nvector registers {} bits\ncores {}\nmaterials {}\n",
             EJECTA_VERSION, EJECTA_COMMIT, __VERSION__,
#if defined(__AVX512F__)
             512,
#elif defined(__AVX2__)
             256,
#else
             128,
#endif
             available_cores(), material_library());
  return 0;
}

}  // namespace ejecta
