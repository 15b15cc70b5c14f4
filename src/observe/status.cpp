#include "observe/status.hpp"

#include "observe/memory.hpp"
#include "observe/profile.hpp"
#include "observe/tables.hpp"

namespace ejecta {

namespace {
constexpr std::size_t lines_of_log = 40;
}

Status::Status(const Simulation& sim, std::filesystem::path folder, const Frames& frames, FragmentContext context,
               Outputs& outputs)
    : folder_(std::move(folder)),
      frames_(frames),
      outputs_(outputs),
      monitor_(folder_),
      context_(std::move(context)),
      first_wall_(sim.wall_seconds),
      first_work_(element_steps(sim)) {
  status_.scene = heading(sim.scene);
  status_.draws = sim.scene.insitu.enabled;
  if (sim.packages.size() == 1) status_.element = sim.packages[0]->element();
  if (sim.scene.fragments.enabled) status_.smallest_fragment = context_.share(context_.smallest);
  if (!context_.bodies.empty()) status_.fragment_target = context_.bodies[context_.target];
}

void Status::gather(const Simulation& sim) {
  status_.particles = 0;
  for (const auto& package : sim.packages) status_.particles += static_cast<std::int64_t>(package->elements());
  status_.step = sim.clock.step;
  status_.time = sim.clock.time;
  status_.time_end = sim.scene.time_end;
  status_.dt = sim.clock.dt;
  gather_limit(sim);
  status_.wall_s = sim.wall_seconds + sim.insitu_seconds;
  status_.insitu_share = status_.wall_s > 0 ? sim.insitu_seconds / status_.wall_s : 0;
  status_.memory = memory_now();
  status_.memory_peak = memory_peak();
  if (const double wall = sim.wall_seconds - first_wall_; wall > 0)
    status_.particle_steps_per_s = (element_steps(sim) - first_work_) / wall;
  pace_.add(status_.wall_s, sim.clock);
  status_.eta_s = pace_.left(sim.scene.time_end, sim.scene.max_steps);
  for (const Quantity& q : quantities(sim, frames_, context_)) {
    if (!q.plotted) continue;
    const auto* number = std::get_if<double>(&q.value);
    const auto* count = std::get_if<std::int64_t>(&q.value);
    if (!number && !count) continue;  // a word
    const double value = number ? *number : static_cast<double>(*count);
    status_.record(q.name, q.unit, sim.clock.time, value);
    if (q.name == "energy error") status_.energy_error = value;
    if (q.name == "angular momentum error") status_.angular_momentum_error = value;
  }
  status_.fragment_masses.clear();
  if (frames_.fragments())
    for (const Fragment& f : frames_.fragments()->fragments)
      if (const double m = f.mass_of(context_.target); m > 0) status_.fragment_masses.push_back(context_.share(m));
  status_.views = read_views(folder_);
  status_.profile = profile_of(sim);
  status_.log = read_log_tail(folder_, lines_of_log);
  status_.files = find_files(folder_);
  status_.warnings = frames_.warnings();
  status_.warnings.insert(status_.warnings.end(), outputs_.warnings().begin(), outputs_.warnings().end());
  status_.pipelines.clear();
  for (const PipelineCount& p : frames_.pipelines()) status_.pipelines.push_back({p.name, p.frames, p.failures});
}

void Status::gather_limit(const Simulation& sim) {
  MonitorLimits& limits = status_.limits;
  status_.limited_by = std::string(sim.vote.reason);
  if (sim.clock.step == 0 || (!limits.time.empty() && limits.time.back() == sim.clock.time)) return;
  limits.time.push_back(sim.clock.time);
  limits.dt.push_back(sim.vote.dt);
  limits.cause.push_back(status_.limited_by + (sim.limited.body.empty() ? "" : " in " + std::string(sim.limited.body)));
  limits.place.push_back(sim.limited.place());
}

void Status::observe(Simulation& sim, bool) {
  if (!monitor_.due()) return;
  sim.timers.time("monitor", [&] {
    status_.state = RunState::running;
    gather(sim);
    outputs_.write("monitor", Outputs::Loss::until_next, [&] { monitor_.update(status_); });
  });
}

void Status::show(const Simulation& sim, RunState state) {
  status_.state = state;
  gather(sim);
  outputs_.write("monitor", Outputs::Loss::until_next, [&] { monitor_.update(status_, true); });
}

void Status::conclude(const Simulation& sim, RunState state, int exit_code) {
  status_.exit = exit_code;
  show(sim, state);
}

void Status::give_up(int exit_code) {
  status_.state = RunState::failed;
  status_.exit = exit_code;
  monitor_.write_over(status_);
}

}  // namespace ejecta
