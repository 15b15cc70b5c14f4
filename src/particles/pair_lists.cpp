#include "particles/pair_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/simd.hpp"
#include "particles/smoothing_metric.hpp"

namespace ejecta {

namespace {
constexpr double least_margin = 0.03;  ///< of the support radius: what even a resting particle may move

/// Bonded particles must find the neighbours of the start however far these have been drawn apart.
template <int Dim>
double stretch_of(const Particles<Dim>& particles, std::size_t i) {
  return particles.has(Field::stretch) ? particles.column(Field::stretch)[i] : 1.0;
}
}  // namespace

template <int Dim>
void PairLists<Dim>::build(const Particles<Dim>& particles, const Settings& settings, const Guests<Dim>& guests) {
  support_per_h_ = settings.support;
  make_points(particles, settings, guests);
  make_clusters(particles, settings.cluster_size);
  make_tree();
  // Each block of clusters fills a list of its own, which keeps its memory from build to build.
  const std::size_t blocks = (clusters_.size() + clusters_per_block - 1) / clusters_per_block;
  if (block_lists_.size() < blocks) block_lists_.resize(blocks);
  parallel_blocks(clusters_.size(), clusters_per_block, [&](std::size_t begin, std::size_t end) {
    auto& found = block_lists_[begin / clusters_per_block];
    found.clear();
    for (std::size_t c = begin; c < end; ++c) {
      clusters_[c].list_begin = found.size();
      search(c, found);
      clusters_[c].list_end = found.size();
    }
  });
  total_candidates_ = 0;
  for (const Cluster& c : clusters_) total_candidates_ += c.list_end - c.list_begin;
  built_for_ = particles.size();
}

template <int Dim>
void PairLists<Dim>::make_points(const Particles<Dim>& particles, const Settings& settings, const Guests<Dim>& guests) {
  const std::size_t n = particles.size();
  const auto mass = particles.column(Field::mass);
  const double total_mass = parallel_sum<double>(n, [&](std::size_t i) { return mass[i]; });
  for (int a = 0; a < Dim; ++a) {
    const auto v = particles.column(Field::velocity, a);
    // A face that mirrors does not drift along, and ghosts beyond it move the other way.
    const auto k = static_cast<std::size_t>(a);
    drift_[a] = mirrors(settings.boundary.lower[k]) || mirrors(settings.boundary.upper[k])
                    ? 0.0
                    : parallel_sum<double>(n, [&](std::size_t i) { return mass[i] * v[i]; }) / total_mass;
  }
  const bool tensor = particles.has(Field::smoothing_metric);
  points_.resize(n);
  ellipsoids_.resize(tensor ? n : 0);
  parallel_for(0, n, [&](std::size_t i) {
    points_[i] = point_of(particles, i, settings);
    if (tensor) ellipsoids_[i] = ellipsoid_of(particles, i, points_[i]);
  });
  ghosts_.ghosts.clear();
  if (!settings.boundary.bounded() && guests.empty()) return;
  // A pair may be as far apart as the widest reach of the one and the widest margin of the other.
  double reach = 0, margin = 0;
  for (const Point& p : points_) {
    reach = std::max(reach, p.support + p.margin);
    margin = std::max(margin, p.margin);
  }
  find_ghosts(particles, guests, settings.boundary, reach + margin, ghosts_);
  for (const Ghost& ghost : ghosts_.ghosts) {
    const Transform& seen = ghosts_.transform(ghost);
    const Particles<Dim>& owner = ghosts_.owner(ghost, particles);
    Point p = ghost.owner == 0 ? points_[ghost.source] : point_of(owner, ghost.source, settings);
    if (tensor) {
      Ellipsoid e = ghost.owner == 0 ? ellipsoids_[ghost.source] : ellipsoid_of(owner, ghost.source, p);
      for (int a = 0; a < Dim; ++a)
        if (seen.mirrors(a)) mirror_symmetric<Dim>(e.metric.data(), a);
      ellipsoids_.push_back(e);
    }
    for (int a = 0; a < Dim; ++a) p.x[a] = seen.position(a, p.x[a]);
    points_.push_back(p);
  }
}

template <int Dim>
typename PairLists<Dim>::Point PairLists<Dim>::point_of(const Particles<Dim>& particles, std::size_t i,
                                                        const Settings& settings) const {
  Point p;
  double speed2 = 0;
  for (int a = 0; a < Dim; ++a) {
    p.x[a] = particles.column(Field::position, a)[i];
    const double v = particles.column(Field::velocity, a)[i] - drift_[a];
    speed2 += v * v;
  }
  p.support = settings.support * particles.column(Field::smoothing_length)[i] * stretch_of(particles, i);
  p.margin = least_margin * p.support + std::sqrt(speed2) * settings.horizon;
  return p;
}

template <int Dim>
typename PairLists<Dim>::Ellipsoid PairLists<Dim>::ellipsoid_of(const Particles<Dim>& particles, std::size_t i,
                                                                Point& point) const {
  const Mat<Dim> metric = particles.symmetric(Field::smoothing_metric, i), inverse = metric.inverse();
  const Axes axes = axes_of<Dim>(metric);
  const double stretch = stretch_of(particles, i);
  Ellipsoid e;
  for (int k = 0; k < symmetric_size<Dim>; ++k)
    e.metric[k] = particles.column(Field::smoothing_metric, k)[i] / (stretch * stretch);
  for (int a = 0; a < Dim; ++a) e.extent[a] = support_per_h_ * stretch * std::sqrt(inverse(a, a));
  e.per_length = 1 / (stretch * axes.shortest);
  point.support = support_per_h_ * stretch * axes.longest;
  return e;
}

template <int Dim>
void PairLists<Dim>::make_clusters(const Particles<Dim>& particles, std::size_t cluster_size) {
  clusters_.clear();
  const auto size = static_cast<std::uint32_t>(cluster_size);
  auto cut = [&](std::vector<Cluster>& into, Range range) {
    for (auto i = static_cast<std::uint32_t>(range.begin); i < range.end; i += size)
      into.push_back({i, std::min(i + size, static_cast<std::uint32_t>(range.end))});
  };
  for (Range range : particles.material_ranges()) cut(clusters_, range);
  leaves_ = clusters_;
  cut(leaves_, {particles.size(), points_.size()});
}

template <int Dim>
void PairLists<Dim>::make_tree() {
  auto enclose = [](Node& node, const auto& low, const auto& high, const auto& extent, double support, double margin) {
    for (int a = 0; a < Dim; ++a) {
      node.low[a] = std::min(node.low[a], low[a]);
      node.high[a] = std::max(node.high[a], high[a]);
      node.extent[a] = std::max(node.extent[a], extent[a]);
    }
    node.support = std::max(node.support, support);
    node.margin = std::max(node.margin, margin);
  };
  Node empty;
  empty.low.fill(std::numeric_limits<double>::infinity());
  empty.high.fill(-std::numeric_limits<double>::infinity());

  std::size_t depth = 1;
  for (std::size_t count = leaves_.size(); count > fan_out; count = (count + fan_out - 1) / fan_out) ++depth;
  levels_.resize(depth);
  levels_[0].assign(leaves_.size(), empty);
  parallel_for(0, leaves_.size(), [&](std::size_t c) {
    for (std::size_t i = leaves_[c].begin; i < leaves_[c].end; ++i) {
      std::array<double, Dim> extent;
      extent.fill(points_[i].support);
      enclose(levels_[0][c], points_[i].x, points_[i].x, ellipsoids_.empty() ? extent : ellipsoids_[i].extent,
              points_[i].support, points_[i].margin);
    }
  });
  for (std::size_t level = 1; level < depth; ++level) {
    const auto& below = levels_[level - 1];
    levels_[level].assign((below.size() + fan_out - 1) / fan_out, empty);
    for (std::size_t k = 0; k < below.size(); ++k)
      enclose(levels_[level][k / fan_out], below[k].low, below[k].high, below[k].extent, below[k].support,
              below[k].margin);
  }
}

template <int Dim>
void PairLists<Dim>::search(std::size_t cluster, std::vector<std::uint32_t>& found) const {
  const Node& own = levels_[0][cluster];
  const Cluster& members = clusters_[cluster];
  const bool tensor = !ellipsoids_.empty();
  auto near_node = [&](const Node& node) {
    const double margin = own.margin + node.margin;
    double distance2 = 0;
    for (int a = 0; a < Dim; ++a) {
      const double gap = std::max({0.0, node.low[a] - own.high[a], own.low[a] - node.high[a]});
      if (tensor && gap > std::max(own.extent[a], node.extent[a]) + margin) return false;
      distance2 += gap * gap;
    }
    const double reach = std::max(own.support, node.support) + margin;
    return distance2 < reach * reach;
  };
  constexpr std::size_t lanes = simd::lanes<double>, most_groups = largest_cluster / lanes;
  const std::size_t groups = (members.end - members.begin + lanes - 1) / lanes;
  std::array<simd::Doubles, most_groups> x[Dim], support, margin, metric[symmetric_size<Dim>], per_length;
  for (std::size_t g = 0; g < groups; ++g)
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::size_t i = std::min<std::size_t>(members.begin + lanes * g + k, members.end - 1);
      const Point& p = points_[i];
      for (int a = 0; a < Dim; ++a) x[a][g][k] = p.x[a];
      support[g][k] = p.support;
      margin[g][k] = p.margin;
      if (!tensor) continue;
      for (int s = 0; s < symmetric_size<Dim>; ++s) metric[s][g][k] = ellipsoids_[i].metric[s];
      per_length[g][k] = ellipsoids_[i].per_length;
    }
  auto near_any_member = [&](const Point& q) {
    for (std::size_t g = 0; g < groups; ++g) {
      simd::Doubles distance2{};
      for (int a = 0; a < Dim; ++a) distance2 += (x[a][g] - q.x[a]) * (x[a][g] - q.x[a]);
      const simd::Doubles reach = simd::max(support[g], simd::all<simd::Doubles>(q.support)) + margin[g] + q.margin;
      if (simd::any_less(distance2, reach * reach)) return true;
    }
    return false;
  };
  // |H x| grows by at most |H| times the margin while the lists are in use.
  auto ellipsoids_meet = [&](const Point& q, const Ellipsoid& e) {
    for (std::size_t g = 0; g < groups; ++g) {
      simd::Doubles dx[Dim], own_eta2{}, other_eta2{};
      for (int a = 0; a < Dim; ++a) dx[a] = x[a][g] - q.x[a];
      int s = Dim;
      for (int a = 0; a < Dim; ++a) {
        own_eta2 += metric[a][g] * dx[a] * dx[a];
        other_eta2 += e.metric[a] * dx[a] * dx[a];
        for (int b = a + 1; b < Dim; ++b, ++s) {
          own_eta2 += 2 * metric[s][g] * dx[a] * dx[b];
          other_eta2 += 2 * e.metric[s] * dx[a] * dx[b];
        }
      }
      const simd::Doubles widening = margin[g] + q.margin;
      const simd::Doubles own_reach = support_per_h_ + widening * per_length[g],
                          other_reach = support_per_h_ + widening * e.per_length;
      if (simd::any_less(own_eta2, own_reach * own_reach) || simd::any_less(other_eta2, other_reach * other_reach))
        return true;
    }
    return false;
  };
  auto descend = [&](auto&& self, std::size_t level, std::size_t node) -> void {
    if (!near_node(levels_[level][node])) return;
    if (level > 0) {
      const std::size_t end = std::min((node + 1) * fan_out, levels_[level - 1].size());
      for (std::size_t k = node * fan_out; k < end; ++k) self(self, level - 1, k);
      return;
    }
    for (std::uint32_t j = leaves_[node].begin; j < leaves_[node].end; ++j)
      if (tensor ? ellipsoids_meet(points_[j], ellipsoids_[j]) : near_any_member(points_[j])) found.push_back(j);
  };
  for (std::size_t k = 0; k < levels_.back().size(); ++k) descend(descend, levels_.size() - 1, k);
}

