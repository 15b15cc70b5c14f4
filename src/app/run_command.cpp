#include <fmt/format.h>

#include <filesystem>

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

/// What a run is given once input has been checked.
struct Job {
  Scene scene;
  Materials materials;
  std::string resolved;
  fs::path folder;
  bool restart = false, overwrite = false, catalyst = false;
};

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
template <int Dim>
void conclude(const Simulation& sim, const Sph<Dim>& sph, const FrameResults& frames, const Job& job, int exit_code) {
  const FragmentContext context = fragment_context(sph);
  if (frames.fragments()) {
    write_fragments(job.folder / "fragments.csv", *frames.fragments(), context);
    write_fragment_distribution(job.folder / "fragment_distribution.csv", *frames.fragments(), context);
    for (const FragmentSensitivity& s : fragment_sensitivity(fragment_input(sph), sph.scene.fragments))
      spdlog::info("fragments at linking length {:.2f}: {}, largest {:.2f} %, dust {:.1f} % of the {}",
                   s.linking_length, s.fragments, 100 * s.largest_mass_fraction, 100 * s.dust_mass_fraction,
                   context.unit());
  }
  for (const auto& package : sim.packages)
    for (const Remark& remark : package->remarks())
      spdlog::log(remark.worrying ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
  FigureSettings figures;
  figures.title = sim.scene.title;
  figures.fragment_target = context.bodies[context.target];
  figures.resolution_limit = context.smallest;
  for (const Figure& figure : make_figures(job.folder, figures))
    if (!figure.problem.empty()) spdlog::warn("{}: {}", figure.file.filename().string(), figure.problem);
  if (frames.images() > 0)
    for (const std::string& problem : make_movies(job.folder).problems) spdlog::warn("movie: {}", problem);
  const std::vector<StageTimers::Entry> times = wall_times(sim);
  write_timers(job.folder / "timers.csv", times);
  const Summary summary = summarise(sim, sph, frames, context, job.folder, exit_code);
  write_summary(job.folder / "summary.json", summary);
  fmt::print("{}\n", timer_table(times));
  fmt::print("{}\n", summary_json(summary));
  spdlog::info("results in {}", job.folder.string());
}

template <int Dim>
int run_in(const Job& job) {
  Simulation sim = set_up_simulation(job.scene, job.materials.list);
  const auto& sph = dynamic_cast<const Sph<Dim>&>(*sim.packages.front());
  prepare_folder(job);
  if (job.scene.insitu.enabled && !job.catalyst)
    spdlog::warn("no OpenGL here: Catalyst is left out, slices are drawn by Ejecta itself, all data are written");
  std::optional<double> resume_at;
  if (job.restart) {
    const Checkpoint checkpoint = read_checkpoint(*latest_checkpoint(job.folder / "checkpoints"));
    restore(sim, checkpoint);
    resume_at = sim.clock.time;
    spdlog::info("restarted from {} at t = {}", checkpoint.file.filename().string(), format_quantity(*resume_at, "s"));
  }
  Frames<Dim> frames(sph, job.folder, job.catalyst);
  if (job.restart) frames.resume();
  const FragmentContext context = fragment_context(sph);
  Tables tables(job.scene, job.folder, frames, context, resume_at);
  Checkpoints checkpoints(job.folder, job.resolved, job.scene);
  Status status(sim, job.folder, frames, context);
  Progress progress;
  install_stop_signals();
  for (const auto& package : sim.packages)
    spdlog::info("{}: {} {} in {}D, {} threads, {:.0f} bytes each", job.scene.name, package->elements(), package->name(),
                 Dim, max_threads(),
                 static_cast<double>(package->bytes()) / static_cast<double>(package->elements()));
  const std::vector<Observer*> observers{&frames, &tables, &checkpoints, &status, &progress};
  try {
    const bool finished = run(sim, observers, stop_requested);
    if (!finished) spdlog::warn("stopped by a signal; --restart goes on from here");
    status.conclude(sim, finished ? RunState::finished : RunState::stopped);
  } catch (const SimulationError& error) {
    spdlog::error("{}", error.what());
    fs::create_directories(job.folder / "checkpoints");
    write_checkpoint(job.folder / fmt::format("checkpoints/failed_{:06d}.h5", sim.clock.step),
                     checkpoint_view(sim, job.resolved));
    frames.observe(sim, true);
    tables.observe(sim, true);
    status.conclude(sim, RunState::failed);
    conclude(sim, sph, frames, job, 3);
    return 3;
  }
  conclude(sim, sph, frames, job, 0);
  return 0;
}

}  // namespace

int run_command(const RunOptions& options) {
  Job job;
  job.scene = read_scene(options.scene_file, options.overrides, package_sections());
  job.materials = read_materials(job.scene, material_library());
  job.resolved = resolved_toml(job.scene, job.materials);
  job.folder = options.out.empty() ? fs::path("runs") / job.scene.name : fs::path(options.out);
  job.restart = options.restart;
  job.overwrite = options.overwrite;
  check_run_folder(options, job.folder);
  check_memory(job.scene, job.materials.list);
  set_threads(job.scene.threads > 0 ? job.scene.threads : available_cores());
  if (job.scene.insitu.enabled) {
    check_pipeline_scripts(pipeline_scripts(job.scene.insitu.pipelines, job.scene.fragments.enabled));
    job.catalyst = gl_works();
    if (!job.catalyst) {
      if (job.scene.insitu.on_error == OnError::abort)
        throw InputError(job.scene.file + ": insitu.on_error: expected rendering to work here, got no OpenGL context");
    }
  }
  return job.scene.dimension == 2 ? run_in<2>(job) : run_in<3>(job);
}

}  // namespace ejecta
