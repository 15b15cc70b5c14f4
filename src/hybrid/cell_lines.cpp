#include "hybrid/cell_lines.hpp"

#include <cmath>

#include "base/parallel.hpp"
#include "hybrid/zone.hpp"

namespace ejecta {

namespace {

double limited(double back, double ahead) {
  if (back * ahead <= 0) return 0;
  return std::copysign(std::min({0.5 * std::abs(back + ahead), 2 * std::abs(back), 2 * std::abs(ahead)}), back);
}

}  // namespace

template <int Dim>
CellLines<Dim>::CellLines(const Grid<Dim>& grid, const std::vector<std::size_t>& wanted)
    : box_(grid.box()), place_(box_.size(), -1) {
  std::vector<std::size_t> cells;
  for (const std::size_t i : wanted)
    for_cells_near<Dim>(box_, box_.cell(i), 1, [&](std::size_t j, int) {
      if (place_[j] >= 0) return;
      place_[j] = static_cast<std::int32_t>(cells.size());
      cells.push_back(j);
    });
  lines_.resize(cells.size());
  const Conserved<Dim>& u = grid.cells();
  // Density, velocity, specific energy: an equation of state need not be asked.
  const auto primitives = [&](std::size_t i) {
    std::array<double, values> w{};
    w[0] = u[0][i];
    double squares = 0;
    for (std::size_t a = 0; a < Dim; ++a) {
      w[1 + a] = u[1 + a][i] / w[0];
      squares += w[1 + a] * w[1 + a];
    }
    w[Dim + 1] = u[Dim + 1][i] / w[0] - 0.5 * squares;
    return w;
  };
  parallel_for(0, cells.size(), [&](std::size_t k) {
    Line& line = lines_[k];
    line.middle = primitives(cells[k]);
    const std::array<int, Dim> cell = box_.cell(cells[k]);
    std::array<double, values> room = line.middle;  // what all slopes together may take off
    for (std::size_t a = 0; a < Dim; ++a) {
      std::array<std::array<double, values>, 2> sides;
      for (const int side : {0, 1}) {
        const CellSource source = source_along(box_, a, cell[a] + 2 * side - 1);
        std::array<int, Dim> at = cell;
        at[a] = source.cell;
        auto& w = sides[static_cast<std::size_t>(side)] = primitives(box_.index(at));
        if (source.mirrored) w[1 + a] = -w[1 + a];
      }
      for (std::size_t v = 0; v < values; ++v) {
        line.slope[a][v] = limited(line.middle[v] - sides[0][v], sides[1][v] - line.middle[v]);
        room[v] -= 0.5 * std::abs(line.slope[a][v]);
      }
    }
    if (!(room[0] > 0 && room[Dim + 1] > 0))
      for (auto& slope : line.slope) slope.fill(0);
  });
}

template <int Dim>
PointState<Dim> CellLines<Dim>::at(const Vec<Dim>& x) const {
  const std::size_t cell = cell_of(box_, x);
  std::int32_t place = place_[cell];
  bool far = place < 0;
  for (int radius = 1; place < 0; ++radius) {
    int nearest = std::numeric_limits<int>::max();
    for_cells_near<Dim>(box_, box_.cell(cell), radius, [&](std::size_t j, int squares) {
      if (place_[j] >= 0 && squares < nearest) {
        nearest = squares;
        place = place_[j];
      }
    });
  }
  const Line& line = lines_[static_cast<std::size_t>(place)];
  std::array<double, values> w = line.middle;
  if (!far) {
    const Vec<Dim> middle = box_.centre(box_.cell(cell));
    for (std::size_t a = 0; a < Dim; ++a) {
      const auto k = static_cast<int>(a);
      const double share = std::clamp((x[k] - middle[k]) / box_.spacing, -0.5, 0.5);
      for (std::size_t v = 0; v < values; ++v) w[v] += share * line.slope[a][v];
    }
  }
  PointState<Dim> state{.density = w[0], .velocity = {}, .specific_energy = w[Dim + 1]};
  for (int a = 0; a < Dim; ++a) state.velocity[a] = w[static_cast<std::size_t>(1 + a)];
  return state;
}

template class CellLines<2>;
template class CellLines<3>;

}  // namespace ejecta
