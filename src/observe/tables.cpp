#include "observe/tables.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "observe/probes.hpp"
#include "observe/solvers.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {
constexpr double worrying_angular_drift = 1e-3;
constexpr std::chrono::seconds between_lines{5};

std::string hours(double seconds) {
  const auto s = std::lround(seconds);
  return s >= 3600 ? fmt::format("{}:{:02d}:{:02d}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02d}", s / 60, s % 60);
}
}  // namespace

FragmentContext fragment_context(const Simulation& sim) {
  FragmentContext context;
  with_particles(sim, [&]<int Dim>(const Sph<Dim>& sph) {
    context.dimension = Dim;
    context.target = target_body(sph.scene, sph.outset.bodies);
    for (const BodyAtOutset& body : sph.outset.bodies) context.body_mass.push_back(body.mass);
    const auto label = sph.particles.label(Label::body);
    const auto first = std::ranges::find(label, static_cast<std::int32_t>(context.target)) - label.begin();
    context.smallest =
        sph.scene.fragments.min_particles * sph.particles.column(Field::mass)[static_cast<std::size_t>(first)];
    const auto material = sph.particles.label(Label::material)[static_cast<std::size_t>(first)];
    context.density = sph.materials[static_cast<std::size_t>(material)].bulk_density();
    for (const Body& b : sph.scene.bodies) context.bodies.push_back(b.name);
    for (const Material& m : sph.materials) context.materials.push_back(m.name);
  });
  return context;
}

Quantities quantities(const Simulation& sim, const Frames& frames, const FragmentContext& context) {
  Quantities list = quantities(sim);
  std::ranges::move(quantities_of_probes(sim), std::back_inserter(list));
  if (const auto& fragments = frames.fragments()) {
    const std::string target = context.bodies[context.target];
    list.push_back({"largest fragment mass fraction", "mass of " + target,
                    context.share(fragments->largest_mass(context.target)), "of the target over its own mass", true});
    list.push_back({"fragments", "1", static_cast<std::int64_t>(fragments->fragments.size()), "of all bodies"});
  }
  return list;
}

Tables::Tables(const Scene& scene, const std::filesystem::path& folder, Frames& frames, FragmentContext context,
               Outputs& outputs, const std::optional<Clock>& resume_at)
    : due_(scene.row_interval(), scene.output.times, resume_at),
      frames_(frames),
      outputs_(outputs),
      context_(std::move(context)),
      history_(folder / "history.csv", due_.kept_until()) {
  if (scene.fragments.enabled) largest_.emplace(folder / "largest_fragment.csv", context_, due_.kept_until());
}

void Tables::observe(Simulation& sim, bool last) {
  if (!due_.take(sim.clock, last)) return;
  sim.timers.time("tables", [&] {
    outputs_.write("history.csv", Outputs::Loss::until_next,
                   [&] { history_.write(quantities(sim, frames_, context_)); });
    if (largest_ && frames_.fragments())
      outputs_.write("largest_fragment.csv", Outputs::Loss::until_next,
                     [&] { largest_->write(sim.clock.time, *frames_.fragments()); });
    if (warned_ || !kept(sim).angular_momentum) return;
    const double drift = conservation_errors(initial(sim), conserved(sim), external(sim)).angular_momentum;
    if (!(drift > worrying_angular_drift)) return;
    warned_ = true;
    frames_.warn(fmt::format("angular momentum has drifted by {:.2g} of the sum of |x - x_c| |m v| (from {:.0e} on)",
                             drift, worrying_angular_drift));
  });
}

void Progress::observe(Simulation& sim, bool last) {
  const auto now = clock::now();
  if (!started_) {
    started_ = true;
    start_wall_ = sim.wall_seconds;
    start_work_ = element_steps(sim);
  }
  if (now - shown_ < between_lines && !last) return;
  pace_.add(std::chrono::duration<double>(now - start_).count(), sim.clock);
  const auto left = pace_.left(sim.scene.time_end, sim.scene.max_steps);
  const std::string eta = left && !last ? "  ETA " + hours(*left) : "";
  const double wall = sim.wall_seconds - start_wall_;
  const double rate = wall > 0 ? (element_steps(sim) - start_work_) / wall / 1e6 : 0;
  const std::string_view element = sim.packages.size() == 1 ? sim.packages[0]->element() : "element";
  const std::string where(sim.limited.body);
  spdlog::info("step {:6d}  t {:>10} of {}  dt {:>9} by {}{}  {:.2f} M {}-steps/s  dE/E {:+.1e}{}", sim.clock.step,
               format_quantity(sim.clock.time, "s"), format_quantity(sim.scene.time_end, "s"),
               format_quantity(sim.clock.dt, "s"), sim.vote.reason, where.empty() ? "" : " in " + where, rate, element,
               conservation_errors(initial(sim), conserved(sim), external(sim)).energy, eta);
  shown_ = now;
}

}  // namespace ejecta
