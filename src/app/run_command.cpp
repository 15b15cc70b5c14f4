#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/control.hpp"
#include "app/job.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "app/remarks.hpp"
#include "app/run_folder.hpp"
#include "app/run_lock.hpp"
#include "app/signals.hpp"
#include "app/steering.hpp"
#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "insitu/gl_probe.hpp"
#include "material/material_reader.hpp"
#include "model/package_kind.hpp"
#include "observe/checkpoints.hpp"
#include "observe/columns.hpp"
#include "observe/frames.hpp"
#include "observe/measured.hpp"
#include "observe/outputs.hpp"
#include "observe/probes.hpp"
#include "observe/profile.hpp"
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

/// How a run has ended.
struct Ending {
  RunState state = RunState::finished;
  int code = exit_code::done;
  std::string reason;

  void fail(const std::string& why) {
    state = RunState::failed;
    code = exit_code::failed;
    reason += (reason.empty() ? "" : "; ") + why;
  }
};

void prepare_folder(const Job& job) {
  if (job.overwrite && !job.restart) clear_run_folder(job.folder);
  log_to_folder(job.folder, job.restart);
  write_atomically(job.folder / "resolved.toml", job.resolved);
}

/// What a run that goes on from a checkpoint has to say, and to clear away.
void announce_restart(const Job& job, const Simulation& sim, const Checkpoint& checkpoint,
                      const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) spdlog::warn("{}; the checkpoint before it is used", problem);
  for (const ChangedKey& c : changed_keys(checkpoint, job.resolved, job.scene.file))
    spdlog::warn("changed since the checkpoint: {}: {} -> {}", c.key, c.then, c.now);
  spdlog::info("restarted from {} at t = {}", checkpoint.file.filename().string(),
               format_quantity(sim.clock.time, "s"));
  for (const std::string& name : set_later_checkpoints_aside(job.folder / "checkpoints", sim.clock.step))
    spdlog::info("{} is of a later step: kept as {}.aside", name, name);
  if (const int removed = remove_later_files(job.folder, sim.clock, job.scene); removed > 0)
    spdlog::info("removed {} images, snapshots and line-outs that are made again, or that a stop has added", removed);
}

/// The outcome in one sentence: of fragments, of a blast, or how well energy is kept.
std::string finding(const Simulation& sim, const Summary& s, const FragmentContext& context) {
  std::string text;
  if (s.largest_fragment_mass_fraction && s.fragments)
    text = *s.fragments == 0
               ? "All is dust"
               : fmt::format("There {}; the largest holds {:.3g} % of {}",
                             *s.fragments == 1 ? "is 1 fragment" : fmt::format("are {} fragments", *s.fragments),
                             100 * *s.largest_fragment_mass_fraction, context.bodies[context.target]);
  for (const auto& package : sim.packages)
    if (const auto blast = package->blast())
      text = fmt::format("The shock is at {} with a peak of {}", format_quantity(blast->radius, "m"),
                         format_quantity(blast->peak_pressure, "Pa"));
  const std::string energy = fmt::format("energy is kept to {:.1e}", std::abs(s.energy_error_rel.value_or(0)));
  return (text.empty() ? "E" + energy.substr(1) : text + "; " + energy) + ".";
}

std::string last_words(const Simulation& sim, const Job& job, const Summary& s, const Ending& ending,
                       const FragmentContext& context) {
  std::string text = fmt::format("{} {}: {} in {} steps and {} of wall time.", job.scene.name,
                                 ending.state == RunState::failed    ? "has failed (" + ending.reason + ")"
                                 : ending.state == RunState::stopped ? "was " + ending.reason + ", --restart goes on"
                                                                     : "has reached its end",
                                 format_quantity(s.time_s, "s"), s.steps, format_quantity(s.wall_s, "s"));
  text += '\n' + finding(sim, s, context);
  return text + fmt::format("\nResults are in {0}: {0}/monitor/index.html shows them, summary.json has the numbers.\n",
                            job.folder.string());
}

