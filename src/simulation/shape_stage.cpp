#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/simd.hpp"
#include "schemes/kernels.hpp"
#include "simulation/stages.hpp"

namespace ejecta {

namespace {

constexpr double reach_in_run = 2, reach_at_start = 4;  ///< FirstShell::vote
constexpr int rounds_at_start = 30;
constexpr double converged = 1e-6;  ///< largest relative change of an axis in the last round

/// What a round of votes did.
struct Round {
  ShapeReport report;
  double moved = 0;
  Round& operator+=(const Round& o) {
    report += o.report;
    moved = std::max(moved, o.moved);
    return *this;
  }
};

/// Where particles and their images are, and of what they are made.
template <int Dim>
void place_voters(Simulation<Dim>& sim) {
  const Particles<Dim>& p = sim.particles;
  const auto& images = sim.lists.images();
  const std::size_t n = p.size();
  auto& places = sim.shape_scratch.places;
  places.resize(n + images.size());
  sim.shape_scratch.votes.resize(n + images.size());
  sim.shape_scratch.neighbours.resize(n);
  const auto material = p.label(Label::material);
  parallel_for(0, n, [&](std::size_t i) {
    places[i] = {p.vector(Field::position, i), static_cast<double>(material[i])};
  });
  for (std::size_t k = 0; k < images.size(); ++k) {
    auto& place = places[n + k] = places[images[k].source];
    for (int a = 0; a < Dim; ++a) place.x[a] = image_position(sim.scene.boundary, images[k], a, place.x[a]);
  }
}

/// Images vote as their sources do, seen in the mirror.
template <int Dim>
void mirror_votes(Simulation<Dim>& sim) {
  const auto& images = sim.lists.images();
  const std::size_t n = sim.particles.size();
  for (std::size_t k = 0; k < images.size(); ++k) {
    auto& vote = sim.shape_scratch.votes[n + k] = sim.shape_scratch.votes[images[k].source];
    for (int a = 0; a < Dim; ++a)
      if (images[k].mirror[a] != 0) mirror_symmetric<Dim>(vote.log_covariance.data(), a);
  }
}

using V = simd::Doubles;
constexpr int lanes = simd::lanes<double>;

/// Particles of a cluster, one in each lane; lanes beyond its end repeat the last one.
template <int Dim>
struct Members {
  std::size_t begin;
  int size;
  V x[Dim], material;

  Members(const Simulation<Dim>& sim, const Cluster& cluster, std::size_t first)
      : begin(first), size(static_cast<int>(std::min<std::size_t>(lanes, cluster.end - first))) {
    for (int k = 0; k < lanes; ++k) {
      const auto& place = sim.shape_scratch.places[begin + static_cast<std::size_t>(std::min(k, size - 1))];
      for (int a = 0; a < Dim; ++a) x[a][k] = place.x[a];
      material[k] = place.material;
    }
  }
  /// Calls body(lane, particle).
  template <class Body>
  void for_each(Body&& body) const {
    for (int k = 0; k < size; ++k) body(k, begin + static_cast<std::size_t>(k));
  }
};

/// Calls body(members, candidates) for all particles of a cluster.
template <int Dim, class Body>
void for_members(const Simulation<Dim>& sim, std::size_t cluster, Body&& body) {
  const Cluster& c = sim.lists.clusters()[cluster];
  for (std::size_t first = c.begin; first < c.end; first += lanes)
    body(Members<Dim>(sim, c, first), sim.lists.candidates(cluster));
}

template <int Dim>
void collect_votes(Simulation<Dim>& sim, double reach) {
  auto& scratch = sim.shape_scratch;
  const double support = kernel_support(sim.scene.numerics.kernel);
  const V infinity = V{} + std::numeric_limits<double>::infinity();
  parallel_blocks(sim.lists.clusters().size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cluster = begin; cluster < end; ++cluster)
      for_members(sim, cluster, [&](const Members<Dim>& members, std::span<const std::uint32_t> candidates) {
        FirstShells<Dim> shells(sim.scene.numerics.nodes_per_h, support);
        members.for_each(
            [&](int k, std::size_t i) { shells.place(k, sim.particles.symmetric(Field::smoothing_metric, i)); });
        for (const std::uint32_t j : candidates) {
          const auto& place = scratch.places[j];
          V dx[Dim];
          for (int a = 0; a < Dim; ++a) dx[a] = place.x[a] - members.x[a];
          shells.add(dx, members.material == simd::all<V>(place.material) ? V{} : infinity);
        }
        members.for_each([&](int k, std::size_t i) {
          scratch.votes[i] = shells.vote(k, reach);
          scratch.neighbours[i] = shells.neighbours(k);
        });
      });
  });
}

