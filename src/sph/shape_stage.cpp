#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/simd.hpp"
#include "schemes/ideal_h.hpp"
#include "schemes/kernels.hpp"
#include "sph/stages.hpp"

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

/// Particles, then ghosts, while they vote.
template <int Dim>
struct Scratch {
  struct Place {
    Vec<Dim> x;
    double material;
  };
  std::vector<Place> places;
  std::vector<ShapeVote<Dim>> votes;
  std::vector<int> neighbours;  ///< of the particles
  std::vector<double> lengths;
  std::size_t bytes() const {
    return lengths.capacity() * sizeof(double) + places.capacity() * sizeof(Place) +
           votes.capacity() * sizeof(ShapeVote<Dim>) + neighbours.capacity() * sizeof(int);
  }
};

/// Where particles and ghosts are, and of what they are made.
template <int Dim>
void place_voters(Sph<Dim>& sph, Scratch<Dim>& scratch) {
  const Particles<Dim>& p = sph.particles;
  const GhostList<Dim>& ghosts = sph.lists.ghosts();
  const std::size_t n = p.size();
  auto& places = scratch.places;
  places.resize(n + ghosts.size());
  scratch.votes.resize(n + ghosts.size());
  scratch.neighbours.resize(n);
  const auto material = p.label(Label::material);
  parallel_for(0, n, [&](std::size_t i) {
    places[i] = {p.vector(Field::position, i), static_cast<double>(material[i])};
  });
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const Ghost& ghost = ghosts.ghosts[k];
    const Transform& seen = ghosts.transform(ghost);
    const Particles<Dim>& owner = ghosts.owner(ghost, p);
    auto& place = places[n + k];
    place = {owner.vector(Field::position, ghost.source),
             static_cast<double>(owner.label(Label::material)[ghost.source])};
    for (int a = 0; a < Dim; ++a) place.x[a] = seen.position(a, place.x[a]);
  }
}

/// Ghosts vote as their sources do, seen in the mirror; guests do not.
template <int Dim>
void mirror_votes(const Sph<Dim>& sph, Scratch<Dim>& scratch) {
  const GhostList<Dim>& ghosts = sph.lists.ghosts();
  const std::size_t n = sph.particles.size();
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const Ghost& ghost = ghosts.ghosts[k];
    auto& vote = scratch.votes[n + k] = ghost.owner == 0 ? scratch.votes[ghost.source] : ShapeVote<Dim>{};
    for (int a = 0; a < Dim; ++a)
      if (ghosts.transform(ghost).mirrors(a)) mirror_symmetric<Dim>(vote.log_covariance.data(), a);
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

  Members(const Scratch<Dim>& scratch, const Cluster& cluster, std::size_t first)
      : begin(first), size(static_cast<int>(std::min<std::size_t>(lanes, cluster.end - first))) {
    for (int k = 0; k < lanes; ++k) {
      const auto& place = scratch.places[begin + static_cast<std::size_t>(std::min(k, size - 1))];
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
void for_members(const Sph<Dim>& sph, const Scratch<Dim>& scratch, std::size_t cluster, Body&& body) {
  const Cluster& c = sph.lists.clusters()[cluster];
  for (std::size_t first = c.begin; first < c.end; first += lanes)
    body(Members<Dim>(scratch, c, first), sph.lists.candidates(cluster));
}

template <int Dim>
void collect_votes(const Sph<Dim>& sph, Scratch<Dim>& scratch, double reach) {
  const double support = kernel_support(sph.scene.numerics.kernel);
  const V infinity = V{} + std::numeric_limits<double>::infinity();
  parallel_blocks(sph.lists.clusters().size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cluster = begin; cluster < end; ++cluster)
      for_members(sph, scratch, cluster, [&](const Members<Dim>& members, std::span<const std::uint32_t> candidates) {
        FirstShells<Dim> shells(sph.scene.numerics.nodes_per_h, support);
        members.for_each(
            [&](int k, std::size_t i) { shells.place(k, sph.particles.symmetric(Field::smoothing_metric, i)); });
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
Round apply_votes(Sph<Dim>& sph, const Scratch<Dim>& scratch, bool sum_neighbours) {
  Particles<Dim>& p = sph.particles;
  const ShapeLimits limits{.largest_aspect = sph.scene.numerics.largest_aspect, .fewest_neighbours = 2 * Dim};
  return parallel_sum<Round>(sph.lists.clusters().size(), [&](std::size_t cluster) {
    Round round;
    for_members(sph, scratch, cluster, [&](const Members<Dim>& members, std::span<const std::uint32_t> candidates) {
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
        if (sum_neighbours) p.column(Field::zeroth_moment)[i] = sum[k];
        round += {{1, actions.kept, actions.change, actions.aspect}, actions.moved};
      });
    });
    return round;
  });
}

template <int Dim>
Round vote(Sph<Dim>& sph, Scratch<Dim>& scratch, bool start) {
  place_voters(sph, scratch);
  collect_votes(sph, scratch, start ? reach_at_start : reach_in_run);
  mirror_votes(sph, scratch);
  return with_kernel(sph.scene.numerics.kernel,
                     [&](auto k) { return apply_votes<Dim, decltype(k)>(sph, scratch, start); });
}

/// One update of the sizes from the sums of the last round. Returns the largest |logarithm| of a factor.
template <int Dim>
double resize(Sph<Dim>& sph, std::vector<double>& before) {
  const auto h = sph.particles.column(Field::smoothing_length);
  before.assign(h.begin(), h.end());
  smoothing_lengths(sph);
  return -parallel_min(h.size(), 0, [&](std::size_t i) { return -std::abs(std::log(h[i] / before[i])); }).value;
}

}  // namespace

template <int Dim>
StageWork<Dim> vote_shapes() {
  const auto kept = std::make_shared<Scratch<Dim>>();
  const auto run = [kept](Sph<Dim>& sph) {
    Scratch<Dim>& scratch = *kept;
    if (sph.clock.step % sph.scene.numerics.shape_interval != 0) return;
    if (sph.clock.step > 0) {
      sph.shape_report += vote(sph, scratch, false).report;
      renew_lists(sph);
      return;
    }
    for (int k = 0; k < rounds_at_start; ++k) {
      double moved = vote(sph, scratch, true).moved;
      if (sph.scene.numerics.smoothing_growth > 1) moved = std::max(moved, resize(sph, scratch.lengths));
      renew_lists(sph);
      if (moved < converged) break;
    }
  };
  return {run, [kept] { return kept->bytes(); }};
}

template StageWork<2> vote_shapes<2>();
template StageWork<3> vote_shapes<3>();

}  // namespace ejecta
