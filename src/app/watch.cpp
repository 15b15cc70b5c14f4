#include "app/watch.hpp"

#include "app/options.hpp"
#include "app/tables.hpp"

namespace ejecta {

template <int Dim>
Watch<Dim>::Watch(const Simulation<Dim>& sim, std::filesystem::path folder, const Frames<Dim>& frames)
    : folder_(std::move(folder)),
      frames_(frames),
      monitor_(folder_),
      context_(fragment_context(sim)),
      first_time_(sim.clock.time),
      first_wall_(sim.wall_seconds) {
  status_.scene = sim.scene.title.empty() ? sim.scene.name : sim.scene.title;
  status_.time_end = sim.scene.time_end;
  status_.particles = static_cast<std::int64_t>(sim.particles.size());
  if (sim.scene.fragments.enabled) status_.smallest_fragment = context_.share(context_.smallest);
  status_.fragment_target = context_.bodies[context_.target];
}

template <int Dim>
void Watch<Dim>::gather(const Simulation<Dim>& sim) {
  const HistoryRow row = history_row(sim, frames_.fragments());
  status_.step = row.step;
  status_.time = row.time;
  status_.dt = row.dt;
  status_.limited_by = row.limited_by;
  status_.wall_s = sim.wall_seconds + insitu_seconds(sim.timers);
  if (sim.wall_seconds > 0)
    status_.particle_steps_per_s =
        static_cast<double>(sim.particles.size()) * static_cast<double>(sim.clock.step) / sim.wall_seconds;
  if (const double done = row.time - first_time_; done > 0)
    status_.eta_s = (status_.wall_s - first_wall_) * (status_.time_end - row.time) / done;
  status_.energy_error = row.energy_error;
  status_.record("kinetic energy", "J", row.time, row.kinetic_energy);
  status_.record("internal energy", "J", row.time, row.internal_energy);
  status_.angular_momentum_error = row.angular_momentum_error;
  status_.record("energy error", "1", row.time, row.energy_error);
  if (row.angular_momentum_error) status_.record("angular momentum error", "1", row.time, *row.angular_momentum_error);
  status_.record("max pressure", "Pa", row.time, row.max_pressure);
  if (row.damaged_mass_fraction) status_.record("damaged mass fraction", "1", row.time, *row.damaged_mass_fraction);
  if (row.largest_fragment_mass_fraction)
    status_.record("largest fragment mass fraction", "1", row.time, *row.largest_fragment_mass_fraction);
  status_.fragment_masses.clear();
  if (frames_.fragments())
    for (const Fragment& f : frames_.fragments()->fragments)
      if (const double m = f.mass_of(context_.target); m > 0) status_.fragment_masses.push_back(context_.share(m));
  status_.views = read_views(folder_);
  status_.warnings = frames_.warnings();
}

template <int Dim>
void Watch<Dim>::observe(Simulation<Dim>& sim, bool) {
  if (!monitor_.due()) return;
  sim.timers.time("monitor", [&] {
    gather(sim);
    monitor_.update(status_);
  });
}

template <int Dim>
void Watch<Dim>::conclude(const Simulation<Dim>& sim, RunState state, int exit_code) {
  gather(sim);
  status_.state = state;
  status_.exit = exit_code;
  monitor_.update(status_, true);
}

template <int Dim>
void Watch<Dim>::give_up() {
  status_.state = RunState::failed;
  status_.exit = exit_code::failed;
  monitor_.write_over(status_);
}

template class Watch<2>;
template class Watch<3>;

}  // namespace ejecta