/// New shapes from the mean votes; at the start also the sums over the neighbours that sizes are made from.
template <int Dim, class Kernel>
Round apply_votes(Simulation<Dim>& sim, bool sum_neighbours) {
  Particles<Dim>& p = sim.particles;
  const auto& scratch = sim.shape_scratch;
  const ShapeLimits limits{.largest_aspect = sim.scene.numerics.largest_aspect, .fewest_neighbours = 2 * Dim};
  return parallel_sum<Round>(sim.lists.clusters().size(), [&](std::size_t cluster) {
    Round round;
    for_members(sim, cluster, [&](const Members<Dim>& members, std::span<const std::uint32_t> candidates) {
      V metric[symmetric_size<Dim>] = {};
      members.for_each([&](int k, std::size_t i) {
        for (int s = 0; s < symmetric_size<Dim>; ++s) metric[s][k] = p.column(Field::smoothing_metric, s)[i];
      });
      VoteMean<Dim, V> mean;
      V sum{};
      for (const std::uint32_t j : candidates) {
        const auto& place = scratch.places[j];
        V dx[Dim], image[Dim];
        for (int a = 0; a < Dim; ++a) dx[a] = place.x[a] - members.x[a];
        const V eta2 = quadratic_form<Dim>(metric, dx, image);
        if (!simd::any_less(eta2, V{} + Kernel::support * Kernel::support)) continue;
        const V reciprocal = simd::reciprocal_sqrt(V(eta2 + 1e-200)), eta = eta2 * reciprocal;
        mean.add(members.material == simd::all<V>(place.material) ? Kernel::value(eta) : V{}, scratch.votes[j]);
        if (sum_neighbours) sum -= eta * Kernel::slope_over_q(eta, reciprocal);
      }
      members.for_each([&](int k, std::size_t i) {
        ShapeActions actions;
        if (p.has(Field::bond) && p.column(Field::bond)[i] > 0) return;
        const bool keep = mean.empty(k) || scratch.neighbours[i] < limits.fewest_neighbours;
        const Mat<Dim> before = p.symmetric(Field::smoothing_metric, i);
        p.set_symmetric(Field::smoothing_metric, i, reshaped<Dim>(before, mean.shrunk(k), keep, limits, actions));
        if (sum_neighbours) p.column(Field::neighbour_sum)[i] = sum[k];
        round += {{1, actions.kept, actions.change, actions.aspect}, actions.moved};
      });
    });
    return round;
  });
}

template <int Dim>
Round vote(Simulation<Dim>& sim, bool start) {
  place_voters(sim);
  collect_votes(sim, start ? reach_at_start : reach_in_run);
  mirror_votes(sim);
  return with_kernel(sim.scene.numerics.kernel, [&](auto k) { return apply_votes<Dim, decltype(k)>(sim, start); });
}

/// One update of the sizes from the sums of the last round. Returns the largest |logarithm| of a factor.
template <int Dim>
double resize(Simulation<Dim>& sim) {
  const auto h = sim.particles.column(Field::smoothing_length);
  auto& before = sim.shape_scratch.lengths;
  before.assign(h.begin(), h.end());
  smoothing_lengths(sim);
  return -parallel_min(h.size(), 0, [&](std::size_t i) { return -std::abs(std::log(h[i] / before[i])); }).value;
}

}  // namespace

template <int Dim>
void vote_shapes(Simulation<Dim>& sim) {
  if (sim.clock.step % sim.scene.numerics.shape_interval != 0) return;
  if (sim.clock.step > 0) {
    sim.shape_report += vote(sim, false).report;
    renew_lists(sim);
    return;
  }
  for (int k = 0; k < rounds_at_start; ++k) {
    double moved = vote(sim, true).moved;
    if (sim.scene.numerics.smoothing_growth > 1) moved = std::max(moved, resize(sim));
    renew_lists(sim);
    if (moved < converged) break;
  }
}

template void vote_shapes<2>(Simulation<2>&);
template void vote_shapes<3>(Simulation<3>&);

}  // namespace ejecta
