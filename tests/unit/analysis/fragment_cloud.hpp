#pragma once
/// Hand-made particles to find fragments among.
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "analysis/fragments.hpp"

namespace ejecta {

/// Owns the columns of a hand-made cloud.
struct Cloud {
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> mass, density, damage;
  std::array<std::vector<double>, 6> metric;  ///< empty: round
  std::vector<std::int32_t> id, body, material;
  int dimension = 3;
  std::array<PeriodicAxis, 3> box;
  std::vector<std::int32_t> piece_of_body{0, 1, 2};

  void add(Vec<3> position, Vec<3> velocity, double m = 1.0, double d = 1.0, double damaged = 0.0, int label = 0) {
    for (int a = 0; a < 3; ++a) {
      x[a].push_back(position[a]);
      v[a].push_back(velocity[a]);
    }
    mass.push_back(m);
    density.push_back(m / std::pow(d, dimension));
    damage.push_back(damaged);
    id.push_back(static_cast<std::int32_t>(id.size()));
    body.push_back(label);
    material.push_back(label);
  }
  /// Lattice of unit spacing within `radius`, turning rigidly at `spin` about its centre.
  void add_ball(Vec<3> centre, double radius, Vec<3> velocity, Vec<3> spin = Vec<3>::Zero(), int label = 0) {
    const int n = static_cast<int>(radius) + 1, nz = dimension == 3 ? n : 0;
    for (int k = -nz; k <= nz; ++k)
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i) {
          const Vec<3> r(i, j, k);
          if (r.norm() <= radius) add(centre + r, velocity + spin.cross(r), 1.0, 1.0, 0.0, label);
        }
  }
  FragmentInput input() const {
    FragmentInput in;
    for (int a = 0; a < dimension; ++a) {
      in.position[a] = x[a];
      in.velocity[a] = v[a];
    }
    for (std::size_t k = 0; k < 6; ++k) in.smoothing_metric[k] = metric[k];
    in.nodes_per_h = 1.3;
    in.mass = mass;
    in.density = density;
    in.damage = damage;
    in.id = id;
    in.body = body;
    in.material = material;
    in.box = box;
    in.piece_of_body = piece_of_body;
    return in;
  }
};

/// Mixed sizes, damage and clumps of chance.
inline Cloud random_cloud(int dimension, int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Cloud cloud;
  cloud.dimension = dimension;
  const double side = 1.35 * std::pow(n, 1.0 / dimension);
  for (int i = 0; i < n; ++i) {
    const Vec<3> position(side * uniform(random), side * uniform(random), dimension == 3 ? side * uniform(random) : 0);
    const Vec<3> velocity(uniform(random), uniform(random) - 2, dimension == 3 ? uniform(random) : 0);
    cloud.add(position, velocity, 0.5 + uniform(random), std::exp2(2.5 * uniform(random) - 2), uniform(random), i % 3);
  }
  return cloud;
}

}  // namespace ejecta
