#include "observe/grid_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"
#include "grid/blast_reach.hpp"
#include "observe/channels.hpp"
#include "observe/field_styles.hpp"
#include "observe/particle_frames.hpp"

namespace ejecta {

namespace {

/// The box, or where it grows with a blast, what that will have swept.
template <int Dim>
View view_of(const Scene& scene, const Grid<Dim>& grid) {
  View view{scene.insitu.view_center, scene.insitu.view_size, scene.insitu.view_height};
  const Box<Dim>& box = grid.box();
  Vec<Dim> extent;
  for (int a = 0; a < Dim; ++a) {
    const auto i = static_cast<std::size_t>(a);
    double low = box.corner[a], high = low + box.cells[i] * box.spacing;
    if (scene.charge && (box.grows_lower[i] || box.grows_upper[i])) {
      const double reach = 1.15 * blast_reach(scene, grid.ambient().density);
      if (box.grows_lower[i]) low = std::min(low, scene.charge->center[i] - reach);
      if (box.grows_upper[i]) high = std::max(high, scene.charge->center[i] + reach);
    }
    if (!is_set(view.center[i])) view.center[i] = 0.5 * (low + high);
    extent[a] = high - low;
  }
  for (double& c : view.center)
    if (!is_set(c)) c = 0;
  const bool given = is_set(view.width);
  if (!given) view.width = extent[0];
  if (!is_set(view.height)) view.height = given ? view.width : extent[Dim - 1];
  return view;
}

/// How far the shock of the charge will be seen [m]: to the end of the run, or to the farthest face that stands still.
template <int Dim>
double seen_reach(const Scene& scene, const Grid<Dim>& grid) {
  const Box<Dim>& box = grid.box();
  double farthest = 0;
  for (std::size_t a = 0; a < Dim; ++a) {
    const double low = box.corner[static_cast<int>(a)], high = low + box.cells[a] * box.spacing;
    const double centre = scene.charge->center[a];
    constexpr double no_end = std::numeric_limits<double>::infinity();
    farthest =
        std::max({farthest, box.grows_lower[a] ? no_end : centre - low, box.grows_upper[a] ? no_end : high - centre});
  }
  return std::min(blast_reach(scene, grid.ambient().density), farthest);
}

/// Of a blast what its shock will have come down to when it is last seen; of anything else what there is at the start.
template <int Dim>
Extremes expected(const Scene& scene, const Grid<Dim>& grid) {
  const GridOutset& start = grid.outset();
  Extremes e;
  e.pressure = start.pressure;
  e.density = start.density;
  e.speed = start.speed;
  e.mach = std::max(2.0, 1.5 * start.mach);
  if (!scene.charge || !scene.gas) return e;
  const double r = seen_reach(scene, grid);
  const double volume = Dim == 2 ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
  e.pressure = 1.5 * scene.charge->energy_in(Dim) / volume;
  e.density = 6 * grid.ambient().density;
  e.mach = 2;  // behind a strong shock 1.9, and falling
  return e;
}

template <int Dim>
const Sph<Dim>* solids_of(const Hybrid<Dim>* hybrid) {
  return hybrid && hybrid->solids() ? &hybrid->solids()->particles() : nullptr;
}

/// Whether pictures show how solids break, in place of the Mach number.
template <int Dim>
bool shows_damage(const Sph<Dim>* solids) {
  return solids && solids->particles.has(Field::damage);
}

/// With solids besides, and what a body of their speed does to gas at rest that it pushes: about a simple shock before
/// a piston.
template <int Dim>
Extremes with_solids(Extremes e, const Scene& scene, const CellState<Dim>& gas, const Sph<Dim>& solids) {
  const Extremes theirs = extremes(scene, solids.materials, solids.outset);
  const double speed = solids.outset.speed;
  e.tension = theirs.tension;
  e.onset = theirs.onset;
  e.pressure = std::max(e.pressure, gas.pressure + gas.density * speed * (gas.sound_speed + speed));
  e.density = std::max(e.density, gas.density * std::min(6.0, 1 + speed / gas.sound_speed));
  return e;
}

/// Faces that stay where they are: nothing will ever be beyond.
template <int Dim>
Window limits_of(const Box<Dim>& box) {
  Window limits = Layout::everywhere();
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t axis = side == 0 ? 0 : Dim - 1;
    const double low = box.corner[static_cast<int>(axis)];
    if (!box.grows_lower[axis]) limits.low[side] = low;
    if (!box.grows_upper[axis]) limits.high[side] = low + box.cells[axis] * box.spacing;
  }
  return limits;
}

template <int Dim>
PicturePlan plan_of(const Simulation& sim, const Grid<Dim>& grid) {
  const Sph<Dim>* solids = solids_of(find_package<Hybrid<Dim>>(sim));
  Extremes largest = expected(sim.scene, grid);
  if (solids) largest = with_solids(largest, sim.scene, grid.ambient(), *solids);
  PicturePlan plan{
      view_of(sim.scene, grid), limits_of(grid.box()), {"density", "pressure"}, field_styles(sim.scene, largest)};
  plan.slice_fields.emplace_back(shows_damage(solids) ? "damage" : "mach");
  return plan;
}

template <int Dim>
PipelineSettings told_of(const Simulation& sim) {
  const Sph<Dim>* solids = solids_of(find_package<Hybrid<Dim>>(sim));
  PipelineSettings told = solids ? pipeline_settings(*solids) : PipelineSettings{};
  told.channels = {"slice"};
  if (solids) told.channels.push_back("particles");
  if (solids && sim.scene.fragments.enabled) told.channels.push_back("fragments");
  return told;
}

}  // namespace

