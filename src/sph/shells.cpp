#include "sph/shells.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "scene/shape_geometry.hpp"

namespace ejecta {

namespace {

using std::numbers::pi;

/// Where a shell lies between the faces, and where its mass is.
struct Shell {
  double inner, outer;  ///< m

  double thickness() const { return outer - inner; }  ///< m

  /// Mean of the radius over a shell of a disc or cylinder (rank 2), or of a sphere (rank 3) [m].
  double centroid(int rank) const {
    return rank / (rank + 1.0) * (std::pow(outer, rank + 1) - std::pow(inner, rank + 1)) /
           (std::pow(outer, rank) - std::pow(inner, rank));
  }
};

/// Lays rings one after the other; each has a turn of its own.
class Rings {
 public:
  Rings(bool mirrored, std::uint64_t seed) : mirrored_(mirrored), seed_(seed) {}

  /// About `wanted` particles; four of them or a multiple where planes through the axis mirror them.
  int count(double wanted, int least) const {
    const int step = mirrored_ ? 4 : 1;
    return step * std::max((least + step - 1) / step, static_cast<int>(std::lround(wanted / step)));
  }
  /// The angles of a ring of n.
  std::vector<double> angles(int n) {
    const double turn = random(), phase = mirrored_ ? 0.25 + 0.5 * turn : turn;
    std::vector<double> list;
    for (int k = 0; k < n; ++k) list.push_back(2 * pi * (k + phase) / n);
    return list;
  }
  double random() { return uniform_random(seed_, 0x7368656c6c73, drawn_++); }
  bool mirrored() const { return mirrored_; }

 private:
  bool mirrored_;
  std::uint64_t seed_, drawn_ = 0;
};

/// Two directions at right angles to a third one and each other.
std::pair<Vec<3>, Vec<3>> across(const Vec<3>& axis) {
  const Vec<3> first = axis.unitOrthogonal();
  return {first, axis.cross(first)};
}

void lay_disc_shell(PointCloud<2>& cloud, const Shell& shell, double edge, Rings& rings) {
  const double area = pi * (shell.outer * shell.outer - shell.inner * shell.inner), radius = shell.centroid(2);
  const int n = rings.count(2 * pi * 0.5 * (shell.inner + shell.outer) / edge, 3);
  for (const double angle : rings.angles(n)) {
    const Vec<2> normal(std::cos(angle), std::sin(angle));
    cloud.add(radius * normal, {area / n, shell.thickness(), normal});
  }
}

void lay_cylinder_shell(PointCloud<3>& cloud, const Shell& shell, const CylinderShape& body, double edge,
                        Rings& rings) {
  const double area = pi * (shell.outer * shell.outer - shell.inner * shell.inner), radius = shell.centroid(2);
  const int n = rings.count(2 * pi * 0.5 * (shell.inner + shell.outer) / edge, 3);
  int rows = std::max(1, static_cast<int>(std::lround(body.length / edge)));
  if (rings.mirrored() && rows % 2 == 1) ++rows;
  // With mirrors the axis is along x, y or z, and angles count from another one of them.
  const auto [first, second] = across(body.axis);
  for (int row = 0; row < rows; ++row)
    for (const double angle : rings.angles(n)) {
      const Vec<3> normal = std::cos(angle) * first + std::sin(angle) * second;
      cloud.add(radius * normal + ((row + 0.5) / rows - 0.5) * body.length * body.axis,
                {area * body.length / rows / n, shell.thickness(), normal});
    }
}

void lay_sphere_shell(PointCloud<3>& cloud, const Shell& shell, double edge, Rings& rings) {
  const double radius = shell.centroid(3), middle = 0.5 * (shell.inner + shell.outer);
  const double volume = 4 * pi / 3 * (std::pow(shell.outer, 3) - std::pow(shell.inner, 3));
  Vec<3> pole(0, 0, 1);
  if (!rings.mirrored()) {
    const double z = 2 * rings.random() - 1, turn = 2 * pi * rings.random(), flat = std::sqrt(1 - z * z);
    pole = {flat * std::cos(turn), flat * std::sin(turn), z};
  }
  const auto [first, second] = across(pole);
  int bands = std::max(2, static_cast<int>(std::lround(pi * middle / edge)));
  if (rings.mirrored() && bands % 2 == 1) ++bands;
  for (int b = 0; b < bands; ++b) {
    const double low = pi * b / bands, high = pi * (b + 1) / bands;
    const double share = 0.5 * (std::cos(low) - std::cos(high));
    const int n = rings.count(4 * pi * middle * middle * share / (edge * edge), 3);
    const double height = 0.5 * (std::cos(low) + std::cos(high)), flat = std::sqrt(1 - height * height);
    for (const double angle : rings.angles(n)) {
      const Vec<3> normal = flat * (std::cos(angle) * first + std::sin(angle) * second) + height * pole;
      cloud.add(radius * normal, {volume * share / n, shell.thickness(), normal});
    }
  }
}

}  // namespace

template <int Dim>
PointCloud<Dim> lay_shells(const Body& body, double spacing, bool mirrored, std::uint64_t seed) {
  PointCloud<Dim> cloud;
  Rings rings(mirrored, seed);
  const double wall = body.radius - body.inner_radius;
  const double wanted = spacing * std::pow(body.aspect, 1.0 / Dim - 1);  // thickness of a shell
  const int shells = std::max(1, static_cast<int>(std::lround(wall / wanted)));
  const double edge = std::pow(std::pow(spacing, Dim) * shells / wall, 1.0 / (Dim - 1));
  for (int k = 0; k < shells; ++k) {
    const Shell shell{body.inner_radius + wall * k / shells, body.inner_radius + wall * (k + 1) / shells};
    if constexpr (Dim == 2)
      lay_disc_shell(cloud, shell, edge, rings);
    else if (body.shape == BodyShape::cylinder)
      lay_cylinder_shell(cloud, shell, CylinderShape(body), edge, rings);
    else
      lay_sphere_shell(cloud, shell, edge, rings);
  }
  const Vec<Dim> center = first_components<Dim>(body.center);
  for (Vec<Dim>& x : cloud.points) x += center;
  return cloud;
}

template PointCloud<2> lay_shells<2>(const Body&, double, bool, std::uint64_t);
template PointCloud<3> lay_shells<3>(const Body&, double, bool, std::uint64_t);

}  // namespace ejecta