template <int Dim>
bool PairLists<Dim>::valid(const Particles<Dim>& particles, double elapsed) const {
  if (built_for_ != particles.size()) return false;
  // Margin less motion and growth.
  const auto slack = [&](const Particles<Dim>& owner, std::size_t i, std::size_t place) {
    const Point& p = points_[place];
    double moved2 = 0;
    for (int a = 0; a < Dim; ++a) {
      const double d = owner.column(Field::position, a)[i] - p.x[a] - drift_[a] * elapsed;
      moved2 += d * d;
    }
    double grown = 0;
    if (ellipsoids_.empty()) {
      grown =
          std::max(0.0, support_per_h_ * owner.column(Field::smoothing_length)[i] * stretch_of(owner, i) - p.support);
    } else {
      Symmetric<Dim> then;
      for (int k = 0; k < symmetric_size<Dim>; ++k) then[k] = ellipsoids_[place].metric[k];
      const double stretch = stretch_of(owner, i);
      const double out = outgrowth<Dim>(matrix_of<Dim>(then),
                                        Mat<Dim>(owner.symmetric(Field::smoothing_metric, i) / (stretch * stretch)));
      grown = (out - 1) * support_per_h_ / ellipsoids_[place].per_length;
    }
    return p.margin - std::sqrt(moved2) - grown;
  };
  const std::size_t n = particles.size();
  if (parallel_min(n, 0.0, [&](std::size_t i) { return slack(particles, i, i); }).index != n) return false;
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    const Ghost& ghost = ghosts_.ghosts[k];
    if (ghost.owner != 0 && ghost.transform == 0 && slack(ghosts_.owner(ghost, particles), ghost.source, n + k) < 0)
      return false;
  }
  return true;
}

template <int Dim>
double PairLists<Dim>::mean_candidates() const {
  return clusters_.empty() ? 0 : static_cast<double>(total_candidates_) / static_cast<double>(clusters_.size());
}

template <int Dim>
std::size_t PairLists<Dim>::bytes() const {
  std::size_t total = points_.capacity() * sizeof(Point) + ellipsoids_.capacity() * sizeof(Ellipsoid) +
                      ghosts_.bytes() + (clusters_.capacity() + leaves_.capacity()) * sizeof(Cluster);
  for (const auto& level : levels_) total += level.capacity() * sizeof(Node);
  for (const auto& list : block_lists_) total += list.capacity() * sizeof(std::uint32_t);
  return total;
}

template class PairLists<2>;
template class PairLists<3>;

}  // namespace ejecta
