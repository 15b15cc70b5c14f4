#pragma once
/// Random clouds of particles for tests, and the brute-force answer to who is near whom.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "particles/ghosts.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"
#include "particles/spatial_order.hpp"

namespace ejecta {

/// Evenly distributed numbers in [low, high).
struct Uniform {
  std::mt19937_64 random;
  explicit Uniform(unsigned seed) : random(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
};

/// n particles of mass 1 at rest, ids 0..n-1, one material, in the unit box; h between h_low and h_high.
template <int Dim>
Particles<Dim> random_cloud(std::size_t n, unsigned seed, double h_low, double h_high,
                            std::vector<Field> fields = {Field::smoothing_length}) {
  Uniform uniform(seed);
  Particles<Dim> p;
  p.allocate(n, fields);
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < Dim; ++a) p.column(Field::position, a)[i] = uniform(0, 1);
    p.column(Field::smoothing_length)[i] = uniform(h_low, h_high);
    p.column(Field::mass)[i] = 1;
    p.label(Label::id)[i] = static_cast<std::int32_t>(i);
  }
  p.set_material_ranges({{0, n}});
  return p;
}

template <int Dim>
void sort_in_space(Particles<Dim>& p, std::size_t cluster_size) {
  std::vector<std::uint32_t> order;
  spatial_order(p, cluster_size, order);
  p.reorder(order);
}

/// Partner of particle i: index j and where it (or its image) is.
template <int Dim>
struct Neighbour {
  std::size_t j;
  Vec<Dim> x;
};

/// Gives every particle an ellipsoid of random axes, the longest up to `aspect` times the shortest, of the size of its
/// h.
template <int Dim>
void random_ellipsoids(Particles<Dim>& p, double aspect, unsigned seed) {
  Uniform uniform(seed);
  for (std::size_t i = 0; i < p.size(); ++i) {
    Mat<Dim> m;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) m(a, b) = uniform(-1, 1);
    const Mat<Dim> turn = Eigen::HouseholderQR<Mat<Dim>>(m).householderQ();
    Vec<Dim> axes;
    for (int a = 0; a < Dim; ++a) axes[a] = std::pow(aspect, uniform(-0.5, 0.5));
    axes *= p.column(Field::smoothing_length)[i] / std::pow(axes.prod(), 1.0 / Dim);
    p.set_symmetric(Field::smoothing_metric, i,
                    turn * axes.array().square().inverse().matrix().asDiagonal() * turn.transpose());
  }
}

/// Every particle and every image that reaches particle i or is reached by it, by looking at all of them: within
/// max(support h_i, support h_j), or in the ellipsoid |H x| < support of either where there are smoothing metrics.
template <int Dim>
std::vector<Neighbour<Dim>> all_neighbours(const Particles<Dim>& p, const Boundary& boundary, double support,
                                           std::size_t i) {
  struct Place {
    Vec<Dim> x, sign = Vec<Dim>::Ones();
  };
  std::vector<Neighbour<Dim>> found;
  const auto h = p.column(Field::smoothing_length);
  const Vec<Dim> x = p.vector(Field::position, i);
  for (std::size_t j = 0; j < p.size(); ++j) {
    const auto reached = [&](const Place& place) {
      const Vec<Dim> d = place.x - x;
      if (!p.has(Field::smoothing_metric)) return d.norm() < support * std::max(h[i], h[j]);
      const Vec<Dim> mirrored = place.sign.cwiseProduct(d);
      return std::min(d.dot(p.symmetric(Field::smoothing_metric, i) * d),
                      mirrored.dot(p.symmetric(Field::smoothing_metric, j) * mirrored)) < support * support;
    };
    std::vector<Place> places{{p.vector(Field::position, j)}};
    for (int a = 0; a < Dim; ++a) {
      const auto k = static_cast<std::size_t>(a);
      const double low = boundary.min[k], high = boundary.max[k];
      for (std::size_t place = 0, before = places.size(); place < before; ++place) {
        Place below = places[place], above = places[place];
        const bool periodic = boundary.periodic(k);
        below.x[a] = periodic ? below.x[a] - (high - low) : 2 * low - below.x[a];
        above.x[a] = periodic ? above.x[a] + (high - low) : 2 * high - above.x[a];
        if (!periodic) below.sign[a] = above.sign[a] = -1;
        if (boundary.lower[k] != BoundaryKind::open) places.push_back(below);
        if (boundary.upper[k] != BoundaryKind::open) places.push_back(above);
      }
    }
    for (const Place& place : places)
      if (reached(place)) found.push_back({j, place.x});
  }
  return found;
}

/// Number of neighbours (as above) that the lists fail to name as candidates of their particle.
template <int Dim>
std::size_t missed_neighbours(const Particles<Dim>& p, const PairLists<Dim>& lists, const Boundary& boundary,
                              double support) {
  std::size_t missed = 0;
  for (std::size_t cluster = 0; cluster < lists.clusters().size(); ++cluster) {
    std::vector<std::vector<Vec<Dim>>> offered(p.size());
    for (const std::uint32_t k : lists.candidates(cluster)) {
      if (k < p.size()) {
        offered[k].push_back(p.vector(Field::position, k));
        continue;
      }
      const Ghost& ghost = lists.ghosts().ghosts[k - p.size()];
      Vec<Dim> x = p.vector(Field::position, ghost.source);
      for (int a = 0; a < Dim; ++a) x[a] = lists.ghosts().transform(ghost).position(a, x[a]);
      offered[ghost.source].push_back(x);
    }
    for (std::size_t i = lists.clusters()[cluster].begin; i < lists.clusters()[cluster].end; ++i)
      for (const auto& neighbour : all_neighbours(p, boundary, support, i))
        missed += std::none_of(offered[neighbour.j].begin(), offered[neighbour.j].end(),
                               [&](const Vec<Dim>& x) { return (x - neighbour.x).norm() < 1e-9; });
  }
  return missed;
}

}  // namespace ejecta
