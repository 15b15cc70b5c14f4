#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "app/checkpoints.hpp"
#include "app/frames.hpp"
#include "app/job.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "app/resources.hpp"
#include "app/run_folder.hpp"
#include "app/signals.hpp"
#include "app/tables.hpp"
#include "app/watch.hpp"
#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "insitu/gl_probe.hpp"
#include "output/atomic_file.hpp"
#include "output/summary.hpp"
#include "render/figure.hpp"
#include "render/movie.hpp"
#include "scene/names.hpp"
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

template <int Dim>
std::vector<BodySummary> summarise_bodies(const Simulation<Dim>& sim, const Frames<Dim>& frames) {
  const FragmentContext context = fragment_context(sim);
  std::vector<BodySummary> bodies(context.bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].name = context.bodies[b];
    bodies[b].mass = context.body_mass[b];
  }
  if (frames.fragments()) {
    const std::vector<BodyFragments> outcome = fragments_by_body(*frames.fragments(), context);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      bodies[b].fragments = outcome[b].fragments;
      bodies[b].largest_fragment_mass_fraction = outcome[b].largest_mass_fraction;
      bodies[b].dust_mass_fraction = outcome[b].dust_mass_fraction;
    }
  }
  if (sim.scene.output.peaks)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const PeakPressures peaks = peak_pressures(sim.particles, static_cast<std::int32_t>(b));
      bodies[b].pressure_peak_max = peaks.max;
      bodies[b].pressure_peak_median = peaks.median;
    }
  return bodies;
}

template <int Dim>
Summary summarise(const Simulation<Dim>& sim, const Frames<Dim>& frames, const fs::path& folder, int exit_code) {
  Summary s;
  const ConservationErrors errors = conservation_errors(sim.initial, totals(sim.particles), sim.external);
  const double n = static_cast<double>(sim.particles.size()), steps = static_cast<double>(sim.clock.step);
  s.scene = sim.scene.name;
  s.dimension = Dim;
  s.scheme = name_of(sim.scene.numerics.scheme);
  s.precision = name_of(sim.scene.numerics.precision);
  s.threads = max_threads();
  s.particles = static_cast<std::int64_t>(sim.particles.size());
  s.steps = sim.clock.step;
  s.time_s = sim.clock.time;
  const double insitu = insitu_seconds(sim.timers);
  s.wall_s = sim.wall_seconds + insitu;
  if (sim.wall_seconds > 0) s.particle_steps_per_s = n * steps / sim.wall_seconds;
  s.neighbours_mean = mean_neighbours(sim);
  if (s.particle_steps_per_s) s.pair_interactions_per_s = *s.particle_steps_per_s * *s.neighbours_mean;
  s.bytes_per_particle = static_cast<double>(memory_bytes(sim)) / n;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  s.peak_rss_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  s.mass_error_rel = errors.mass;
  if (keeps_momentum(sim.scene.boundary)) s.momentum_error_rel = errors.momentum;
  if (keeps_angular_momentum(sim.scene.boundary)) s.angular_momentum_error_rel = errors.angular_momentum;
  s.energy_error_rel = errors.energy;
  if (sim.scene.numerics.scheme == SchemeKind::asph) {
    s.shape_votes = sim.shape_report.votes;
    s.shape_few_neighbours = sim.shape_report.few_neighbours;
    s.shape_limited_change = sim.shape_report.limited_change;
    s.shape_largest_aspect = sim.shape_report.largest_aspect;
  }
  s.images = frames.images();
  s.insitu_share = s.wall_s > 0 ? insitu / s.wall_s : 0;
  s.insitu_bytes_written = folder_bytes(folder / "images");
  s.full_dump_bytes_avoided = static_cast<std::int64_t>(Checkpoints<Dim>::dump_bytes(sim) * frames.drawn());
  s.bodies = summarise_bodies(sim, frames);
  if (frames.fragments()) {
    const std::size_t target = target_body(sim.scene, sim.outset.bodies);
    s.fragment_target = s.bodies[target].name;
    s.fragments = static_cast<std::int64_t>(frames.fragments()->fragments.size());
    s.largest_fragment_mass_fraction = s.bodies[target].largest_fragment_mass_fraction;
  }
  s.exit = exit_code;
  return s;
}

