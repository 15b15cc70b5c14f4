#pragma once
#include <algorithm>

#include "grid/tile_sweep.hpp"

namespace ejecta {

/// Copies a box of cells from one arrangement of columns to another.
template <int Dim>
void copy_cells(const Box<Dim>& from_box, const Conserved<Dim>& from, const std::array<int, Dim>& begin,
                const std::array<int, Dim>& count, const Box<Dim>& to_box, Conserved<Dim>& to,
                const std::array<int, Dim>& shift) {
  const int planes = Dim == 3 ? count[Dim - 1] : 1, rows = count[1];
  for (int z = 0; z < planes; ++z)
    for (int y = 0; y < rows; ++y) {
      std::array<int, Dim> cell = begin;
      cell[1] += y;
      if constexpr (Dim == 3) cell[2] += z;
      std::array<int, Dim> target = cell;
      for (std::size_t a = 0; a < Dim; ++a) target[a] += shift[a];
      const std::size_t i = from_box.index(cell), j = to_box.index(target);
      for (std::size_t c = 0; c < from.size(); ++c)
        std::copy_n(from[c].data() + i, count[0], to[c].data() + j);
    }
}

}  // namespace ejecta
