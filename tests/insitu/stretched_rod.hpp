#pragma once
/// A made-up frame for the in-situ tests: a rod along x stretched and necked in the middle, with inclined cracks on
/// either side of the neck; its smoothing ellipsoids follow the stretch.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "insitu/pipelines.hpp"
#include "render/ellipsoids.hpp"

namespace ejecta {

constexpr double rod_nodes_per_h = 2, rod_length = 0.03, rod_width = 0.01;  // m, before it is stretched

/// `along` particles along the unstretched rod; `crack` is the largest damage.
template <int Dim>
Particles<Dim> stretched_rod(int along, double crack) {
  const double d = rod_length / along;
  const int across = static_cast<int>(rod_width / d), deep = Dim == 3 ? across : 1;
  Particles<Dim> p;
  p.allocate(static_cast<std::size_t>(along * across * deep),
             std::array{Field::density, Field::smoothing_length, Field::smoothing_metric, Field::damage,
                        Field::damage_tensor});
  for (std::size_t n = 0; n < p.size(); ++n) {
    const int k = static_cast<int>(n);
    Vec<Dim> x;
    x[0] = (k % along - 0.5 * (along - 1)) * d;
    for (int a = 1; a < Dim; ++a) x[a] = ((a == 1 ? k / along % across : k / along / across) - 0.5 * (across - 1)) * d;
    // x' = x + s w tanh(x / w): stretched by 1 + s in the middle; y' = y / sqrt(dx'/dx).
    const double w = 0.2 * rod_length, s = 1.2, ratio = x[0] / w;
    const double slope = 1 + s / (std::cosh(ratio) * std::cosh(ratio)), thin = 1 / std::sqrt(slope);
    Mat<Dim> f = thin * Mat<Dim>::Identity();
    f(0, 0) = slope;
    for (int a = 1; a < Dim; ++a)  // d(thin)/dx y
      f(a, 0) = x[a] * std::pow(slope, -1.5) * s * std::tanh(ratio) / (w * std::cosh(ratio) * std::cosh(ratio));
    const Mat<Dim> inverse = f.inverse() / (rod_nodes_per_h * d);
    const Mat<Dim> metric = inverse.transpose() * inverse;
    Vec<Dim> place = thin * x;
    place[0] = x[0] + s * w * std::tanh(ratio);
    p.set_vector(Field::position, n, place);
    p.set_symmetric(Field::smoothing_metric, n, metric);
    p.column(Field::smoothing_length)[n] = std::pow(metric.determinant(), -0.5 / Dim);
    p.label(Label::id)[n] = k;
    // Two bands of cracks, inclined by 35 degrees to the left and to the right of the neck.
    Vec<Dim> across_crack = Vec<Dim>::Zero();
    const double angle = x[0] < 0 ? 0.6 : -0.6;
    across_crack[0] = std::cos(angle);
    across_crack[Dim - 1] = std::sin(angle);
    const double distance = std::abs(across_crack.dot(place)) - 0.7 * w;
    const double damage = crack * std::exp(-std::pow(distance / (0.3 * w), 2));
    p.set_symmetric(Field::damage_tensor, n, damage * across_crack * across_crack.transpose());
    p.column(Field::damage)[n] = damage;
  }
  return p;
}

inline PipelineSettings rod_settings(const std::string& run_folder, int dimension) {
  PipelineSettings s;
  s.run_folder = run_folder;
  s.channels = {"particles", "slice", "ellipsoids"};
  s.scene_title = "Stretched rod";
  s.dimension = dimension;
  s.view_width = 1.6 * rod_length;
  s.view_height = rod_length;
  s.image_width = 800;
  s.image_height = 600;
  s.time_end = 50e-6;
  s.nodes_per_h = rod_nodes_per_h;
  s.styles = {{"aspect", {"aspect", ColourMap::viridis, ColourRange{1, 4}}},
              {"damage", {"damage", ColourMap::plasma, ColourRange{0, 1}}}};
  return s;
}

}  // namespace ejecta
