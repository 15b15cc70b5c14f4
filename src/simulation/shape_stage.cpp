#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
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
  const auto material = p.label(Label::material);
  parallel_for(0, n, [&](std::size_t i) { places[i] = {p.vector(Field::position, i), material[i]}; });
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

/// Calls body(i, candidates of i) for all particles of a cluster.
template <int Dim, class Body>
void for_members(const Simulation<Dim>& sim, std::size_t cluster, Body&& body) {
  const Cluster& c = sim.lists.clusters()[cluster];
  for (std::size_t i = c.begin; i < c.end; ++i) body(i, sim.lists.candidates(cluster));
}

template <int Dim>
void collect_votes(Simulation<Dim>& sim, double reach) {
  const auto& places = sim.shape_scratch.places;
  const double support = kernel_support(sim.scene.numerics.kernel);
  parallel_blocks(sim.lists.clusters().size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cluster = begin; cluster < end; ++cluster)
      for_members(sim, cluster, [&](std::size_t i, std::span<const std::uint32_t> candidates) {
        FirstShell<Dim> shell(sim.particles.symmetric(Field::smoothing_metric, i), sim.scene.numerics.nodes_per_h,
                              support);
        for (const std::uint32_t j : candidates)
          if (j != i && places[j].material == places[i].material) shell.add(places[j].x - places[i].x);
        sim.shape_scratch.votes[i] = shell.vote(reach);
        sim.shape_scratch.places[i].neighbours = shell.neighbours();
      });
  });
}

/// New shapes from the mean votes; at the start also the sums over the neighbours that sizes are made from.
template <int Dim, class Kernel>
Round apply_votes(Simulation<Dim>& sim, bool sum_neighbours) {
  Particles<Dim>& p = sim.particles;
  const auto& places = sim.shape_scratch.places;
  const auto& votes = sim.shape_scratch.votes;
  const ShapeLimits limits{.largest_aspect = sim.scene.numerics.largest_aspect, .fewest_neighbours = 2 * Dim};
  return parallel_sum<Round>(sim.lists.clusters().size(), [&](std::size_t cluster) {
    Round round;
    for_members(sim, cluster, [&](std::size_t i, std::span<const std::uint32_t> candidates) {
      const Mat<Dim> metric = p.symmetric(Field::smoothing_metric, i);
      VoteMean<Dim> mean;
      mean.add(Kernel::value(0.0), votes[i]);
      double sum = 0;
      for (const std::uint32_t j : candidates) {
        const Vec<Dim> x = places[j].x - places[i].x;
        const double eta2 = x.dot(metric * x);
        if (!(eta2 < Kernel::support * Kernel::support) || j == i) continue;
        const double eta = std::sqrt(eta2);
        if (places[j].material == places[i].material) mean.add(Kernel::value(eta), votes[j]);
        if (eta > 0) sum -= eta * Kernel::slope_over_q(eta, 1 / eta);
      }
      ShapeActions actions;
      const bool keep = mean.empty() || places[i].neighbours < limits.fewest_neighbours;
      p.set_symmetric(Field::smoothing_metric, i, reshaped<Dim>(metric, mean.shrunk(), keep, limits, actions));
      if (sum_neighbours) p.column(Field::neighbour_sum)[i] = sum;
      round += {{1, actions.kept, actions.change, actions.aspect}, actions.moved};
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
