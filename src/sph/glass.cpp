#include "sph/glass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.hpp"
#include "scene/shape_geometry.hpp"

namespace ejecta {

namespace {

constexpr double reach = 2;           ///< of the push, in spacings
constexpr double push = 0.4;          ///< displacement for a sum of 1, in spacings; from 0.6 on the points rattle
constexpr double longest_step = 0.2;  ///< in spacings
constexpr double margin = 0.1;        ///< no point comes nearer to the surface, in spacings
constexpr int sweeps = 40;            ///< the scatter of the density has halved again since the twentieth

/// Points sorted into cubic cells, at least one reach wide; their order within a cell is that of the list.
template <int Dim>
class Cells {
 public:
  Cells(const std::vector<Vec<Dim>>& points, double width)
      : width_(width), low_(points.front()), sorted_(points.size()) {
    Vec<Dim> high = low_;
    for (const Vec<Dim>& x : points) {
      low_ = low_.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    for (int a = 0; a < Dim; ++a) count_[a] = static_cast<int>((high[a] - low_[a]) / width_) + 1;
    start_.assign(static_cast<std::size_t>(count_.prod()) + 1, 0);
    std::vector<std::size_t> cell(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) ++start_[1 + (cell[i] = number(index(points[i])))];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) sorted_[next[cell[i]]++] = points[i];
  }

  /// Calls f(y) for every point in the cell of x and those beside it.
  template <class F>
  void around(const Vec<Dim>& x, F&& f) const {
    const Index low = (index(x).array() - 1).max(0), high = (index(x).array() + 1).min(count_.array() - 1);
    for (Index at = low; at[Dim - 1] <= high[Dim - 1];) {
      const std::size_t row = number(at), end = row + static_cast<std::size_t>(high[0] - low[0]) + 1;
      for (std::size_t k = start_[row]; k < start_[end]; ++k) f(sorted_[k]);
      for (int a = 1; a < Dim && ++at[a] > high[a] && a + 1 < Dim; ++a) at[a] = low[a];
    }
  }

 private:
  using Index = Eigen::Matrix<int, Dim, 1>;
  Index index(const Vec<Dim>& x) const { return ((x - low_) / width_).template cast<int>(); }
  std::size_t number(const Index& at) const {
    std::size_t n = 0;
    for (int a = Dim - 1; a >= 0; --a) n = n * static_cast<std::size_t>(count_[a]) + static_cast<std::size_t>(at[a]);
    return n;
  }

  double width_;
  Vec<Dim> low_;
  Index count_;
  std::vector<std::size_t> start_;
  std::vector<Vec<Dim>> sorted_;
};

/// Adds the images of a list of points across the faces of a span, up to `away` [m] from the body. Length c goes to c'
/// with c'^rank = 2 face^rank - c^rank: shells of equal volume on both sides, so that curved faces do not thin the
/// images.
template <int Dim>
void add_images(std::vector<Vec<Dim>>& list, const Span<Dim>& span, const Vec<Dim>& center, double away) {
  const std::size_t originals = list.size();
  for (std::size_t k = 0; k < originals; ++k) {
    const Vec<Dim> x = list[k], part = span.projector * (x - center);
    const double c = part.norm();
    if (c == 0) continue;
    const auto across = [&](double face) { return 2 * std::pow(face, span.rank) - std::pow(c, span.rank); };
    const double outer = std::pow(across(span.high), 1.0 / span.rank);
    const double inner = std::pow(std::max(across(span.low), 0.0), 1.0 / span.rank);
    if (outer < span.high + away) list.push_back(x + (outer / c - 1) * part);
    if (span.low > 0 && inner > span.low - away) list.push_back(x + (inner / c - 1) * part);
    // The opposite face of an edge.
    if (span.rank == 1 && span.high + c < away) list.push_back(x - (2 * span.high / c + 2) * part);
  }
}

/// The nearest place that is at least `away` [m] within the faces.
template <int Dim>
Vec<Dim> kept_within(const Span<Dim>& span, const Vec<Dim>& center, const Vec<Dim>& x, double away) {
  const Vec<Dim> part = span.projector * (x - center);
  const double c = part.norm(), middle = 0.5 * (span.low + span.high);
  const double least = span.low > 0 ? std::min(span.low + away, middle) : 0, most = std::max(span.high - away, middle);
  return c == 0 ? x : Vec<Dim>(x + (std::clamp(c, least, most) / c - 1) * part);
}

}  // namespace

template <int Dim>
void relax(std::vector<Vec<Dim>>& points, const Body& body, double spacing) {
  const Vec<Dim> center = first_components<Dim>(body.center);
  const std::vector<Span<Dim>> spans = with_shape<Dim>(body, [](const auto& shape) { return shape.spans(); });
  const double range = reach * spacing;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<Vec<Dim>> all = points;
    for (const Span<Dim>& span : spans) add_images(all, span, center, range);
    const Cells<Dim> cells(all, range);
    parallel_for(0, points.size(), [&](std::size_t i) {
      Vec<Dim> step = Vec<Dim>::Zero();
      cells.around(points[i], [&](const Vec<Dim>& y) {
        const Vec<Dim> d = points[i] - y;
        const double r2 = d.squaredNorm();
        if (r2 >= range * range || r2 == 0) return;
        const double r = std::sqrt(r2), w = 1 - r / range;
        step += w * w / r * d;
      });
      step *= push * spacing;
      if (const double length = step.norm(); length > longest_step * spacing) step *= longest_step * spacing / length;
      points[i] += step;
      for (const Span<Dim>& span : spans) points[i] = kept_within(span, center, points[i], margin * spacing);
    });
  }
}

template void relax<2>(std::vector<Vec<2>>&, const Body&, double);
template void relax<3>(std::vector<Vec<3>>&, const Body&, double);

}  // namespace ejecta
