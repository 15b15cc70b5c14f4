#pragma once
/// What a grid holds, at any point: linear within cells.
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"

namespace ejecta {

/// State at a point.
template <int Dim>
struct PointState {
  double density;          ///< kg/m^3
  Vec<Dim> velocity;       ///< m/s
  double specific_energy;  ///< J/kg
};

/// The states of some cells at one time, with slopes limited by the monotonised central limiter [van Leer 1977].
template <int Dim>
class CellLines {
 public:
  /// Of the cells that are `wanted`, and of those around them.
  CellLines(const Grid<Dim>& grid, const std::vector<std::size_t>& wanted);
  /// At x; that of the nearest cell there is where x has left them.
  PointState<Dim> at(const Vec<Dim>& x) const;

 private:
  static constexpr int values = Dim + 2;
  struct Line {
    std::array<double, values> middle;
    std::array<std::array<double, values>, Dim> slope;  ///< change over a cell
  };
  Box<Dim> box_;
  std::vector<std::int32_t> place_;  ///< in lines_, of every cell of the box; -1: none
  std::vector<Line> lines_;
};

/// Cell that holds x; across mirrors and periods the one there, and the last one beyond open faces.
template <int Dim>
std::size_t cell_of(const Box<Dim>& box, const Vec<Dim>& x) {
  std::array<int, Dim> cell;
  for (std::size_t a = 0; a < Dim; ++a) {
    const auto k = static_cast<int>(a);
    cell[a] = source_along(box, a, static_cast<int>(std::floor((x[k] - box.corner[k]) / box.spacing))).cell;
  }
  return box.index(cell);
}

}  // namespace ejecta
