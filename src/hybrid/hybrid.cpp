#include "hybrid/hybrid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "hybrid/flux_correction.hpp"
#include "hybrid/restriction.hpp"
#include "material/matter_at.hpp"
#include "scene/names.hpp"
#include "scene/units.hpp"
#include "schemes/kernels.hpp"
#include "sph/assemble.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// A cell that particles cover less than this says nothing.
constexpr double least_covered = 0.5;

Scene scene_of_grid(Scene scene) {
  scene.spacing *= hybrid_settings(scene).ratio;
  return scene;
}

Scene scene_of_particles(Scene scene) {
  scene.numerics.scheme = SchemeKind::gsph;
  scene.numerics.fill_space = Switch::off;  // sums are cut off at the rim of the zone, where nothing would be filled
  return scene;
}

/// Of a particle, in spacings.
double kernel_reach(const Scene& scene) { return kernel_support(scene.numerics.kernel) * scene.numerics.nodes_per_h; }

}  // namespace

template <int Dim>
Hybrid<Dim>::Hybrid(const Scene& scene, const std::vector<Material>& materials)
    : scene_(with_gas_for_solids(scene, materials)),
      settings_(hybrid_settings(scene)),
      grid_(scene_of_grid(scene_), materials),
      zone_(settings_, kernel_reach(scene) / settings_.ratio) {
  if ((settings_.ratio & (settings_.ratio - 1)) != 0)
    throw InputError(fmt::format("{}: hybrid.ratio: expected a power of two, got {}", scene.file, settings_.ratio));
  if ((settings_.ahead + settings_.behind) * settings_.ratio < kernel_reach(scene))
    throw InputError(
        fmt::format("{}: hybrid.ahead and hybrid.behind: expected together at least {:.0f} cells, as far as a particle "
                    "sees, got {}",
                    scene.file, std::ceil(kernel_reach(scene) / settings_.ratio), settings_.ahead + settings_.behind));
  clock = grid_.clock;
  if (scene.numerics.density != DensityMethod::summation)
    throw InputError(fmt::format("{}: numerics.density: expected summation with numerics.scheme = \"hybrid\", got {}",
                                 scene.file, name_of(scene.numerics.density)));
  if (std::ranges::any_of(scene.bodies, [&](const Body& body) { return is_solid(body, materials); }))
    solids_.emplace(scene, materials);
  zone_.update(grid_, cells_of_solids());
  for (const std::size_t cell : cells_of_solids()) check_room(cell);
  lay_particles(materials);
  initial = conserved();
}

/// Whether the particles of gas around a solid can have gas around them.
template <int Dim>
void Hybrid<Dim>::check_room(std::size_t solid) const {
  const Box<Dim>& box = grid_.box();
  bool room = true;
  for_cells_near<Dim>(box, box.cell(solid), settings_.around, [&](std::size_t cell, int squares) {
    room = room && (squares > settings_.around * settings_.around || zone_[cell] == Part::active);
  });
  if (room) return;
  throw InputError(fmt::format(
      "{}: boundary: expected open faces at least {} cells of {} away from solid bodies, got one nearer to ({:.4g}) m",
      scene_.file, zone_.depth() + settings_.around, format_quantity(box.spacing, "m"),
      fmt::join(box.centre(box.cell(solid)), ", ")));
}

template <int Dim>
std::vector<Package*> Hybrid<Dim>::parts() {
  if (solids_) return {&grid_, &solids_->particles(), particles_.get()};
  return {&grid_, particles_.get()};
}

template <int Dim>
Totals Hybrid<Dim>::conserved() const {
  Totals totals = grid_.conserved();
  if (solids_) totals += solids_->particles().conserved();
  return totals;
}

/// Walls that bodies press against book nothing.
template <int Dim>
Kept Hybrid<Dim>::kept() const {
  Kept kept = grid_.kept();
  if (solids_) kept.momentum = kept.momentum && solids_->particles().kept().momentum;
  return kept;
}

template <int Dim>
std::size_t Hybrid<Dim>::elements() const {
  return grid_.elements() + particles_->elements() + (solids_ ? solids_->particles().elements() : 0);
}

template <int Dim>
std::size_t Hybrid<Dim>::bytes() const {
  return grid_.bytes() + particles_->bytes() + (solids_ ? solids_->particles().bytes() : 0);
}

