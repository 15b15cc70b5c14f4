/// The box of a grid goes with the wave.
#include <algorithm>

#include "grid/copy_cells.hpp"
#include "grid/grid.hpp"

namespace ejecta {

namespace {

/// An open face moves out when a wave is this near, and by at least so many cells or this share of the box.
constexpr int near_cells = 8, least_growth = 32;
constexpr double growth_share = 0.2;

}  // namespace

/// Whether the cells of a tile between `low` and `high` along an axis are those of the gas.
template <int Dim>
bool Grid<Dim>::is_ambient(const Tile<Dim>& tile, std::size_t axis, int low, int high) const {
  std::array<int, Dim> begin = tile.begin, end;
  for (std::size_t a = 0; a < Dim; ++a) end[a] = tile.begin[a] + tile.count[a];
  begin[axis] = std::max(begin[axis], low);
  end[axis] = std::min(end[axis], high);
  if (begin[axis] >= end[axis]) return true;
  for (std::array<int, Dim> c = begin;;) {
    if (cell(box_.index(c)) != ambient_) return false;
    std::size_t a = 0;
    while (a < Dim && ++c[a] == end[a]) {
      c[a] = begin[a];
      ++a;
    }
    if (a == Dim) return true;
  }
}

template <int Dim>
void Grid<Dim>::make_room() {
  std::array<int, Dim> below{}, above{};
  bool grows = false;
  for (std::size_t a = 0; a < Dim; ++a) {
    const auto disturbed = [&](bool upper) {
      const int low = upper ? box_.cells[a] - near_cells : 0, high = upper ? box_.cells[a] : near_cells;
      return std::ranges::any_of(tiles_, [&](const TileState& t) { return !is_ambient(t.tile, a, low, high); });
    };
    const int step = std::max(least_growth, static_cast<int>(growth_share * box_.cells[a]));
    if (box_.grows_lower[a] && disturbed(false)) below[a] = step;
    if (box_.grows_upper[a] && disturbed(true)) above[a] = step;
    grows = grows || below[a] > 0 || above[a] > 0;
  }
  if (!grows) return;
  Box<Dim> larger = box_;
  for (std::size_t a = 0; a < Dim; ++a) {
    larger.cells[a] += below[a] + above[a];
    larger.corner[static_cast<int>(a)] -= below[a] * box_.spacing;
  }
  Conserved<Dim> cells;
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c].assign(larger.size(), ambient_[c]);
  copy_cells<Dim>(box_, now_, {}, box_.cells, larger, cells, below);
  const double added = static_cast<double>(larger.size() - box_.size()) * box_.cell_volume();
  external.mass += added * ambient_[0];
  for (int a = 0; a < Dim; ++a) external.impulse[a] += added * ambient_[static_cast<std::size_t>(1 + a)];
  external.work += added * ambient_[Dim + 1];
  box_ = larger;
  now_ = std::move(cells);
  cut_tiles();
}

template bool Grid<2>::is_ambient(const Tile<2>&, std::size_t, int, int) const;
template bool Grid<3>::is_ambient(const Tile<3>&, std::size_t, int, int) const;
template void Grid<2>::make_room();
template void Grid<3>::make_room();

}  // namespace ejecta
