#pragma once
/// The geometry of each shape of a body, and the one place that chooses among them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace ejecta {

template <int Dim>
Vec<Dim> first_components(const Triple& t) {
  return Eigen::Map<const Vec<Dim>>(t.data());
}

/// A place [m], moved by whole periods to where it is nearest to the centre of the body: what a body has beyond a
/// periodic face comes in at the other one.
template <int Dim>
Vec<Dim> nearest_image(const Boundary& boundary, const Body& body, const Vec<Dim>& x) {
  Vec<Dim> image = x;
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (!boundary.periodic(k)) continue;
    const double length = boundary.length(k);
    image[a] -= length * std::floor((x[a] - body.center[k]) / length + 0.5);
  }
  return image;
}

/// A length of a body that lies between two faces: along an edge of a box or the axis of a cylinder (rank 1), or the
/// distance from that axis or from the centre (rank 2 or 3).
template <int Dim>
struct Span {
  Mat<Dim> projector;
  int rank;
  double low, high;    ///< m; low is 0 without a hole
  bool whole = false;  ///< between planes that are parallel to a lattice: it holds whole layers
};

/// A shape has, with d the place relative to the centre of the body [m]:
/// - contains(d);
/// - half_extent(): half edges of the smallest axis-parallel box about the centre that holds it [m];
/// - volume() [m^3; m^2 in plane strain];
/// - spans(): of its faces.
template <int Dim>
struct BoxShape {
  explicit BoxShape(const Body& body) : edges(first_components<Dim>(body.size)) {}

  bool contains(const Vec<Dim>& d) const { return (d.array().abs() <= half_extent().array() * (1 + 1e-12)).all(); }
  Vec<Dim> half_extent() const { return 0.5 * edges; }
  double volume() const {
    double product = edges[0];
    for (int a = 1; a < Dim; ++a) product *= edges[a];
    return product;
  }
  std::vector<Span<Dim>> spans() const {
    std::vector<Span<Dim>> list;
    const Mat<Dim> all = Mat<Dim>::Identity();
    for (int a = 0; a < Dim; ++a) list.push_back({all.col(a) * all.col(a).transpose(), 1, 0, 0.5 * edges[a], true});
    return list;
  }

  Vec<Dim> edges;  ///< m
};

/// A sphere or disc, perhaps with a hole.
template <int Dim>
struct RoundShape {
  explicit RoundShape(const Body& body) : radius(body.radius), hole(body.inner_radius) {}

  bool holds(double distance2) const { return distance2 <= radius * radius && distance2 >= hole * hole; }
  bool contains(const Vec<Dim>& d) const { return holds(d.squaredNorm()); }
  Vec<Dim> half_extent() const { return Vec<Dim>::Constant(radius); }
  double area() const { return std::numbers::pi * (radius * radius - hole * hole); }
  double volume() const {
    if (Dim == 2) return area();
    return 4 * std::numbers::pi / 3 * (radius * radius * radius - hole * hole * hole);
  }
  std::vector<Span<Dim>> spans() const { return {{Mat<Dim>::Identity(), Dim, hole, radius}}; }

  double radius, hole;  ///< m
};

struct CylinderShape {
  explicit CylinderShape(const Body& body)
      : section(body), axis(first_components<3>(body.axis).normalized()), length(body.length) {}

  bool contains(const Vec<3>& d) const {
    const double along = d.dot(axis);
    return std::abs(along) <= 0.5 * length && section.holds((d - along * axis).squaredNorm());
  }
  Vec<3> half_extent() const { return Vec<3>::Constant(std::hypot(section.radius, 0.5 * length)); }
  double volume() const { return section.area() * length; }
  std::vector<Span<3>> spans() const {
    const Mat<3> along = axis * axis.transpose();
    const bool parallel = along.diagonal().maxCoeff() > 1 - 1e-14;
    return {{along, 1, 0, 0.5 * length, parallel}, {Mat<3>::Identity() - along, 2, section.hole, section.radius}};
  }

  RoundShape<3> section;
  Vec<3> axis;
  double length;  ///< m
};

/// Calls f with the shape of a body.
template <int Dim, class F>
auto with_shape(const Body& body, F&& f) {
  if constexpr (Dim == 3)
    if (body.shape == BodyShape::cylinder) return f(CylinderShape(body));
  if (body.shape == BodyShape::box || body.shape == BodyShape::rectangle) return f(BoxShape<Dim>(body));
  return f(RoundShape<Dim>(body));
}

}  // namespace ejecta