template <int Dim>
std::vector<std::size_t> Hybrid<Dim>::cells_of_solids() const {
  std::vector<std::size_t> cells;
  if (!solids_) return cells;
  const Particles<Dim>& p = solids_->particles().particles;
  for (std::size_t i = 0; i < p.size(); ++i) cells.push_back(cell_of(grid_.box(), p.vector(Field::position, i)));
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// Those of gsph, with what the grid says of led particles in between.
template <int Dim>
std::vector<Stage<Dim>> Hybrid<Dim>::stages(const std::vector<Material>& materials) const {
  using enum Field;
  std::vector<Stage<Dim>> list;
  const auto add = [&](const char* name, std::vector<Field> reads, std::vector<Field> writes, auto work) {
    list.push_back(
        {{.run = [this, work](Sph<Dim>& sph) { (this->*work)(sph); }}, name, std::move(reads), std::move(writes)});
  };
  for (Stage<Dim>& stage : choose_stages<Dim>(scene_of_particles(scene_), materials)) {
    const std::string name = stage.name;
    list.push_back(std::move(stage));
    if (name == "neighbours") add("led motion", {position}, {velocity, specific_energy}, &Hybrid::lead_motion);
    if (name == "equation of state") {
      std::vector<Field> reads{position, mass, density};
      if (solids_) reads.push_back(wall);
      add("led state", reads, {mass, density, pressure, sound_speed, smoothing_length}, &Hybrid::lead_state);
    }
    if (name == "pair rates") add("led rest", {position}, {acceleration, specific_energy_rate}, &Hybrid::lead_rest);
  }
  return list;
}

template <int Dim>
std::vector<std::size_t> Hybrid<Dim>::cells_of(bool only_active) const {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < zone_.parts().size(); ++i)
    if (only_active ? zone_[i] == Part::active : zone_.covered(i)) cells.push_back(i);
  return cells;
}

/// The first particles: what the scene says of the part of a cell that each stands for.
template <int Dim>
void Hybrid<Dim>::lay_particles(const std::vector<Material>& materials) {
  const auto start = charge_start(grid_.scene(), materials);
  const MatterAt<Dim> matter(scene_, materials, scene_.spacing, start ? &*start : nullptr);
  const double volume = grid_.box().cell_volume() / std::pow(settings_.ratio, Dim);
  const int body = static_cast<int>(scene_.bodies.size()) - 1;
  std::vector<Placement<Dim>> placements;
  if (solids_) placements = solids_->images(grid_.ambient().density);
  const std::size_t images = placements.size();
  std::vector<std::vector<Vec<Dim>>> solid(images > 0 ? grid_.box().size() : 0);
  for (const Placement<Dim>& s : placements) solid[cell_of(grid_.box(), s.x)].push_back(s.x);
  const auto in_a_solid = [&](std::size_t cell, const Vec<Dim>& x) {
    bool found = false;
    for_cells_near<Dim>(grid_.box(), grid_.box().cell(cell), 1, [&](std::size_t near, int) {
      for (const Vec<Dim>& y : solid[near])
        found = found || shortest_way(grid_.box(), x, y).norm() < room_for_particles * scene_.spacing;
    });
    return found;
  };
  for (const std::size_t cell : cells_of(false))
    for_points<Dim>(grid_.box().centre(grid_.box().cell(cell)), grid_.box().spacing, settings_.ratio,
                    [&](const Vec<Dim>& x) {
                      if (images > 0 && in_a_solid(cell, x)) return;
                      placements.push_back({x, x, volume, scene_.spacing, grid_.state(cell).density, body, 0});
                    });
  const Scene scene = scene_of_particles(scene_);
  particles_ = assemble<Dim>(scene, {grid_.material()}, stages({grid_.material()}), placements, [&](Sph<Dim>& sph) {
    sph.clock = clock;
    sph.title = "gas";
    Particles<Dim>& p = sph.particles;
    if (solids_) {
      std::ranges::fill(p.column(Field::wall), 0.0);
      std::fill_n(p.column(Field::wall).begin(), images, 1.0);
    }
    for (std::size_t i = images; i < p.size(); ++i) {
      const auto u = *matter.mean(placements[i].x, scene_.spacing, cell_samples<Dim>);
      double squares = 0;
      for (int a = 0; a < Dim; ++a) {
        const double v = p.column(Field::velocity, a)[i] = u[static_cast<std::size_t>(1 + a)] / u[0];
        squares += v * v;
      }
      p.column(Field::density)[i] = u[0];
      p.column(Field::mass)[i] = u[0] * volume;
      p.column(Field::specific_energy)[i] = u[Dim + 1] / u[0] - 0.5 * squares;
    }
    if (solids_) laid_density_.assign(p.column(Field::density).begin(), p.column(Field::density).end());
  });
  laid_density_.clear();
}

