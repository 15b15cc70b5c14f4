#pragma once
/// Random clouds of particles for tests, and the brute-force answer to who is near whom.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "particles/boundary_images.hpp"
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

/// Every particle and every image within max(support h_i, support h_j) of particle i, by looking at all of them.
template <int Dim>
std::vector<Neighbour<Dim>> all_neighbours(const Particles<Dim>& p, const Boundary& boundary, double support,
                                           std::size_t i) {
  std::vector<Neighbour<Dim>> found;
  const auto h = p.column(Field::smoothing_length);
  const Vec<Dim> x = p.vector(Field::position, i);
  for (std::size_t j = 0; j < p.size(); ++j) {
    const double reach = support * std::max(h[i], h[j]);
    std::vector<Vec<Dim>> places{p.vector(Field::position, j)};
    for (int a = 0; a < Dim; ++a) {
      const auto k = static_cast<std::size_t>(a);
      if (boundary.kind[k] == BoundaryKind::open) continue;
      const double low = boundary.min[k], high = boundary.max[k];
      for (std::size_t place = 0, before = places.size(); place < before; ++place) {
        Vec<Dim> below = places[place], above = places[place];
        const bool periodic = boundary.kind[k] == BoundaryKind::periodic;
        below[a] = periodic ? below[a] - (high - low) : 2 * low - below[a];
        above[a] = periodic ? above[a] + (high - low) : 2 * high - above[a];
        places.push_back(below);
        places.push_back(above);
      }
    }
    for (const Vec<Dim>& place : places)
      if ((place - x).norm() < reach) found.push_back({j, place});
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
      const Image& image = lists.images()[k - p.size()];
      Vec<Dim> x = p.vector(Field::position, image.source);
      for (int a = 0; a < Dim; ++a)
        if (boundary.kind[static_cast<std::size_t>(a)] != BoundaryKind::open)
          x[a] = image_position(boundary, image, a, x[a]);
      offered[image.source].push_back(x);
    }
    for (std::size_t i = lists.clusters()[cluster].begin; i < lists.clusters()[cluster].end; ++i)
      for (const auto& neighbour : all_neighbours(p, boundary, support, i))
        missed += std::none_of(offered[neighbour.j].begin(), offered[neighbour.j].end(),
                               [&](const Vec<Dim>& x) { return (x - neighbour.x).norm() < 1e-9; });
  }
  return missed;
}

}  // namespace ejecta
