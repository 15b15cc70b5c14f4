#pragma once
/// Particles by the cells that they are in.
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "hybrid/cell_lines.hpp"
#include "hybrid/zone.hpp"
#include "particles/particles.hpp"

namespace ejecta {

/// The way from one place to another [m], across periodic faces where that is shorter: what cells near each other hold
/// may stand at both ends of the box.
template <int Dim>
Vec<Dim> shortest_way(const Box<Dim>& box, const Vec<Dim>& from, const Vec<Dim>& to) {
  Vec<Dim> d = to - from;
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (box.lower[k] != BoundaryKind::periodic) continue;
    const double length = box.cells[k] * box.spacing;
    d[a] -= length * std::round(d[a] / length);
  }
  return d;
}

template <int Dim>
class ParticlesByCell {
 public:
  void sort(const Particles<Dim>& p, const Box<Dim>& box) {
    std::vector<std::uint32_t> cell(p.size());
    first_.assign(box.size() + 1, 0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      cell[i] = static_cast<std::uint32_t>(cell_of(box, p.vector(Field::position, i)));
      ++first_[cell[i] + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    particles_.resize(p.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < p.size(); ++i) particles_[next[cell[i]]++] = static_cast<std::uint32_t>(i);
  }
  std::size_t count(std::size_t cell) const { return first_[cell + 1] - first_[cell]; }
  /// Calls see(index) of all particles in cells up to `radius` cells away along each axis.
  template <class See>
  void for_near(const Box<Dim>& box, std::size_t cell, int radius, See&& see) const {
    for_cells_near<Dim>(box, box.cell(cell), radius, [&](std::size_t near, int) {
      for (std::uint32_t k = first_[near]; k < first_[near + 1]; ++k) see(std::size_t{particles_[k]});
    });
  }

 private:
  std::vector<std::uint32_t> first_, particles_;  ///< those of cell c from first_[c] on
};

}  // namespace ejecta
