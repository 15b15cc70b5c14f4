#include "sph/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/random.hpp"
#include "scene/shape_geometry.hpp"
#include "sph/glass.hpp"

namespace ejecta {

namespace {

/// Lattice vectors and the points of one cell, for cells of volume (points per cell) * spacing^Dim.
/// Hexagonal: triangular lattice in the plane, closest packing (stacking ABAB) in space, both as rectangular cells.
/// A glass starts with one point a cubic cell, drawn from the size of two cells: drawn from one, bonds remember the
/// rows.
template <int Dim>
struct Cell {
  Vec<Dim> edge;
  std::vector<Vec<Dim>> points;  ///< as fractions of the edges
};

template <int Dim>
Cell<Dim> lattice_cell(Lattice lattice, double spacing) {
  if (lattice != Lattice::hexagonal) return {Vec<Dim>::Constant(spacing), {Vec<Dim>::Constant(0.5)}};
  const double root3 = std::numbers::sqrt3;
  if constexpr (Dim == 2) {
    const double a = spacing * std::sqrt(2 / root3);
    return {Vec<2>(a, root3 * a), {Vec<2>(0.25, 0.25), Vec<2>(0.75, 0.75)}};
  } else {
    const double a = spacing * std::pow(2.0, 1.0 / 6);
    const double third = 1.0 / 6;  // rows of the second layer sit a third of a row pair (1/6 of the cell edge) further
    return {Vec<3>(a, root3 * a, std::sqrt(8.0 / 3) * a),
            {Vec<3>(0.25, 0.25, 0.25), Vec<3>(0.75, 0.75, 0.25), Vec<3>(0.75, 0.25 + third, 0.75),
             Vec<3>(0.25, 0.75 + third, 0.75)}};
  }
}

}  // namespace

template <int Dim>
bool inside(const Body& body, const Vec<Dim>& x) {
  const Vec<Dim> d = x - first_components<Dim>(body.center);
  return with_shape<Dim>(body, [&](const auto& shape) { return shape.contains(d); });
}

template <int Dim>
double depth(const Body& body, const Vec<Dim>& x) {
  const Vec<Dim> d = x - first_components<Dim>(body.center);
  double least = std::numeric_limits<double>::infinity();
  for (const Span<Dim>& span : with_shape<Dim>(body, [](const auto& shape) { return shape.spans(); })) {
    const double along = (span.projector * d).norm();
    least = std::min(least, span.high - along);
    if (span.low > 0) least = std::min(least, along - span.low);
  }
  return least;
}

namespace {

/// Scales lengths by `stretch` where they do not hold whole layers. The face of a hole stays where it is.
template <int Dim>
Vec<Dim> stretched(const std::vector<Span<Dim>>& spans, double stretch, const Vec<Dim>& d) {
  Vec<Dim> moved = Vec<Dim>::Zero();
  for (const Span<Dim>& span : spans) {
    const Vec<Dim> across = span.projector * d;
    double factor = span.whole ? 1 : stretch;
    if (span.low > 0) {
      const double before = across.norm(), hole = std::pow(span.low, span.rank);
      const double after =
          std::pow(hole + std::pow(stretch, span.rank) * (std::pow(before, span.rank) - hole), 1.0 / span.rank);
      factor = after / before;
    }
    moved += factor * across;
  }
  return moved;
}

/// The half length along an axis that holds whole layers, or 0.
template <int Dim>
double half_length_of_layers(const std::vector<Span<Dim>>& spans, int axis) {
  for (const Span<Dim>& span : spans)
    if (span.whole && span.projector(axis, axis) > 0.5) return span.high;
  return 0;
}

}  // namespace

template <int Dim>
PointCloud<Dim> fill(const Body& body, double spacing, Lattice lattice, std::uint64_t seed) {
  Cell<Dim> cell = lattice_cell<Dim>(lattice, spacing);
  const Vec<Dim> center = first_components<Dim>(body.center);
  const auto [half, spans] =
      with_shape<Dim>(body, [](const auto& shape) { return std::pair(Vec<Dim>(shape.half_extent()), shape.spans()); });
  Eigen::Matrix<int, Dim, 1> cells;
  int free = Dim;  // directions that may be stretched to make the volume exact
  for (int a = 0; a < Dim; ++a) {
    if (const double layers = half_length_of_layers<Dim>(spans, a); layers > 0) {
      cells[a] = std::max(1, static_cast<int>(std::lround(2 * layers / cell.edge[a])));
      cell.edge[a] = 2 * layers / cells[a];
      --free;
    } else {
      cells[a] = 2 * (static_cast<int>(half[a] / cell.edge[a]) + 1);
    }
  }
  PointCloud<Dim> cloud;
  cloud.volume = cell.edge.prod() / static_cast<double>(cell.points.size());
  const Vec<Dim> corner = center - 0.5 * cells.template cast<double>().cwiseProduct(cell.edge);
  const int depth = Dim == 3 ? cells[Dim - 1] : 1;
  std::uint64_t number = 0;
  for (int k = 0; k < depth; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (Vec<Dim> fraction : cell.points) {
          if (lattice == Lattice::glass)
            for (int a = 0; a < Dim; ++a) fraction[a] = 2 * uniform_random(seed, number, static_cast<std::uint64_t>(a));
          ++number;
          Vec<Dim> index;
          index[0] = i;
          index[1] = j;
          if constexpr (Dim == 3) index[2] = k;
          Vec<Dim> place = index + fraction;
          for (int a = 0; a < Dim; ++a) place[a] = std::fmod(place[a], cells[a]);
          const Vec<Dim> x = corner + place.cwiseProduct(cell.edge);
          if (inside<Dim>(body, x)) cloud.points.push_back(x);
        }
  if (cloud.points.empty()) return cloud;
  if (lattice == Lattice::glass) {
    cloud.volume = volume(body, Dim) / static_cast<double>(cloud.points.size());
    relax<Dim>(cloud.points, body, std::pow(cloud.volume, 1.0 / Dim));
    return cloud;
  }
  // The points kept rarely add up to the volume of a round shape: a ball of 100 cells may be off by a sixth. Growing or
  // shrinking the cloud a little, where it is round, makes it exact.
  const double exact = volume(body, Dim) / static_cast<double>(cloud.points.size());
  const double stretch = free == 0 ? 1 : std::pow(exact / cloud.volume, 1.0 / free);
  for (Vec<Dim>& x : cloud.points) x = center + stretched<Dim>(spans, stretch, x - center);
  cloud.volume = exact;
  return cloud;
}

double volume(const Body& body, int dim) {
  const auto of = [](const auto& shape) { return shape.volume(); };
  return dim == 2 ? with_shape<2>(body, of) : with_shape<3>(body, of);
}

template PointCloud<2> fill<2>(const Body&, double, Lattice, std::uint64_t);
template PointCloud<3> fill<3>(const Body&, double, Lattice, std::uint64_t);
template bool inside<2>(const Body&, const Vec<2>&);
template bool inside<3>(const Body&, const Vec<3>&);
template double depth<2>(const Body&, const Vec<2>&);
template double depth<3>(const Body&, const Vec<3>&);

}  // namespace ejecta