/// Everything that is written once, when the run is over for whatever reason.
void conclude(const Simulation& sim, const Frames& frames, const Job& job, Outputs& outputs, Status& status,
              Ending& ending) {
  outputs.conclude();
  const FragmentContext context = fragment_context(sim);
  const auto write = [&](const char* name, auto&& write_file) {
    outputs.write(name, Outputs::Loss::until_next, [&] { write_file(job.folder / name); });
  };
  if (frames.fragments()) {
    write("fragments.csv", [&](const fs::path& file) { write_fragments(file, *frames.fragments(), context); });
    write("fragment_distribution.csv",
          [&](const fs::path& file) { write_fragment_distribution(file, *frames.fragments(), context); });
    if (const std::string& measured = sim.scene.fragments.measured; !measured.empty())
      write("fragments_measured.csv",
            [&](const fs::path& file) { write_measured_fragments(file, measured_masses(measured)); });
    const auto predictions = predict_fragments(sim.scene.fragments.theory, context.density, context.dimension);
    if (!predictions.empty())
      write("fragment_theory.csv", [&](const fs::path& file) { write_fragment_theory(file, predictions, context); });
    for (const FragmentPrediction& p : predictions)
      spdlog::info("{}: {:.0f} to {:.0f} pieces of {}, of {:.2g} to {:.2g} % of it in the mean", p.who,
                   context.body_mass[context.target] / p.heaviest, context.body_mass[context.target] / p.lightest,
                   context.bodies[context.target], 100 * context.share(p.lightest), 100 * context.share(p.heaviest));
    with_particles(sim, [&](const auto& sph) {
      for (const FragmentSensitivity& s : fragment_sensitivity(fragment_input(sph), sph.scene.fragments))
        spdlog::info("fragments at linking length {:.2f}: {}, largest {:.2f} %, dust {:.1f} % of the {}",
                     s.linking_length, s.fragments, 100 * s.largest_mass_fraction, 100 * s.dust_mass_fraction,
                     context.unit());
    });
  }
  if (const MonitorProfile profile = profile_of(sim); !profile.place.empty())
    write("profile.csv", [&](const fs::path& file) { write_profile(file, profile); });
  for (const PipelineCount& pipeline : frames.pipelines())
    if (pipeline.failures > 0)
      spdlog::warn("pipeline {} failed {} of {} frames; insitu.log says why", pipeline.name, pipeline.failures,
                   pipeline.frames);
  if (frames.left_out() > 0)
    spdlog::warn("{} frames drawn, {} left out to hold insitu.max_share", frames.drawn(), frames.left_out());
  for (const auto& package : sim.packages) say(package->remarks());
  FigureSettings figures;
  figures.title = sim.scene.title;
  if (!context.bodies.empty()) figures.fragment_target = context.bodies[context.target];
  figures.resolution_limit = context.smallest;
  for (const Probe& probe : sim.scene.probes) figures.probes.push_back({probe.name, probe.measured_delay});
  say_misfits(sim.scene, job.folder);
  for (const Figure& figure : make_figures(job.folder, figures))
    if (!figure.problem.empty()) spdlog::warn("{}: {}", figure.file.filename().string(), figure.problem);
  if (frames.images() > 0)
    outputs.write("movies", Outputs::Loss::until_next, [&] {
      write_title_card(job.folder, heading(sim.scene), {"scene " + sim.scene.name, program_name()});
      for (const std::string& problem : make_movies(job.folder).problems) spdlog::warn("movie: {}", problem);
    });
  write("timers.csv", [&](const fs::path& file) { write_timers(file, wall_times(sim)); });
  const std::vector<std::string> missing_before = outputs.missing();
  for (const std::string& missing : missing_before) ending.fail(missing);
  status.conclude(sim, ending.state, ending.code);
  Summary summary = summarise(sim, frames, context, job.folder, ending.code);
  summary.state = name_of(ending.state);
  if (!ending.reason.empty()) summary.reason = ending.reason;
  summary.not_written = missing_before;
  write("summary.json", [&](const fs::path& file) { write_summary(file, summary); });
  if (const auto missing = outputs.missing(); missing != summary.not_written) {  // one of the very last files
    if (summary.not_written.empty()) ending.fail(missing[0]);
    status.give_up(ending.code);
  }
  // Everything is in the files: a terminal that has gone is no reason to fail.
  std::fputs(last_words(sim, job, summary, ending, context).c_str(), stdout);
}

/// The checkpoint that a restart goes on from; what is wrong with later ones is added to `problems`.
Checkpoint find_checkpoint(const Job& job, std::vector<std::string>& problems) {
  Checkpoint checkpoint =
      job.from.empty() ? read_latest_checkpoint(job.folder / "checkpoints", problems) : read_checkpoint(job.from);
  if (!job.accept_changes) check_same_scene(checkpoint, job.resolved, job.scene.file);
  return checkpoint;
}

