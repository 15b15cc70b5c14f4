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
  return scene;
}

/// Of a particle, in cells.
double reach_of(const Scene& scene) {
  return kernel_support(scene.numerics.kernel) * scene.numerics.nodes_per_h / hybrid_settings(scene).ratio;
}

}  // namespace

template <int Dim>
Hybrid<Dim>::Hybrid(const Scene& scene, const std::vector<Material>& materials)
    : scene_(scene),
      settings_(hybrid_settings(scene)),
      grid_(scene_of_grid(scene), materials),
      zone_(settings_, reach_of(scene)) {
  if ((settings_.ratio & (settings_.ratio - 1)) != 0)
    throw InputError(fmt::format("{}: hybrid.ratio: expected a power of two, got {}", scene.file, settings_.ratio));
  clock = grid_.clock;
  if (scene.numerics.density != DensityMethod::summation)
    throw InputError(fmt::format("{}: numerics.density: expected summation with numerics.scheme = \"hybrid\", got {}",
                                 scene.file, name_of(scene.numerics.density)));
  zone_.update(grid_);
  lay_particles(materials);
  initial = conserved();
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
    if (name == "equation of state")
      add("led state", {position, mass, density}, {mass, density, pressure, sound_speed, smoothing_length},
          &Hybrid::lead_state);
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
  for (const std::size_t cell : cells_of(false))
    for_points<Dim>(grid_.box().centre(grid_.box().cell(cell)), grid_.box().spacing, settings_.ratio,
                    [&](const Vec<Dim>& x) {
                      placements.push_back({x, x, volume, scene_.spacing, grid_.state(cell).density, body, 0});
                    });
  const Scene scene = scene_of_particles(scene_);
  particles_ = assemble<Dim>(scene, {grid_.material()}, stages({grid_.material()}), placements, [&](Sph<Dim>& sph) {
    sph.clock = clock;
    Particles<Dim>& p = sph.particles;
    for (std::size_t i = 0; i < p.size(); ++i) {
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
  });
}

template <int Dim>
Part Hybrid<Dim>::part_of(std::size_t i) const {
  return zone_[cell_of(grid_.box(), particles_->particles.vector(Field::position, i))];
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
    if (part_of(i) == Part::active) return;
    const PointState<Dim> s = led_state(i);
    p.set_vector(Field::velocity, i, s.velocity);
    p.column(Field::specific_energy)[i] = s.specific_energy;
  });
}

/// Led particles have the density of the grid. Those with all their neighbours take the mass for that in the volume
/// that these leave them, so that nothing changes when they are let go, however they lie: masses of particles are in no
/// ledger. Sums at the rim are cut off: there it is the volume that follows from the mass.
template <int Dim>
void Hybrid<Dim>::lead_state(Sph<Dim>& sph) const {
  if (!after_) return;
  Particles<Dim>& p = sph.particles;
  std::visit(
      [&](const auto& eos) {
        parallel_for(0, p.size(), [&](std::size_t i) {
          const Part part = part_of(i);
          if (part == Part::active) return;
          const PointState<Dim> s = led_state(i);
          const EosPoint point = eos.evaluate(s.density, s.specific_energy);
          double &mass = p.column(Field::mass)[i], &density = p.column(Field::density)[i];
          if (part == Part::led)
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
  if (!after_) return;
  Particles<Dim>& p = sph.particles;
  parallel_for(0, p.size(), [&](std::size_t i) {
    if (part_of(i) == Part::active) return;
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
  external = grid_.external;
  if (!alone) {
    after_.emplace(grid_, covered);
    began_ = clock.time;
    span_ = dt;
    particles_->clock.time = clock.time;
    for (double left = dt; left > 1e-12 * dt;) {
      const double steps = std::max(1.0, std::ceil(left / particles_->vote().dt - 1e-9));
      particles_->advance(left / steps);
      particle_steps_ += static_cast<double>(particles_->particles.size());
      left = steps == 1 ? 0 : clock.time + dt - particles_->clock.time;
    }
    particles_->check_health();
    timers.time("transfer", [&] { follow_particles(); });
  }
  clock = {clock.time + dt, dt, clock.step + 1};
}

/// The active cells become what their particles say.
template <int Dim>
void Hybrid<Dim>::follow_particles() {
  const std::vector<std::size_t> active = cells_of(true);
  if (active.empty()) return;
  std::vector<std::int32_t> place(grid_.box().size(), -1);
  for (std::size_t k = 0; k < active.size(); ++k) place[active[k]] = static_cast<std::int32_t>(k);
  const auto found = restrict_particles(particles_->particles, grid_.box(), place, active.size());
  std::vector<std::array<double, Dim + 2>> wanted(active.size());
  for (std::size_t k = 0; k < active.size(); ++k)
    for (std::size_t c = 0; c < Dim + 2; ++c)
      wanted[k][c] = found[k].volume > least_covered ? found[k].sum[c] : grid_.cells()[c][active[k]];
  if (settings_.transfer == Transfer::interpolate) return grid_.put(active, wanted);
  const CellChanges<Dim> changes = correct_by_fluxes(grid_, active, place, wanted);
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
