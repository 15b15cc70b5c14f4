#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/job.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "app/resources.hpp"
#include "app/run_folder.hpp"
#include "app/signals.hpp"
#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "insitu/gl_probe.hpp"
#include "material/material_reader.hpp"
#include "model/package_kind.hpp"
#include "observe/checkpoints.hpp"
#include "observe/columns.hpp"
#include "observe/frames.hpp"
#include "observe/shocks.hpp"
#include "observe/solvers.hpp"
#include "observe/status.hpp"
#include "observe/summarise.hpp"
#include "observe/tables.hpp"
#include "output/atomic_file.hpp"
#include "render/figure.hpp"
#include "render/movie.hpp"
#include "scene/scene_reader.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

void prepare_folder(const Job& job) {
  if (job.overwrite && !job.restart) clear_run_folder(job.folder);
  std::error_code failure;
  fs::create_directories(job.folder, failure);
  if (failure)
    throw InputError(fmt::format("{}: expected a folder to write to, got: {}", job.folder.string(), failure.message()));
  log_to_folder(job.folder, job.restart);
  write_atomically(job.folder / "resolved.toml", job.resolved);
}

/// Everything that is written once, when the run is over for whatever reason.
void conclude(const Simulation& sim, const Frames& frames, const Job& job, int exit_code) {
  const FragmentContext context = fragment_context(sim);
  if (frames.fragments()) {
    write_fragments(job.folder / "fragments.csv", *frames.fragments(), context);
    write_fragment_distribution(job.folder / "fragment_distribution.csv", *frames.fragments(), context);
    with_particles(sim, [&](const auto& sph) {
      for (const FragmentSensitivity& s : fragment_sensitivity(fragment_input(sph), sph.scene.fragments))
        spdlog::info("fragments at linking length {:.2f}: {}, largest {:.2f} %, dust {:.1f} % of the {}",
                     s.linking_length, s.fragments, 100 * s.largest_mass_fraction, 100 * s.dust_mass_fraction,
                     context.unit());
    });
  }
  if (const int failed = frames.pipeline_failures(); failed > 0)
    spdlog::warn("in situ: {} calls of pipelines have failed; insitu.log says why", failed);
  for (const auto& package : sim.packages)
    for (const Remark& remark : package->remarks())
      spdlog::log(remark.worrying ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
  FigureSettings figures;
  figures.title = sim.scene.title;
  if (!context.bodies.empty()) figures.fragment_target = context.bodies[context.target];
  figures.resolution_limit = context.smallest;
  for (const Figure& figure : make_figures(job.folder, figures))
    if (!figure.problem.empty()) spdlog::warn("{}: {}", figure.file.filename().string(), figure.problem);
  if (frames.images() > 0)
    for (const std::string& problem : make_movies(job.folder).problems) spdlog::warn("movie: {}", problem);
  const std::vector<StageTimers::Entry> times = wall_times(sim);
  write_timers(job.folder / "timers.csv", times);
  const Summary summary = summarise(sim, frames, context, job.folder, exit_code);
  write_summary(job.folder / "summary.json", summary);
  // Everything is in the files: a terminal that has gone is no reason to fail.
  std::fputs((timer_table(times) + '\n' + summary_json(summary) + '\n').c_str(), stdout);
  spdlog::info("results in {}", job.folder.string());
}

int run(const Job& job) {
  std::optional<Checkpoint> checkpoint;
  if (job.restart) {
    checkpoint = read_checkpoint(*latest_checkpoint(job.folder / "checkpoints"));
    check_same_scene(*checkpoint, job.resolved, job.scene.file);
  }
  Simulation sim = set_up_simulation(job.scene, job.materials.list);
  if (checkpoint) restore(sim, *checkpoint);
  prepare_folder(job);
  if (job.scene.insitu.enabled && !job.catalyst)
    spdlog::warn("no OpenGL here: Catalyst is left out, slices are drawn by Ejecta itself, all data are written");
  std::optional<double> resume_at;
  if (checkpoint) {
    resume_at = sim.clock.time;
    spdlog::info("restarted from {} at t = {}", checkpoint->file.filename().string(), format_quantity(*resume_at, "s"));
    checkpoint.reset();  // as large as the state
  }
  if (!resume_at && sim.clock.time > 0)
    spdlog::info("begins at t = {} with a blast that has been solved in one dimension so far (charge.start)",
                 format_quantity(sim.clock.time, "s"));
  const std::unique_ptr<Frames> frames_of_solver = make_frames(sim, job.folder, job.catalyst);
  Frames& frames = *frames_of_solver;
  if (job.restart) frames.resume(sim);
  const FragmentContext context = fragment_context(sim);
  Tables tables(job.scene, job.folder, frames, context, resume_at);
  Checkpoints checkpoints(job.folder, job.resolved, job.scene, resume_at);
  Shocks shocks(sim, job.folder, resume_at);
  Status status(sim, job.folder, frames, context);
  Progress progress;
  install_stop_signals();
  for (const auto& package : sim.packages)
    spdlog::info("{}: {} {}s in {}D, {} threads, {:.0f} bytes each", job.scene.name, package->elements(), package->element(),
                 job.scene.dimension, max_threads(),
                 static_cast<double>(package->bytes()) / static_cast<double>(package->elements()));
  const std::vector<Observer*> observers{&frames, &tables, &shocks, &checkpoints, &status, &progress};
  int code = exit_code::done;
  try {
    RunState state = RunState::finished;
    try {
      if (!ejecta::run(sim, observers, stop_requested)) {
        spdlog::warn("stopped by a signal; --restart goes on from here");
        state = RunState::stopped;
        code = exit_code::stopped;
      }
    } catch (const SimulationError& error) {
      spdlog::error("{}", error.what());
      state = RunState::failed;
      code = exit_code::failed;
      checkpoints.write_failed(sim);
      frames.observe(sim, true);
      tables.observe(sim, true);
    }
    conclude(sim, frames, job, code);
    status.conclude(sim, state, code);
  } catch (...) {
    status.give_up(exit_code::failed);
    throw;
  }
  return code;
}

}  // namespace

int run_command(const RunOptions& options) {
  Job job = read_job(options.scene_file, options.overrides);
  job.folder = options.out.empty() ? fs::path("runs") / job.scene.name : fs::path(options.out);
  job.restart = options.restart;
  job.overwrite = options.overwrite;
  check_run_folder(options, job.folder);
  job.catalyst = job.scene.insitu.enabled && gl_works();
  return run(job);
}

}  // namespace ejecta