int run(const Job& job) {
  RunLock lock(job.folder);
  take_control(job.folder);  // meant for an earlier run; from now on for this one
  take_checkpoint_signals();
  std::optional<Checkpoint> checkpoint;
  std::vector<std::string> problems;
  if (job.restart) checkpoint = find_checkpoint(job, problems);
  Simulation sim = set_up_simulation(job.scene, job.materials.list);
  if (checkpoint) restore(sim, *checkpoint);
  const std::vector<std::string> odd_probes = place_probes(sim);
  prepare_folder(job);
  for (const std::string& odd : odd_probes) spdlog::warn("{}", odd);
  if (!lock.left_by().empty()) spdlog::info("{} was killed here before", lock.left_by());
  if (job.scene.insitu.enabled && !job.catalyst)
    spdlog::warn("no OpenGL here: Catalyst is left out, slices are drawn by Ejecta itself, all data are written");
  std::optional<Clock> resume_at;
  if (checkpoint) {
    resume_at = sim.clock;
    announce_restart(job, sim, *checkpoint, problems);
  }
  if (!resume_at && sim.clock.time > 0)
    spdlog::info("begins at t = {} with a blast that has been solved in one dimension so far (charge.start)",
                 format_quantity(sim.clock.time, "s"));
  Outputs outputs;
  const std::unique_ptr<Frames> frames_of_solver = make_frames(sim, job.folder, outputs, job.catalyst);
  Frames& frames = *frames_of_solver;
  if (checkpoint) frames.resume(sim, *checkpoint);
  frames.observe(sim, false);  // tries the scripts
  checkpoint.reset();          // as large as the state
  const FragmentContext context = fragment_context(sim);
  Tables tables(job.scene, job.folder, frames, context, outputs, resume_at);
  Checkpoints checkpoints(job.folder, job.resolved, job.scene, frames, outputs, resume_at);
  Shocks shocks(sim, job.folder, outputs, resume_at);
  Probes probes(sim, job.folder, outputs, resume_at);
  Status status(sim, job.folder, frames, context, outputs);
  Progress progress;
  std::vector<Observer*> observers{&frames, &tables, &shocks, &probes, &checkpoints, &status};
  const auto keep_folder = [&] {
    outputs.write("run folder", Outputs::Loss::until_next, [&] {
      if (lock.keep()) spdlog::warn("{} or its lock was removed: made again", job.folder.string());
      if (!fs::exists(job.folder / "run.log")) log_to_folder(job.folder, true);
      if (!fs::exists(job.folder / "resolved.toml")) write_atomically(job.folder / "resolved.toml", job.resolved);
    });
  };
  Steering steering(job.folder, frames, checkpoints, status, observers, keep_folder);
  observers.push_back(&progress);  // a run that is paused makes none
  install_signals();
  for (const auto& package : sim.packages)
    spdlog::info("{}: {} {}s in {}D, {} threads, {:.0f} bytes each", job.scene.name, package->elements(),
                 package->element(), job.scene.dimension, max_threads(),
                 static_cast<double>(package->bytes()) / static_cast<double>(package->elements()));
  say(remarks_on(job, sim));
  Ending ending;
  try {
    try {
      if (!ejecta::run(sim, observers, [&] { return steering.stops(sim); })) {
        ending = {RunState::stopped, exit_code::stopped, "stopped by " + steering.stopped_by()};
        spdlog::warn("{}; --restart goes on from here", ending.reason);
      }
    } catch (const InputError&) {
      throw;
    } catch (const std::exception& error) {  // of the simulation, or of a look at it
      spdlog::error("{}", error.what());
      ending.fail(error.what());
      checkpoints.write_failed(sim);
      frames.observe(sim, true);
      tables.observe(sim, true);
    }
    keep_folder();
    steering.refuse_the_rest();
    conclude(sim, frames, job, outputs, status, ending);
    steering.refuse_the_rest();
  } catch (const InputError& error) {  // another run has the folder now: nothing more may be written there
    spdlog::error("{}", error.what());
    return exit_code::failed;
  } catch (...) {
    status.give_up(exit_code::failed);
    throw;
  }
  for (const std::string& missing : outputs.missing()) spdlog::error("{}", missing);
  return ending.code;
}

}  // namespace

int run_command(const RunOptions& options) try {
  Job job = read_job(options.scene_file, options.overrides);
  job.folder = options.out.empty() ? fs::path("runs") / job.scene.name : fs::path(options.out);
  job.restart = options.restart;
  job.overwrite = options.overwrite;
  job.accept_changes = options.accept_changes;
  job.from = options.from;
  check_run_folder(options, job.folder);
  job.catalyst = job.scene.insitu.enabled && gl_works();
  try {
    return run(job);
  } catch (const ScriptError&) {  // nothing is left behind: the run has not begun
    if (!job.restart) {
      clear_run_folder(job.folder);
      take_control(job.folder);
      std::error_code kept_if_filled;
      fs::remove(job.folder, kept_if_filled);
    }
    throw;
  }
} catch (const fs::filesystem_error& error) {
  throw OutputError(error.path1(), error.code().message());
}

}  // namespace ejecta
