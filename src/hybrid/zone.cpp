#include "hybrid/zone.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace ejecta {

template <int Dim>
std::size_t Zone<Dim>::count(Part part) const {
  return static_cast<std::size_t>(std::ranges::count(parts_, part));
}

template <int Dim>
void Zone<Dim>::follow(const Box<Dim>& before, const Box<Dim>& now) {
  std::vector<Part> moved(now.size(), Part::grid);
  std::array<int, Dim> offset{};
  for (std::size_t a = 0; a < Dim; ++a)
    offset[a] = static_cast<int>(
        std::lround((before.corner[static_cast<int>(a)] - now.corner[static_cast<int>(a)]) / now.spacing));
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i] == Part::grid) continue;
    std::array<int, Dim> cell = before.cell(i);
    for (std::size_t a = 0; a < Dim; ++a) cell[a] += offset[a];
    moved[now.index(cell)] = parts_[i];
  }
  parts_ = std::move(moved);
}

/// 1: within reach of a front or a solid; 2: near enough to keep its particles.
template <int Dim>
std::vector<std::uint8_t> Zone<Dim>::near_fronts(const Grid<Dim>& grid, const std::vector<std::size_t>& solids) const {
  const Box<Dim>& box = grid.box();
  std::vector<double> pressure(box.size());
  parallel_for(0, box.size(), [&](std::size_t i) { pressure[i] = grid.state(i).pressure; });
  const double least = settings_.least_share * *std::ranges::max_element(pressure);
  const auto& cells = grid.cells();
  std::vector<std::uint8_t> near(box.size(), 0);
  const auto stamp = [&](std::size_t cell, int radius) {
    for_cells_near<Dim>(box, box.cell(cell), radius + settings_.hysteresis, [&](std::size_t i, int squares) {
      const int keep = radius + settings_.hysteresis;
      if (squares <= radius * radius)
        near[i] = 1;
      else if (near[i] == 0 && squares <= keep * keep)
        near[i] = 2;
    });
  };
  for (const std::size_t i : solids) stamp(i, settings_.around);
  for (std::size_t i = 0; i < box.size(); ++i) {
    const std::array<int, Dim> cell = box.cell(i);
    for (std::size_t a = 0; a < Dim; ++a) {
      std::array<int, Dim> next = cell;
      if (++next[a] == box.cells[a]) {
        if (box.lower[a] != BoundaryKind::periodic) continue;
        next[a] = 0;
      }
      const std::size_t j = box.index(next);
      const double low = std::min(pressure[i], pressure[j]), high = std::max(pressure[i], pressure[j]);
      if (high - low <= settings_.jump * low || high - low < least) continue;
      if (cells[1 + a][j] / cells[0][j] >= cells[1 + a][i] / cells[0][i]) continue;
      stamp(pressure[i] < pressure[j] ? i : j, settings_.ahead);
      stamp(pressure[i] < pressure[j] ? j : i, settings_.behind);
    }
  }
  return near;
}

template <int Dim>
void Zone<Dim>::update(const Grid<Dim>& grid, const std::vector<std::size_t>& solids) {
  const Box<Dim>& box = grid.box();
  std::vector<std::uint8_t> near(held_.begin(), held_.end());
  if (held_.empty()) near = near_fronts(grid, solids);
  if (parts_.size() != box.size()) parts_.assign(box.size(), Part::grid);
  std::vector<Part> now(box.size(), Part::grid);
  // Particles that no gas holds from the other side would fly out of an open face.
  const auto inside = [&](const std::array<int, Dim>& cell) {
    for (std::size_t a = 0; a < Dim; ++a)
      if ((box.lower[a] == BoundaryKind::open && cell[a] < depth_) ||
          (box.upper[a] == BoundaryKind::open && cell[a] >= box.cells[a] - depth_))
        return false;
    return true;
  };
  for (std::size_t i = 0; i < box.size(); ++i)
    if ((near[i] == 1 || (near[i] == 2 && parts_[i] == Part::active)) && inside(box.cell(i))) now[i] = Part::active;
  for (std::size_t i = 0; i < box.size(); ++i)
    if (now[i] == Part::active)
      for_cells_near<Dim>(box, box.cell(i), depth_, [&](std::size_t j, int) {
        if (now[j] == Part::grid) now[j] = Part::rim;
      });
  for (std::size_t i = 0; i < box.size(); ++i)
    if (now[i] == Part::active)
      for_cells_near<Dim>(box, box.cell(i), inner_, [&](std::size_t j, int) {
        if (now[j] == Part::rim) now[j] = Part::led;
      });
  parts_ = std::move(now);
}

template class Zone<2>;
template class Zone<3>;

}  // namespace ejecta
