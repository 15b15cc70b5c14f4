#pragma once
/// Sets of nodes with a known best H, and the iteration of votes on them without any dynamics.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "schemes/ideal_h.hpp"
#include "schemes/kernels.hpp"
#include "schemes/support_size.hpp"

namespace ejecta {

/// The vote of a single particle.
template <int Dim>
class FirstShell {
 public:
  FirstShell(const Mat<Dim>& metric, double nodes_per_h, double support) : shells_(nodes_per_h, support) {
    shells_.place(0, metric);
  }
  void add(const Vec<Dim>& x) {
    double offset[Dim];
    for (int a = 0; a < Dim; ++a) offset[a] = x[a];
    shells_.add(offset);
  }
  int neighbours() const { return shells_.neighbours(0); }
  ShapeVote<Dim> vote(double reach) { return shells_.vote(0, reach); }

 private:
  FirstShells<Dim, double> shells_;
};

template <int Dim>
struct NodeSet {
  Mat<Dim> box;  ///< columns: the edges of the period; empty space around the set if it is far wider than the nodes
  std::vector<Vec<Dim>> x;
  std::vector<Mat<Dim>> metric;

  /// Deforms space; the metrics follow the flow if they are to.
  void deform(const Mat<Dim>& F, bool metrics_follow) {
    box = F * box;
    for (auto& p : x) p = F * p;
    const Mat<Dim> back = F.inverse();
    if (metrics_follow)
      for (auto& G : metric) G = (back.transpose() * G * back).eval();
  }
};

/// n^Dim cells of a lattice of unit cells of edge 1 with the given nodes in each; each coordinate displaced by up to
/// `jitter` node spacings. Metrics round, of n_h node spacings.
template <int Dim>
NodeSet<Dim> lattice(int n, double nodes_per_h, double jitter = 0,
                     const std::vector<Vec<Dim>>& basis = {Vec<Dim>::Zero()}, const Vec<Dim>& cell = Vec<Dim>::Ones(),
                     unsigned seed = 1) {
  NodeSet<Dim> set;
  set.box = (n * cell).asDiagonal();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double spacing = std::pow(cell.prod() / static_cast<double>(basis.size()), 1.0 / Dim);
  for (int k = 0; k < static_cast<int>(std::pow(n, Dim) + 0.5); ++k)
    for (const Vec<Dim>& b : basis) {
      Vec<Dim> p;
      for (int a = 0, rest = k; a < Dim; ++a, rest /= n) p[a] = (rest % n + b[a]) * cell[a];
      for (int a = 0; a < Dim; ++a) p[a] += jitter * spacing * uniform(random);
      set.x.push_back(p);
    }
  const double h = nodes_per_h * spacing;
  set.metric.assign(set.x.size(), Mat<Dim>::Identity() / (h * h));
  return set;
}

struct VoteSettings {
  Kernel kernel = Kernel::wendland_c2;
  double nodes_per_h = 1.5;
  double reach = 2;
  double largest_aspect = 100;
  double largest_change = 2;
  int fewest_neighbours = 0;
};

/// Calls f(j, x_j - x_i) for every other node, in this period and those next to it.
template <int Dim, class F>
void for_neighbours(const NodeSet<Dim>& set, std::size_t i, F&& f) {
  const Mat<Dim> to_cell = set.box.inverse();
  constexpr int periods = Dim == 2 ? 9 : 27;
  std::array<Vec<Dim>, periods> shifts;
  for (int k = 0; k < periods; ++k) {
    Vec<Dim> shift;
    for (int a = 0, rest = k; a < Dim; ++a, rest /= 3) shift[a] = rest % 3 - 1;
    shifts[k] = set.box * shift;
  }
  for (std::size_t j = 0; j < set.x.size(); ++j) {
    Vec<Dim> cell = to_cell * (set.x[j] - set.x[i]);
    for (int a = 0; a < Dim; ++a) cell[a] -= std::round(cell[a]);
    const Vec<Dim> nearest = set.box * cell;
    for (const Vec<Dim>& shift : shifts)
      if (const Vec<Dim> x = nearest + shift; x.squaredNorm() > 0) f(j, x);
  }
}

/// One round of votes and sizes with kernel K. Returns which limits acted on each node.
template <class K, int Dim>
std::vector<ShapeActions> vote_once(NodeSet<Dim>& set, const VoteSettings& s, const SupportSize& size) {
  const std::size_t n = set.x.size();
  struct Near {
    std::size_t j;
    double eta;
  };
  std::vector<std::vector<Near>> near(n);
  std::vector<ShapeVote<Dim>> votes(n);
  std::vector<int> neighbours(n);
  for (std::size_t i = 0; i < n; ++i) {
    FirstShell<Dim> shell(set.metric[i], s.nodes_per_h, K::support);
    for_neighbours(set, i, [&](std::size_t j, const Vec<Dim>& x) {
      const double eta2 = x.dot(set.metric[i] * x);
      if (!(eta2 < K::support * K::support)) return;
      near[i].push_back({j, std::sqrt(eta2)});
      shell.add(x);
    });
    votes[i] = shell.vote(s.reach);
    neighbours[i] = shell.neighbours();
  }
  std::vector<ShapeActions> actions(n);
  for (std::size_t i = 0; i < n; ++i) {
    VoteMean<Dim> mean;
    mean.add(K::value(0.0), votes[i]);
    double moment = 0;
    for (const Near& m : near[i]) {
      mean.add(K::value(m.eta), votes[m.j]);
      moment -= m.eta * K::slope_over_q(m.eta, 1 / m.eta);
    }
    const ShapeLimits limits{s.largest_aspect, s.largest_change, s.fewest_neighbours};
    const bool keep = mean.empty() || neighbours[i] < limits.fewest_neighbours;
    set.metric[i] = reshaped<Dim>(set.metric[i], mean.shrunk(), keep, limits, actions[i]);
    set.metric[i] /= std::pow(size.growth(moment), 2);
  }
  return actions;
}

/// Several rounds. Returns which limits acted in the last.
template <int Dim>
std::vector<ShapeActions> vote(NodeSet<Dim>& set, const VoteSettings& settings, int rounds = 1) {
  const SupportSize size(settings.kernel, Dim, settings.nodes_per_h);
  std::vector<ShapeActions> actions;
  with_kernel(settings.kernel, [&](auto kernel) {
    for (int k = 0; k < rounds; ++k) actions = vote_once<decltype(kernel)>(set, settings, size);
  });
  return actions;
}

struct Spread {
  double mean = 0, scatter = 0, least = 1e300, most = 0;
};
template <int Dim>
Spread aspects(const NodeSet<Dim>& set) {
  Spread s;
  double sum2 = 0;
  for (const auto& G : set.metric) {
    const double a = aspect<Dim>(G);
    s.mean += a;
    sum2 += a * a;
    s.least = std::min(s.least, a);
    s.most = std::max(s.most, a);
  }
  const double n = static_cast<double>(set.metric.size());
  s.mean /= n;
  s.scatter = std::sqrt(std::max(0.0, sum2 / n - s.mean * s.mean));
  return s;
}

}  // namespace ejecta
