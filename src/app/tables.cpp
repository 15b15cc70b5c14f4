#include "app/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/log.hpp"
#include "base/parallel.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {
constexpr double damaged = 0.99;
constexpr double worrying_angular_drift = 1e-3;
constexpr std::chrono::seconds between_lines{5};

std::string hours(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02d}:{:02d}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02d}", s / 60, s % 60);
}
}  // namespace

template <int Dim>
FragmentContext fragment_context(const Simulation<Dim>& sim) {
  FragmentContext context;
  context.dimension = Dim;
  context.target = target_body(sim.scene, sim.outset.bodies);
  for (const BodyAtOutset& body : sim.outset.bodies) context.body_mass.push_back(body.mass);
  const auto label = sim.particles.label(Label::body);
  const auto first = std::ranges::find(label, static_cast<std::int32_t>(context.target)) - label.begin();
  context.smallest =
      sim.scene.fragments.min_particles * sim.particles.column(Field::mass)[static_cast<std::size_t>(first)];
  for (const Body& b : sim.scene.bodies) context.bodies.push_back(b.name);
  for (const Material& m : sim.materials) context.materials.push_back(m.name);
  return context;
}

template <int Dim>
HistoryRow history_row(const Simulation<Dim>& sim, const std::optional<FragmentTable>& fragments) {
  const Particles<Dim>& p = sim.particles;
  const Totals now = totals(p);
  HistoryRow row;
  row.time = sim.clock.time;
  row.step = sim.clock.step;
  row.dt = sim.clock.dt;
  row.limited_by = std::string(sim.vote.reason);
  row.kinetic_energy = now.kinetic;
  row.internal_energy = now.internal;
  const ConservationErrors errors = conservation_errors(sim.initial, now, sim.external);
  row.energy_error = errors.energy;
  if (keeps_angular_momentum(sim.scene.boundary)) {
    const Vec<3>& l = now.angular_momentum;
    row.angular_momentum = {l[0], l[1], l[2]};
    row.angular_momentum_error = errors.angular_momentum;
  }
  if (std::any_of(sim.scene.bodies.begin(), sim.scene.bodies.end(), [](const Body& b) { return b.driven; }))
    row.external_work = sim.external.work;
  row.momentum = {now.momentum[0], now.momentum[1], now.momentum[2]};
  row.mass = now.mass;
  constexpr double huge = std::numeric_limits<double>::max();
  auto least = [&](Field f, double sign) {
    return sign * parallel_min(p.size(), huge, [&](std::size_t i) { return sign * p.column(f)[i]; }).value;
  };
  row.max_pressure = least(Field::pressure, -1);
  row.min_density = least(Field::density, 1);
  row.max_density = least(Field::density, -1);
  if (p.has(Field::distension)) row.min_distension = least(Field::distension, 1);
  if (p.has(Field::damage))
    row.damaged_mass_fraction =
        parallel_sum<double>(
            p.size(),
            [&](std::size_t i) { return p.column(Field::damage)[i] > damaged ? p.column(Field::mass)[i] : 0.0; }) /
        now.mass;
  if (fragments) {
    row.fragments = static_cast<std::int64_t>(fragments->fragments.size());
    const FragmentContext context = fragment_context(sim);
    row.fragment_target = context.bodies[context.target];
    row.largest_fragment_mass_fraction = context.share(fragments->largest_mass(context.target));
  }
  return row;
}

template <int Dim>
Tables<Dim>::Tables(const Simulation<Dim>& sim, const std::filesystem::path& folder, Frames<Dim>& frames,
                    std::optional<double> resume_at)
    : interval_(is_set(sim.scene.output.history_interval) ? sim.scene.output.history_interval
                                                          : sim.scene.time_end / 200),
      frames_(frames),
      history_(folder / "history.csv", Dim, resume_at) {
  while (resume_at && next_ <= *resume_at) next_ += interval_;
  if (sim.scene.fragments.enabled) largest_.emplace(folder / "largest_fragment.csv", fragment_context(sim), resume_at);
}

template <int Dim>
void Tables<Dim>::observe(Simulation<Dim>& sim, bool last) {
  if (sim.clock.time < next_ && !last) return;
  while (next_ <= sim.clock.time) next_ += interval_;
  sim.timers.time("tables", [&] {
    const HistoryRow row = history_row(sim, frames_.fragments());
    history_.write(row);
    if (largest_ && frames_.fragments()) largest_->write(sim.clock.time, *frames_.fragments());
    if (warned_ || !(row.angular_momentum_error > worrying_angular_drift)) return;
    warned_ = true;
    frames_.warn(fmt::format("angular momentum has drifted by {:.2g} of the sum of |x - x_c| |m v| (from {:.0e} on)",
                             *row.angular_momentum_error, worrying_angular_drift));
  });
}

template <int Dim>
void Progress<Dim>::observe(Simulation<Dim>& sim, bool last) {
  const auto now = clock::now();
  if (start_time_ < 0) {
    start_time_ = sim.clock.time;
    start_wall_ = sim.wall_seconds;
    start_step_ = sim.clock.step;
  }
  if (now - shown_ < between_lines && !last) return;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double done = sim.clock.time - start_time_, left = sim.scene.time_end - sim.clock.time;
  const std::string eta = done > 0 && !last ? "  ETA " + hours(elapsed * left / done) : "";
  const double wall = sim.wall_seconds - start_wall_;
  const double rate = wall > 0 ? static_cast<double>(sim.particles.size()) *
                                     static_cast<double>(sim.clock.step - start_step_) / wall / 1e6
                               : 0;
  const std::size_t limiting = sim.vote.particle;
  const std::string culprit =
      limiting < sim.particles.size()
          ? " in " + sim.scene.bodies[static_cast<std::size_t>(sim.particles.label(Label::body)[limiting])].name
          : "";
  spdlog::info("step {:6d}  t {:>10} of {}  dt {:>9} by {}{}  {:.2f} M particle-steps/s  dE/E {:+.1e}{}",
               sim.clock.step, format_quantity(sim.clock.time, "s"), format_quantity(sim.scene.time_end, "s"),
               format_quantity(sim.clock.dt, "s"), sim.vote.reason, culprit, rate,
               conservation_errors(sim.initial, totals(sim.particles), sim.external).energy, eta);
  shown_ = now;
}

template HistoryRow history_row<2>(const Simulation<2>&, const std::optional<FragmentTable>&);
template HistoryRow history_row<3>(const Simulation<3>&, const std::optional<FragmentTable>&);
template FragmentContext fragment_context<2>(const Simulation<2>&);
template FragmentContext fragment_context<3>(const Simulation<3>&);
template class Tables<2>;
template class Tables<3>;
template class Progress<2>;
template class Progress<3>;

}  // namespace ejecta
