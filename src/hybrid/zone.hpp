#pragma once
/// Where the particles of a hybrid are.
#include <cmath>
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"
#include "hybrid/hybrid_settings.hpp"

namespace ejecta {

/// Particles come where no other one is nearer than this share of the mean of their spacings.
inline constexpr double room_for_particles = 0.9;

/// What a cell is to the particles: nothing; filled with particles that the grid leads, so that those further in have
/// neighbours, the rim of them without all of their own; or filled with particles that move freely, and whose gas the
/// cell follows.
enum class Part : std::uint8_t { grid, rim, led, active };

template <int Dim>
class Zone {
 public:
  /// `reach`: cells that particles see. There are twice as many around the active ones.
  Zone(const HybridSettings& settings, double reach)
      : settings_(settings),
        inner_(static_cast<int>(std::ceil(reach))),
        depth_(static_cast<int>(std::ceil(2 * reach))) {}

  /// Around the fronts that are there now, and these cells, in which solids are.
  void update(const Grid<Dim>& grid, const std::vector<std::size_t>& solids);
  /// From now on these cells are active and no others, whatever there is: for tests.
  void hold(std::vector<char> active) { held_ = std::move(active); }
  /// The same zone in a box that has grown.
  void follow(const Box<Dim>& before, const Box<Dim>& now);

  /// Cells of led particles around the active ones.
  int depth() const { return depth_; }
  Part operator[](std::size_t cell) const { return parts_[cell]; }
  bool covered(std::size_t cell) const { return parts_[cell] != Part::grid; }
  std::size_t count(Part part) const;
  std::vector<Part>& parts() { return parts_; }
  const std::vector<Part>& parts() const { return parts_; }

 private:
  std::vector<std::uint8_t> near_fronts(const Grid<Dim>& grid, const std::vector<std::size_t>& solids) const;

  HybridSettings settings_;
  int inner_, depth_;  ///< cells of led particles, without and with the rim
  std::vector<char> held_;
  std::vector<Part> parts_;
};

/// Calls see(index, squared distance in cells) of all cells up to `radius` cells away along each axis, across periodic
/// faces but not behind others.
template <int Dim, class See>
void for_cells_near(const Box<Dim>& box, const std::array<int, Dim>& cell, int radius, See&& see) {
  std::array<int, Dim> offset;
  offset.fill(-radius);
  for (bool more = true; more;) {
    std::array<int, Dim> at{};
    int squares = 0;
    bool there = true;
    for (std::size_t a = 0; a < Dim; ++a) {
      at[a] = cell[a] + offset[a];
      squares += offset[a] * offset[a];
      if (box.lower[a] == BoundaryKind::periodic)
        at[a] = (at[a] % box.cells[a] + box.cells[a]) % box.cells[a];
      else
        there = there && at[a] >= 0 && at[a] < box.cells[a];
    }
    if (there) see(box.index(at), squares);
    std::size_t a = 0;
    while (a < Dim && ++offset[a] > radius) offset[a++] = -radius;
    more = a < Dim;
  }
}

}  // namespace ejecta