template <int Dim>
Part Hybrid<Dim>::part_at(const Vec<Dim>& x) const {
  return zone_[cell_of(grid_.box(), x)];
}

template <int Dim>
PointState<Dim> Hybrid<Dim>::led_state(std::size_t i) const {
  const Vec<Dim> x = particles_->particles.vector(Field::position, i);
  const PointState<Dim> a = before_->at(x), b = after_->at(x);
  const double share = std::clamp((particles_->clock.time - began_) / span_, 0.0, 1.0);
  return {.density = a.density + share * (b.density - a.density),
          .velocity = a.velocity + share * (b.velocity - a.velocity),
          .specific_energy = a.specific_energy + share * (b.specific_energy - a.specific_energy)};
}

template <int Dim>
void Hybrid<Dim>::lead_motion(Sph<Dim>& sph) const {
  if (!after_) return;
  Particles<Dim>& p = sph.particles;
  parallel_for(0, p.size(), [&](std::size_t i) {
    if (part_at(p.vector(Field::position, i)) == Part::active || is_image(p, i)) return;
    const PointState<Dim> s = led_state(i);
    p.set_vector(Field::velocity, i, s.velocity);
    p.column(Field::specific_energy)[i] = s.specific_energy;
  });
}

template <int Dim>
void Hybrid<Dim>::lead_state(Sph<Dim>& sph) const {
  if (after_ || !laid_density_.empty()) lead_gas(sph);
  if (solids_) {
    by_cell_.sort(sph.particles, grid_.box());
    solids_->mirror(sph, by_cell_, grid_.box(), grid_.ambient());
  }
}

/// Led particles have the density of the grid. Those with all their neighbours take the mass for that in the volume
/// that these leave them, so that nothing changes when they are let go, however they lie: masses of particles are in no
/// ledger. Sums at the rim are cut off: there it is the volume that follows from the mass.
template <int Dim>
void Hybrid<Dim>::lead_gas(Sph<Dim>& sph) const {
  Particles<Dim>& p = sph.particles;
  const bool laid = !laid_density_.empty();
  std::visit(
      [&](const auto& eos) {
        parallel_for(0, p.size(), [&](std::size_t i) {
          const Part part = part_at(p.vector(Field::position, i));
          if ((part == Part::active && !laid) || is_image(p, i)) return;
          PointState<Dim> s;
          if (laid)
            s = {laid_density_[static_cast<std::size_t>(p.label(Label::id)[i])],
                 {},
                 p.column(Field::specific_energy)[i]};
          else
            s = led_state(i);
          const EosPoint point = eos.evaluate(s.density, s.specific_energy);
          double &mass = p.column(Field::mass)[i], &density = p.column(Field::density)[i];
          if (part != Part::rim)
            mass *= s.density / density;
          else
            p.column(Field::smoothing_length)[i] =
                sph.scene.numerics.nodes_per_h * std::pow(mass / s.density, 1.0 / Dim);
          density = s.density;
          p.column(Field::pressure)[i] = point.pressure;
          p.column(Field::sound_speed)[i] = sound_speed(point, s.density, eos.sound_speed_floor());
        });
      },
      grid_.material().eos);
  renew_lists(sph);
}

/// The integrator leaves led particles their velocities and energies.
template <int Dim>
void Hybrid<Dim>::lead_rest(Sph<Dim>& sph) const {
  if (solids_) solids_->keep_power(sph);
  if (!after_) return;
  Particles<Dim>& p = sph.particles;
  parallel_for(0, p.size(), [&](std::size_t i) {
    if (part_at(p.vector(Field::position, i)) == Part::active || is_image(p, i)) return;
    for (int a = 0; a < Dim; ++a) p.column(Field::acceleration, a)[i] = p.previous(Field::acceleration, a)[i] = 0;
    p.column(Field::specific_energy_rate)[i] = p.expected(Field::specific_energy_rate)[i] = 0;
  });
}

template <int Dim>
void Hybrid<Dim>::hold_zone(const std::function<bool(const Vec<Dim>&)>& inside) {
  std::vector<char> active(grid_.box().size());
  for (std::size_t i = 0; i < active.size(); ++i) active[i] = inside(grid_.box().centre(grid_.box().cell(i)));
  zone_.hold(std::move(active));
}