template <int Dim>
GridFrames<Dim>::GridFrames(const Simulation& sim, const Grid<Dim>& grid, const std::filesystem::path& folder,
                            Outputs& outputs, bool catalyst)
    : Frames(sim, folder, outputs, catalyst, plan_of(sim, grid), told_of<Dim>(sim)),
      grid_(grid),
      hybrid_(find_package<Hybrid<Dim>>(sim)),
      solids_(solids_of(hybrid_)) {}

template <int Dim>
SampledImage GridFrames<Dim>::make_slice() {
  return sample(false);
}

/// What the cells hold at the centres of the pixels.
template <int Dim>
SampledImage GridFrames<Dim>::sample(bool with_velocity) {
  SampledImage image;
  image.grid = slice_grid_;
  const auto width = static_cast<std::size_t>(slice_grid_.width), height = static_cast<std::size_t>(slice_grid_.height);
  const std::vector<double> nothing(width * height, std::numeric_limits<double>::quiet_NaN());
  const bool damage = shows_damage(solids_);
  image.fields = {
      {"density", "kg/m^3", {nothing}}, {"pressure", "Pa", {nothing}}, {damage ? "damage" : "mach", "1", {nothing}}};
  if (with_velocity) image.fields.push_back({"velocity", "m/s", std::vector<std::vector<double>>(Dim, nothing)});
  if (hybrid_) hybrid_->look();
  // The edge of what particles fill is left blank, a line one pixel wide.
  const auto active = [&](const Vec<Dim>& x) {
    return hybrid_ && grid_.at(x) && hybrid_->zone()[cell_of(grid_.box(), x)] == Part::active;
  };
  // In space the picture plane is x-z, but its vectors keep all three components.
  const auto set_velocity = [&](std::size_t i, const Vec<Dim>& v) {
    for (int a = 0; a < Dim; ++a) image.fields[3].components[static_cast<std::size_t>(a)][i] = v[a];
  };
  parallel_blocks(height, 1, [&](std::size_t row, std::size_t) {
    for (std::size_t column = 0; column < width; ++column) {
      Vec<Dim> x;
      x[0] = slice_grid_.first[0] + static_cast<double>(column) * slice_grid_.pixel;
      x[Dim - 1] = slice_grid_.first[1] + static_cast<double>(row) * slice_grid_.pixel;
      if constexpr (Dim == 3) x[1] = view_.center[1];
      const std::size_t i = row * width + column;
      if (const auto solid = hybrid_ ? hybrid_->solid_at(x) : std::nullopt) {
        image.fields[1].components[0][i] = solids_->particles.column(Field::pressure)[*solid];
        if (damage) image.fields[2].components[0][i] = solids_->particles.column(Field::damage)[*solid];
        if (with_velocity) set_velocity(i, solids_->particles.vector(Field::velocity, *solid));
        continue;
      }
      const auto state = hybrid_ ? hybrid_->at(x) : grid_.at(x);
      if (!state) continue;
      if (hybrid_) {
        Vec<Dim> right = x, up = x;
        right[0] += slice_grid_.pixel;
        up[Dim - 1] += slice_grid_.pixel;
        const bool here = active(x);
        if (active(right) != here || active(up) != here) continue;
      }
      image.fields[0].components[0][i] = state->density;
      image.fields[1].components[0][i] = state->pressure;
      if (!damage) image.fields[2].components[0][i] = state->velocity.norm() / state->sound_speed;
      if (with_velocity) set_velocity(i, state->velocity);
    }
  });
  return image;
}

template <int Dim>
Signs GridFrames<Dim>::signs(const Simulation& sim, bool fragments_too) const {
  Signs signs = Frames::signs(sim, fragments_too);
  for (const Quantity& q : quantities(sim))
    if (q.name == "max pressure") signs.pressure = std::get<double>(q.value);
  if (fragments_ && fragments_too) {
    const std::size_t target = target_body(solids_->scene, solids_->outset.bodies);
    signs.fragments = static_cast<double>(fragments_->fragments.size());
    signs.largest_fragment = fragments_->largest_mass(target) / solids_->outset.bodies[target].mass;
  }
  return signs;
}

template <int Dim>
std::vector<Channel> GridFrames<Dim>::make_channels(Simulation& sim) {
  std::vector<Channel> made;
  if (reads("slice"))
    sim.timers.time("in situ: slice", [&] {
      slice_ = sample(true);
      made.push_back(slice_channel(slice_, Dim, view_.center[1]));
    });
  if (solids_ && reads("particles")) made.push_back(channels_.particles(solids_->particles, fragments_));
  if (fragments_ && reads("fragments"))
    made.push_back(channels_.fragments(*fragments_, target_body(solids_->scene, solids_->outset.bodies)));
  return made;
}

template <int Dim>
void GridFrames<Dim>::look(Simulation& sim) {
  if (!solids_ || !sim.scene.fragments.enabled) return;
  sim.timers.time("in situ: fragment search",
                  [&] { fragments_ = tracker_.update(fragment_input(*solids_), sim.scene.fragments); });
}

template <int Dim>
void GridFrames<Dim>::resume(const Simulation& sim, const Checkpoint& checkpoint) {
  Frames::resume(sim, checkpoint);
  if (solids_ && sim.scene.fragments.enabled)
    fragments_ = tracker_.update(fragment_input(*solids_), sim.scene.fragments);
}

template class GridFrames<2>;
template class GridFrames<3>;

}  // namespace ejecta