/// Everything that is written once, when the run is over for whatever reason.
template <int Dim>
void conclude(Simulation<Dim>& sim, const Frames<Dim>& frames, const Job& job, int exit_code) {
  if (frames.fragments()) {
    const FragmentContext context = fragment_context(sim);
    write_fragments(job.folder / "fragments.csv", *frames.fragments(), context);
    write_fragment_distribution(job.folder / "fragment_distribution.csv", *frames.fragments(), context);
    for (const FragmentSensitivity& s : fragment_sensitivity(fragment_input(sim), sim.scene.fragments))
      spdlog::info("fragments at linking length {:.2f}: {}, largest {:.2f} %, dust {:.1f} % of the {}",
                   s.linking_length, s.fragments, 100 * s.largest_mass_fraction, 100 * s.dust_mass_fraction,
                   context.unit());
  }
  if (sim.unconverged > 0)
    spdlog::warn("the distension solver {} failed to converge in {} particle-steps",
                 name_of(sim.scene.numerics.distension_solver), sim.unconverged);
  if (const ShapeReport& r = sim.shape_report; r.votes > 0) {
    const double percent = 100 / static_cast<double>(r.votes);
    spdlog::info(
        "shape of H: {} votes; {:.3g} % had too few neighbours, {:.3g} % changed as much as allowed, {:.3g} % reached "
        "the largest aspect",
        r.votes, percent * static_cast<double>(r.few_neighbours), percent * static_cast<double>(r.limited_change),
        percent * static_cast<double>(r.largest_aspect));
  }
  FigureSettings figures;
  figures.title = sim.scene.title;
  const FragmentContext about = fragment_context(sim);
  figures.fragment_target = about.bodies[about.target];
  figures.resolution_limit = about.smallest;
  for (const Figure& figure : make_figures(job.folder, figures))
    if (!figure.problem.empty()) spdlog::warn("{}: {}", figure.file.filename().string(), figure.problem);
  if (frames.images() > 0)
    for (const std::string& problem : make_movies(job.folder).problems) spdlog::warn("movie: {}", problem);
  std::vector<TimerRow> rows;
  for (const StageTimers::Entry& e : sim.timers.entries()) rows.push_back({e.name, e.seconds, e.calls});
  write_timers(job.folder / "timers.csv", rows);
  const Summary summary = summarise(sim, frames, job.folder, exit_code);
  write_summary(job.folder / "summary.json", summary);
  // Everything is in the files: a terminal that has gone is no reason to fail.
  std::fputs((timer_table(sim.timers) + '\n' + summary_json(summary) + '\n').c_str(), stdout);
  spdlog::info("results in {}", job.folder.string());
}

template <int Dim>
int run_in(const Job& job) {
  std::optional<Checkpoint> checkpoint;
  if (job.restart) {
    checkpoint = read_checkpoint(*latest_checkpoint(job.folder / "checkpoints"));
    check_same_scene(*checkpoint, job.resolved, job.scene.file);
  }
  auto sim = set_up<Dim>(job.scene, job.materials.list);
  if (checkpoint) restore(*sim, *checkpoint);
  prepare_folder(job);
  if (job.scene.insitu.enabled && !job.catalyst)
    spdlog::warn("no OpenGL here: Catalyst is left out, slices are drawn by Ejecta itself, all data are written");
  std::optional<double> resume_at;
  if (checkpoint) {
    resume_at = sim->clock.time;
    spdlog::info("restarted from {} at t = {}", checkpoint->file.filename().string(), format_quantity(*resume_at, "s"));
    checkpoint.reset();  // as large as the particles
  }
  Frames<Dim> frames(*sim, job.folder, job.catalyst);
  if (job.restart) frames.resume(*sim);
  Tables<Dim> tables(*sim, job.folder, frames, resume_at);
  Checkpoints<Dim> checkpoints(job.folder, job.resolved, job.scene, sim->clock.time);
  Watch<Dim> watch(*sim, job.folder, frames);
  Progress<Dim> progress;
  install_stop_signals();
  spdlog::info("{}: {} particles in {}D, {} threads, {:.0f} bytes a particle", job.scene.name, sim->particles.size(),
               Dim, max_threads(),
               static_cast<double>(memory_bytes(*sim)) / static_cast<double>(sim->particles.size()));
  const std::vector<Observer<Dim>*> observers{&frames, &tables, &checkpoints, &watch, &progress};
  int code = exit_code::done;
  try {
    RunState state = RunState::finished;
    try {
      if (!run(*sim, observers, stop_requested)) {
        spdlog::warn("stopped by a signal; --restart goes on from here");
        state = RunState::stopped;
        code = exit_code::stopped;
      }
    } catch (const SimulationError& error) {
      spdlog::error("{}", error.what());
      state = RunState::failed;
      code = exit_code::failed;
      checkpoints.write_failed(*sim);
      frames.observe(*sim, true);
      tables.observe(*sim, true);
    }
    conclude(*sim, frames, job, code);
    watch.conclude(*sim, state, code);
  } catch (...) {
    watch.give_up();
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
  return job.scene.dimension == 2 ? run_in<2>(job) : run_in<3>(job);
}

}  // namespace ejecta