template <int Dim>
void Hybrid<Dim>::advance(double dt) {
  timers.time("zone", [&] { move_zone(); });
  const std::vector<std::size_t> covered = cells_of(false);
  const bool alone = particles_->particles.size() == 0;
  if (!alone) before_.emplace(grid_, covered);
  grid_.advance(dt);
  if (!alone) {
    after_.emplace(grid_, covered);
    began_ = clock.time;
    span_ = dt;
    const std::vector<std::size_t> active = cells_of(true);
    std::vector<std::int32_t> place(grid_.box().size(), -1);
    for (std::size_t k = 0; k < active.size(); ++k) place[active[k]] = static_cast<std::int32_t>(k);
    std::vector<SolidShare<Dim>> solids(active.size());
    substeps(dt, solids, place);
    timers.time("transfer", [&] { follow_particles(active, place, solids); });
  }
  external = grid_.external;
  if (solids_) external += solids_->particles().external;
  clock = {clock.time + dt, dt, clock.step + 1};
}

/// Particles through a step of the grid; adds up what solids take of the active cells.
template <int Dim>
void Hybrid<Dim>::substeps(double dt, std::vector<SolidShare<Dim>>& solids, const std::vector<std::int32_t>& place) {
  const Box<Dim>& box = grid_.box();
  const auto place_at = [&](const Vec<Dim>& x) { return place[cell_of(box, x)]; };
  const auto took = [&](const Vec<Dim>& x, const GasLoad<Dim>& load) {
    std::array<double, Dim + 2>& cell = solids[static_cast<std::size_t>(place_at(x))].taken;
    for (std::size_t a = 0; a < Dim; ++a) cell[1 + a] += load.impulse[static_cast<int>(a)] / box.cell_volume();
    cell[Dim + 1] += load.energy / box.cell_volume();
  };
  particles_->clock.time = clock.time;
  for (double left = dt; left > 1e-12 * dt;) {
    const double steps = std::max(1.0, std::ceil(left / particles_->vote().dt - 1e-9)), step = left / steps;
    if (solids_) solids_->begin(*particles_, step);
    particles_->advance(step);
    if (solids_)
      solids_->end(
          *particles_, by_cell_, box, step, [&](const Vec<Dim>& x) { return place_at(x) >= 0; }, took);
    particle_steps_ += static_cast<double>(particles_->particles.size());
    left = steps == 1 ? 0 : clock.time + dt - particles_->clock.time;
  }
  particles_->check_health();
  if (solids_) solids_->particles().check_health();
}

/// The active cells become what their particles say, but for what solids have taken.
template <int Dim>
void Hybrid<Dim>::follow_particles(const std::vector<std::size_t>& active, const std::vector<std::int32_t>& place,
                                   std::vector<SolidShare<Dim>>& solids) {
  if (active.empty()) return;
  const auto found = restrict_particles(particles_->particles, grid_.box(), place, active.size());
  std::array<double, Dim + 2> filler{};  // what cells hold where solids are
  if (solids_) {
    const CellState<Dim> rest = grid_.ambient();
    filler[0] = rest.density;
    filler[Dim + 1] = rest.density * rest.specific_energy;
  }
  std::vector<std::array<double, Dim + 2>> wanted(active.size());
  for (std::size_t k = 0; k < active.size(); ++k) {
    solids[k].there = found[k].solid > 0;
    for (std::size_t c = 0; c < Dim + 2; ++c)
      wanted[k][c] = found[k].volume > least_covered ? found[k].sum[c] + found[k].solid * filler[c]
                                                     : grid_.cells()[c][active[k]] - solids[k].taken[c];
  }
  if (settings_.transfer == Transfer::interpolate) return grid_.put(active, wanted);
  const CellChanges<Dim> changes = correct_by_fluxes(grid_, active, place, solids, wanted);
  grid_.put(changes.cells, changes.values);
}

template <int Dim>
void Hybrid<Dim>::persist(Archive& archive) {
  std::int64_t steps = static_cast<std::int64_t>(particle_steps_);
  archive.integer("particle_steps", steps);
  particle_steps_ = static_cast<double>(steps);
  saved_zone_.clear();
  for (const Part part : zone_.parts()) saved_zone_.push_back(static_cast<std::int32_t>(part));
  saved_zone_.resize(archive.size(saved_zone_.size()));
  archive.labels("zone", saved_zone_);
  if (!archive.reads()) return;
  zone_.parts().clear();
  for (const std::int32_t part : saved_zone_) zone_.parts().push_back(static_cast<Part>(part));
}

template class Hybrid<2>;
template class Hybrid<3>;

}  // namespace ejecta
