#include "hybrid/restriction.hpp"

#include <cmath>

#include "hybrid/solids.hpp"

namespace ejecta {

namespace {

/// A square along one axis, or its image.
struct Extent {
  double low, high;  ///< in cells from the corner of the box
  double sign;       ///< of the velocity along the axis
};

}  // namespace

template <int Dim>
std::vector<Restricted<Dim>> restrict_particles(const Particles<Dim>& p, const Box<Dim>& box,
                                                const std::vector<std::int32_t>& place, std::size_t cells) {
  std::vector<Restricted<Dim>> all(cells);
  const auto mass = p.column(Field::mass), density = p.column(Field::density),
             energy = p.column(Field::specific_energy);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double edge = (Dim == 2 ? std::sqrt(mass[i] / density[i]) : std::cbrt(mass[i] / density[i])) / box.spacing;
    const Vec<Dim> v = p.vector(Field::velocity, i);
    const bool wall = is_image(p, i);
    std::array<std::array<Extent, 3>, Dim> extents;
    std::array<int, Dim> counts;
    for (std::size_t a = 0; a < Dim; ++a) {
      const double x =
          (p.column(Field::position, static_cast<int>(a))[i] - box.corner[static_cast<int>(a)]) / box.spacing;
      const double n = box.cells[a], low = x - 0.5 * edge, high = x + 0.5 * edge;
      int count = 0;
      extents[a][static_cast<std::size_t>(count++)] = {low, high, 1};
      if (box.lower[a] == BoundaryKind::periodic) {
        if (low < 0) extents[a][static_cast<std::size_t>(count++)] = {low + n, high + n, 1};
        if (high > n) extents[a][static_cast<std::size_t>(count++)] = {low - n, high - n, 1};
      } else {
        if (low < 0 && mirrors(box.lower[a])) extents[a][static_cast<std::size_t>(count++)] = {-high, -low, -1};
        if (high > n && mirrors(box.upper[a]))
          extents[a][static_cast<std::size_t>(count++)] = {2 * n - high, 2 * n - low, -1};
      }
      counts[a] = count;
    }
    const double total = energy[i] + 0.5 * v.squaredNorm();
    std::array<int, Dim> image{};
    for (bool more = true; more;) {
      std::array<int, Dim> first, last, cell;
      for (std::size_t a = 0; a < Dim; ++a) {
        const Extent& e = extents[a][static_cast<std::size_t>(image[a])];
        cell[a] = first[a] = std::max(0, static_cast<int>(std::floor(e.low)));
        last[a] = std::min(box.cells[a] - 1, static_cast<int>(std::ceil(e.high)) - 1);
      }
      bool any = true;
      for (std::size_t a = 0; a < Dim; ++a) any = any && first[a] <= last[a];
      while (any) {
        if (const std::int32_t at = place[box.index(cell)]; at >= 0) {
          double overlap = 1;
          for (std::size_t a = 0; a < Dim; ++a) {
            const Extent& e = extents[a][static_cast<std::size_t>(image[a])];
            overlap *= std::min<double>(e.high, cell[a] + 1) - std::max<double>(e.low, cell[a]);
          }
          Restricted<Dim>& r = all[static_cast<std::size_t>(at)];
          const double part = wall ? 0 : overlap * density[i];
          r.volume += overlap;
          if (wall) r.solid += overlap;
          r.sum[0] += part;
          for (std::size_t a = 0; a < Dim; ++a)
            r.sum[1 + a] += part * extents[a][static_cast<std::size_t>(image[a])].sign * v[static_cast<int>(a)];
          r.sum[Dim + 1] += part * total;
        }
        std::size_t a = 0;
        while (a < Dim && ++cell[a] > last[a]) {
          cell[a] = first[a];
          ++a;
        }
        any = a < Dim;
      }
      std::size_t a = 0;
      while (a < Dim && ++image[a] == counts[a]) image[a++] = 0;
      more = a < Dim;
    }
  }
  return all;
}

template std::vector<Restricted<2>> restrict_particles<2>(const Particles<2>&, const Box<2>&,
                                                          const std::vector<std::int32_t>&, std::size_t);
template std::vector<Restricted<3>> restrict_particles<3>(const Particles<3>&, const Box<3>&,
                                                          const std::vector<std::int32_t>&, std::size_t);

}  // namespace ejecta
