#include <fmt/format.h>

#include <chrono>

#include "app/job.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "app/resources.hpp"
#include "base/parallel.hpp"
#include "commit.hpp"
#include "material/material_reader.hpp"
#include "render/movie.hpp"
#include "scene/units.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {

/// A set-up of more than these is worth a word before.
constexpr double many_particles = 1e6;
constexpr double steps_of_a_set_up = 5;

std::string names(const std::vector<Field>& fields) {
  std::string text;
  for (Field f : fields) text += (text.empty() ? "" : ", ") + std::string(info(f).name);
  return text.empty() ? "-" : text;
}

template <int Dim>
void print_stages(const Scene& scene, const std::vector<Material>& materials) {
  const auto stages = choose_stages<Dim>(scene, materials);
  fmt::print("stages\n");
  for (const auto& stage : stages)
    fmt::print("  {:<18} reads  {}\n  {:<18} writes {}\n", stage.name, names(stage.reads), "", names(stage.writes));
  fmt::print("columns\n");
  for (Field field : fields_of(stages)) {
    const FieldInfo& f = info(field);
    fmt::print("  {:<18} {:>2} x [{}]{:>{}} {}\n", f.name, components(f.shape, Dim), f.unit, "",
               9 - static_cast<int>(std::min<std::size_t>(9, f.unit.size())), f.doc);
  }
}

}  // namespace

std::string material_library() { return EJECTA_LIBRARY; }

int check_command(const std::string& scene_file, const std::vector<std::string>& overrides) {
  const Job job = read_job(scene_file, overrides);
  const Scene& scene = job.scene;
  const Materials& materials = job.materials;
  const Estimate e = estimate(scene, materials.list);
  if (e.particles > many_particles)
    spdlog::info("setting up {:.3g} particles as a run does: as long as a few steps, about {}", e.particles,
                 format_quantity(steps_of_a_set_up * e.seconds / e.steps, "s"));
  const auto start = std::chrono::steady_clock::now();
  const std::size_t particles = scene.dimension == 2 ? set_up<2>(scene, materials.list)->particles.size()
                                                     : set_up<3>(scene, materials.list)->particles.size();
  const std::chrono::duration<double> set_up_time = std::chrono::steady_clock::now() - start;
  if (scene.dimension == 2) {
    print_stages<2>(scene, materials.list);
  } else {
    print_stages<3>(scene, materials.list);
  }
  fmt::print("set-up\n");
  fmt::print("  particles          {}\n", particles);
  fmt::print("  time               {}\n", format_quantity(set_up_time.count(), "s"));
  fmt::print("estimate\n");
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
