#pragma once
/// The cells of a grid and where they are.
#include <array>
#include <cstddef>

#include "base/types.hpp"
#include "scene/boundary.hpp"

namespace ejecta {

/// Cubes of one size in a box; the first index runs fastest.
template <int Dim>
struct Box {
  std::array<int, Dim> cells{};
  Vec<Dim> corner = Vec<Dim>::Zero();  ///< lowest of the box [m]
  double spacing = 0;                  ///< edge of a cell [m]
  std::array<BoundaryKind, Dim> lower{}, upper{};
  std::array<bool, Dim> grows_lower{}, grows_upper{};  ///< open faces that move out before a wave reaches them

  std::size_t size() const {
    std::size_t n = 1;
    for (const int count : cells) n *= static_cast<std::size_t>(count);
    return n;
  }
  std::size_t index(const std::array<int, Dim>& cell) const {
    std::size_t i = 0;
    for (int a = Dim - 1; a >= 0; --a)
      i = i * static_cast<std::size_t>(cells[static_cast<std::size_t>(a)]) +
          static_cast<std::size_t>(cell[static_cast<std::size_t>(a)]);
    return i;
  }
  std::array<int, Dim> cell(std::size_t index) const {
    std::array<int, Dim> c{};
    for (std::size_t a = 0; a < Dim; ++a) {
      c[a] = static_cast<int>(index % static_cast<std::size_t>(cells[a]));
      index /= static_cast<std::size_t>(cells[a]);
    }
    return c;
  }
  Vec<Dim> centre(const std::array<int, Dim>& cell) const {
    Vec<Dim> x = corner;
    for (int a = 0; a < Dim; ++a) x[a] += (cell[static_cast<std::size_t>(a)] + 0.5) * spacing;
    return x;
  }
  /// m^3; m^2 in plane strain, per metre of depth.
  double cell_volume() const { return Dim == 2 ? spacing * spacing : spacing * spacing * spacing; }
  double face_area() const { return cell_volume() / spacing; }
};

/// Where the state of a cell beyond a face comes from: another cell along the axis, perhaps mirrored.
struct CellSource {
  int cell;
  bool mirrored;
};
template <int Dim>
CellSource source_along(const Box<Dim>& box, std::size_t axis, int cell) {
  const int n = box.cells[axis];
  if (cell >= 0 && cell < n) return {cell, false};
  const BoundaryKind kind = cell < 0 ? box.lower[axis] : box.upper[axis];
  if (kind == BoundaryKind::periodic) return {((cell % n) + n) % n, false};
  if (kind == BoundaryKind::open) return {cell < 0 ? 0 : n - 1, false};
  const int mirrored = cell < 0 ? -1 - cell : 2 * n - 1 - cell;
  return {mirrored < 0 ? 0 : mirrored >= n ? n - 1 : mirrored, true};  // a box of fewer cells than the stencil is wide
}

}  // namespace ejecta
