#include "observe/grid_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"
#include "grid/blast_reach.hpp"
#include "observe/channels.hpp"
#include "observe/field_styles.hpp"

namespace ejecta {

namespace {

const std::vector<std::string> slice_fields{"density", "pressure", "mach"};

/// The box, or where it grows with a blast, what that will have swept.
template <int Dim>
View view_of(const Scene& scene, const Grid<Dim>& grid) {
  View view{scene.insitu.view_center, scene.insitu.view_size};
  const Box<Dim>& box = grid.box();
  double largest = 0;
  for (int a = 0; a < Dim; ++a) {
    const auto i = static_cast<std::size_t>(a);
    double low = box.corner[a], high = low + box.cells[i] * box.spacing;
    if (scene.charge && (box.grows_lower[i] || box.grows_upper[i])) {
      const double reach = 1.15 * blast_reach(scene, grid.ambient().density);
      if (box.grows_lower[i]) low = std::min(low, scene.charge->center[i] - reach);
      if (box.grows_upper[i]) high = std::max(high, scene.charge->center[i] + reach);
    }
    if (!is_set(view.center[i])) view.center[i] = 0.5 * (low + high);
    largest = std::max(largest, high - low);
  }
  for (double& c : view.center)
    if (!is_set(c)) c = 0;
  if (!is_set(view.size)) view.size = 1.04 * largest;
  return view;
}

/// Of a blast what its shock will have come down to at the end; of anything else what there is at the start.
template <int Dim>
Extremes expected(const Scene& scene, const Grid<Dim>& grid) {
  const GridOutset& start = grid.outset();
  Extremes e;
  e.pressure = start.pressure;
  e.density = start.density;
  e.speed = start.speed;
  e.mach = std::max(2.0, 1.5 * start.mach);
  if (!scene.charge || !scene.gas) return e;
  const double r = blast_reach(scene, grid.ambient().density);
  const double volume = Dim == 2 ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
  e.pressure = 1.5 * scene.charge->energy_in(Dim) / volume;
  e.density = 6 * grid.ambient().density;
  e.mach = 2;  // behind a strong shock 1.9, and falling
  return e;
}

/// The pixels without those beyond faces that stay where they are: nothing will ever be there.
template <int Dim>
PixelGrid within(PixelGrid pixels, const Box<Dim>& box) {
  const auto trim = [&](std::size_t axis, std::size_t side, int& count) {
    const double low = box.corner[static_cast<int>(axis)], high = low + box.cells[axis] * box.spacing;
    double& first = pixels.first[side];
    while (!box.grows_lower[axis] && count > 1 && first < low) first += pixels.pixel, --count;
    while (!box.grows_upper[axis] && count > 1 && first + (count - 1) * pixels.pixel > high) --count;
  };
  trim(0, 0, pixels.width);
  trim(Dim - 1, 1, pixels.height);
  return pixels;
}

}  // namespace

template <int Dim>
GridFrames<Dim>::GridFrames(const Simulation& sim, const Grid<Dim>& grid, const std::filesystem::path& folder,
                            bool catalyst)
    : Frames(sim, folder, catalyst,
             {view_of(sim.scene, grid), slice_fields, field_styles(sim.scene, expected(sim.scene, grid))}, {}),
      grid_(grid),
      hybrid_(find_package<Hybrid<Dim>>(sim)) {
  slice_grid_ = within(slice_grid_, grid.box());
}

/// What the cells hold at the centres of the pixels.
template <int Dim>
SampledImage GridFrames<Dim>::make_slice() {
  SampledImage image;
  image.grid = slice_grid_;
  const auto width = static_cast<std::size_t>(slice_grid_.width), height = static_cast<std::size_t>(slice_grid_.height);
  const std::vector<double> nothing(width * height, std::numeric_limits<double>::quiet_NaN());
  image.fields = {{"density", "kg/m^3", {nothing}}, {"pressure", "Pa", {nothing}}, {"mach", "1", {nothing}}};
  if (hybrid_) hybrid_->look();
  // The edge of what particles fill is left blank, a line one pixel wide.
  const auto active = [&](const Vec<Dim>& x) {
    return hybrid_ && grid_.at(x) && hybrid_->zone()[cell_of(grid_.box(), x)] == Part::active;
  };
  parallel_blocks(height, 1, [&](std::size_t row, std::size_t) {
    for (std::size_t column = 0; column < width; ++column) {
      Vec<Dim> x;
      x[0] = slice_grid_.first[0] + static_cast<double>(column) * slice_grid_.pixel;
      x[Dim - 1] = slice_grid_.first[1] + static_cast<double>(row) * slice_grid_.pixel;
      if constexpr (Dim == 3) x[1] = view_.center[1];
      const auto state = hybrid_ ? hybrid_->at(x) : grid_.at(x);
      if (!state) continue;
      if (hybrid_) {
        Vec<Dim> right = x, up = x;
        right[0] += slice_grid_.pixel;
        up[Dim - 1] += slice_grid_.pixel;
        const bool here = active(x);
        if (active(right) != here || active(up) != here) continue;
      }
      const std::size_t i = row * width + column;
      image.fields[0].components[0][i] = state->density;
      image.fields[1].components[0][i] = state->pressure;
      image.fields[2].components[0][i] = state->velocity.norm() / state->sound_speed;
    }
  });
  return image;
}

template <int Dim>
std::vector<Channel> GridFrames<Dim>::make_channels(Simulation& sim) {
  std::vector<Channel> made;
  if (reads("slice"))
    sim.timers.time("in situ: slice", [&] {
      slice_ = make_slice();
      made.push_back(slice_channel(slice_, Dim, view_.center[1]));
    });
  return made;
}

template class GridFrames<2>;
template class GridFrames<3>;

}  // namespace ejecta
