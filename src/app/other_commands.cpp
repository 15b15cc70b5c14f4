#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "app/control.hpp"
#include "app/job.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "app/remarks.hpp"
#include "app/resources.hpp"
#include "base/data_folder.hpp"
#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "commit.hpp"
#include "material/material_reader.hpp"
#include "observe/memory.hpp"
#include "observe/probes.hpp"
#include "render/movie.hpp"
#include "scene/units.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

namespace {

/// A set-up of more than these is worth a word before.
constexpr double many_elements = 1e6;
constexpr double steps_of_a_set_up = 5;
/// What ParaView adds to the memory of a run, measured with the shipped scripts.
constexpr double bytes_of_paraview = 0.36e9;

/// What a run costs if it goes on as its first steps.
struct FirstSteps {
  double steps;    ///< to the end
  double seconds;  ///< of one, the median
};

/// Takes a few steps: the first ones find memory and neighbours, and grids begin with short ones.
FirstSteps try_steps(Simulation& sim) {
  constexpr std::int64_t least = 3, most = 100;
  constexpr std::chrono::seconds enough{2};
  const auto left = [&] { return sim.scene.time_end - sim.clock.time; };
  const std::int64_t allowed = std::min(most, sim.scene.max_steps.value_or(most));
  std::vector<double> seconds;
  for (const auto start = std::chrono::steady_clock::now(); left() > 0 && sim.clock.step < allowed;) {
    const auto before = std::chrono::steady_clock::now();
    step(sim, left());
    const auto now = std::chrono::steady_clock::now();
    seconds.push_back(std::chrono::duration<double>(now - before).count());
    if (sim.clock.step >= least && now - start > enough) break;
  }
  FirstSteps first{static_cast<double>(sim.clock.step) + std::max(0.0, left()) / sim.vote.dt, 0};
  if (sim.scene.max_steps) first.steps = std::min(first.steps, static_cast<double>(*sim.scene.max_steps));
  std::ranges::sort(seconds);
  if (!seconds.empty()) first.seconds = seconds[seconds.size() / 2];
  return first;
}

}  // namespace

std::string material_library() { return data_folder() / "inputs" / "materials"; }

int check_command(const std::string& scene_file, const std::vector<std::string>& overrides) {
  const Job job = read_job(scene_file, overrides);
  const Scene& scene = job.scene;
  const Materials& materials = job.materials;
  const std::vector<Estimate> costs = estimates(scene, materials.list);
  for (const Estimate& e : costs)
    if (e.elements > many_elements)
      spdlog::info("setting up {:.3g} {}s as a run does: as long as a few steps, about {}", e.elements, e.element,
                   format_quantity(steps_of_a_set_up * e.seconds / e.steps, "s"));
  const auto start = std::chrono::steady_clock::now();
  Simulation sim = set_up_simulation(scene, materials.list);
  for (const std::string& odd : place_probes(sim)) spdlog::warn("{}", odd);
  const std::chrono::duration<double> set_up_time = std::chrono::steady_clock::now() - start;
  for (const auto& package : sim.packages) fmt::print("{}", package->outline());
  say(remarks_on(job, sim));
  fmt::print("set-up\n");
  for (const auto& package : sim.packages) fmt::print("  {:<18} {}\n", package->name(), package->elements());
  if (sim.clock.time > 0)
    fmt::print("  begins at          {}, with a blast solved in one dimension so far\n",
               format_quantity(sim.clock.time, "s"));
  fmt::print("  time               {}\n", format_quantity(set_up_time.count(), "s"));
  double bytes_now = 0;
  for (const auto& package : sim.packages) bytes_now += static_cast<double>(package->bytes());
  const FirstSteps first = try_steps(sim);
  for (const Estimate& e : costs) {
    const double grows = std::max(0.0, e.elements * e.bytes_each - bytes_now);
    const double paraview = scene.insitu.enabled ? bytes_of_paraview : 0;
    // What a blast sweeps grows many times over: its first steps say nothing of the last ones.
    const double steps = scene.charge ? e.steps : first.steps;
    const double seconds = scene.charge ? e.seconds : steps * first.seconds;
    fmt::print("estimate\n");
    fmt::print("  memory             {:.2g} GB in all: {:.0f} bytes a {}, the program{}\n",
               (memory_peak() + grows + paraview) / 1e9, e.bytes_each, e.element,
               paraview > 0 ? fmt::format(", {:.2g} GB of ParaView", paraview / 1e9) : "");
    fmt::print("  steps              {:.0f}, while nothing is faster than at the start\n", steps);
    fmt::print("  wall time          about {} on {} threads, without in-situ work\n", format_quantity(seconds, "s"),
               max_threads());
  }
  return 0;
}

int movie_command(const std::string& folder, int frames_per_second) {
  if (!std::filesystem::exists(std::filesystem::path(folder) / "images/data.csv"))
    throw InputError(fmt::format("{}: expected a run folder with images, found none", folder));
  const MovieReport report = make_movies(folder, frames_per_second);
  for (const Movie& movie : report.movies) fmt::print("{} ({} frames)\n", movie.file.string(), movie.frames);
  for (const std::string& problem : report.problems) spdlog::error("{}", problem);
  return report.movies.empty() ? 2 : 0;
}

int control_command(const std::string& folder, const std::vector<std::string>& words) {
  constexpr double patience = 10;  // s
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  const std::string answer = send_control(folder, line, patience);
  fmt::print("{}\n", answer.empty() ? "the run has not answered yet; run.log will say what becomes of it" : answer);
  return exit_code::done;
}

std::string program_name() { return "Ejecta " EJECTA_VERSION ", commit " EJECTA_COMMIT; }

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
