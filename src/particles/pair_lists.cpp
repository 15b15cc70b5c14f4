#include "particles/pair_lists.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
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

/// Appends first + k for every bit k.
void append(std::vector<std::uint32_t>& list, unsigned bits, std::uint32_t first) {
  for (; bits != 0; bits &= bits - 1) list.push_back(first + static_cast<std::uint32_t>(std::countr_zero(bits)));
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
      tensor_ ? search<true>(c, found) : search<false>(c, found);
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
  tensor_ = particles.has(Field::smoothing_metric);
  const int used = tensor_ ? per_length + 1 : columns_of_all;
  points_.resize(n, used);
  parallel_for(0, n, [&](std::size_t i) { set_point(i, particles, i, settings); });
  ghosts_.ghosts.clear();
  if (!settings.boundary.bounded() && guests.empty()) return;
  // A pair may be as far apart as the widest reach of the one and the widest margin of the other.
  double reach = 0, widest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    reach = std::max(reach, points_(support, i) + points_(margin, i));
    widest = std::max(widest, points_(margin, i));
  }
  find_ghosts(particles, guests, settings.boundary, reach + widest, ghosts_);
  points_.resize(n + ghosts_.size(), used);
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    const Ghost& ghost = ghosts_.ghosts[k];
    const Transform& seen = ghosts_.transform(ghost);
    set_point(n + k, ghosts_.owner(ghost, particles), ghost.source, settings);
    for (int a = 0; a < Dim; ++a) {
      points_(x + a, n + k) = seen.position(a, points_(x + a, n + k));
      if (!tensor_ || !seen.mirrors(a)) continue;
      std::array<double, symmetric_size<Dim>> mirrored;
      for (int s = 0; s < symmetric_size<Dim>; ++s) mirrored[static_cast<std::size_t>(s)] = points_(metric + s, n + k);
      mirror_symmetric<Dim>(mirrored.data(), a);
      for (int s = 0; s < symmetric_size<Dim>; ++s) points_(metric + s, n + k) = mirrored[static_cast<std::size_t>(s)];
    }
  }
}

template <int Dim>
void PairLists<Dim>::set_point(std::size_t place, const Particles<Dim>& owner, std::size_t i,
                               const Settings& settings) {
  double speed2 = 0;
  for (int a = 0; a < Dim; ++a) {
    points_(x + a, place) = owner.column(Field::position, a)[i];
    const double v = owner.column(Field::velocity, a)[i] - drift_[a];
    speed2 += v * v;
  }
  const double stretch = stretch_of(owner, i);
  points_(support, place) = settings.support * owner.column(Field::smoothing_length)[i] * stretch;
  points_(margin, place) = least_margin * points_(support, place) + std::sqrt(speed2) * settings.horizon;
  if (!tensor_) return;
  const Mat<Dim> G = owner.symmetric(Field::smoothing_metric, i), inverse = G.inverse();
  const Axes axes = axes_of<Dim>(G);
  for (int k = 0; k < symmetric_size<Dim>; ++k)
    points_(metric + k, place) = owner.column(Field::smoothing_metric, k)[i] / (stretch * stretch);
  points_(per_length, place) = 1 / (stretch * axes.shortest);
  // The whole ellipsoid may grow by as much as takes its shortest axis over the margin (slack()): its longest by more.
  const double wide = stretch * (settings.support + points_(margin, place) * points_(per_length, place));
  for (int a = 0; a < Dim; ++a) points_(extent + a, place) = wide * std::sqrt(inverse(a, a));
  points_(support, place) = wide * axes.longest;
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
  cut(leaves_, {particles.size(), particles.size() + ghosts_.size()});
}

template <int Dim>
void PairLists<Dim>::make_tree() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::size_t depth = 1;
  for (std::size_t count = leaves_.size(); count > fan_out; count = (count + fan_out - 1) / fan_out) ++depth;
  levels_.resize(depth);
  std::size_t count = leaves_.size();
  for (std::size_t l = 0; l < depth; ++l, count = (count + fan_out - 1) / fan_out) {
    Level& level = levels_[l];
    level.resize(count);
    level.count = count;
    // A node encloses the points of a leaf, or the nodes below.
    const auto enclose = [&](std::size_t node, std::size_t begin, std::size_t end, const auto& below, int below_low,
                             int below_high, int below_extent, int below_support, int below_margin) {
      for (int a = 0; a < Dim; ++a) {
        double least = infinity, most = -infinity, widest = 0;
        for (std::size_t i = begin; i < end; ++i) {
          least = std::min(least, below(below_low + a, i));
          most = std::max(most, below(below_high + a, i));
          if (tensor_) widest = std::max(widest, below(below_extent + a, i));
        }
        level(low + a, node) = least;
        level(high + a, node) = most;
        level(largest_extent + a, node) = widest;
      }
      double reach = 0, motion = 0;
      for (std::size_t i = begin; i < end; ++i) {
        reach = std::max(reach, below(below_support, i));
        motion = std::max(motion, below(below_margin, i));
      }
      level(largest_support, node) = reach;
      level(largest_margin, node) = motion;
    };
    parallel_for(0, count, [&](std::size_t k) {
      if (l == 0) return enclose(k, leaves_[k].begin, leaves_[k].end, points_, x, x, extent, support, margin);
      const Level& below = levels_[l - 1];
      enclose(k, k * fan_out, std::min((k + 1) * fan_out, below.count), below, low, high, largest_extent,
              largest_support, largest_margin);
    });
  }
}

/// As many nodes, or candidates, at a time as a register has lanes.
template <int Dim>
template <bool Tensor>
void PairLists<Dim>::search(std::size_t cluster, std::vector<std::uint32_t>& found) const {
  using V = simd::Doubles;
  constexpr std::size_t lanes = simd::lanes<double>;
  const Level& leaves = levels_[0];
  const Cluster& members = clusters_[cluster];
  const double own_support = leaves(largest_support, cluster), own_margin = leaves(largest_margin, cluster);
  /// Bits of those whose box (or place) may be near the box of the cluster.
  const auto near_box = [&](const auto& boxes, std::size_t first, int box_low, int box_high, int box_extent,
                            int box_support, int box_margin) {
    const V both_margins = boxes.lanes(box_margin, first) + own_margin;
    V distance2{};
    unsigned out = 0;
    for (int a = 0; a < Dim; ++a) {
      const V gap = simd::max(V{}, simd::max(V(boxes.lanes(box_low + a, first) - leaves(high + a, cluster)),
                                             V(leaves(low + a, cluster) - boxes.lanes(box_high + a, first))));
      distance2 += gap * gap;
      if constexpr (Tensor)
        out |= simd::lanes_less(
            V(simd::max(simd::all<V>(leaves(largest_extent + a, cluster)), boxes.lanes(box_extent + a, first)) +
              both_margins),
            gap);
    }
    const V reach = simd::max(simd::all<V>(own_support), boxes.lanes(box_support, first)) + both_margins;
    return simd::lanes_less(distance2, V(reach * reach)) & ~out;
  };
  /// Bits of those that may come within reach of any member; `near`: of those that need be looked at.
  const auto near_members = [&](std::size_t first, unsigned near) {
    unsigned met = 0;
    V place[Dim], other_metric[symmetric_size<Dim>];
    for (int a = 0; a < Dim; ++a) place[a] = points_.lanes(x + a, first);
    const V other_margin = points_.lanes(margin, first);
    if constexpr (Tensor)
      for (int s = 0; s < symmetric_size<Dim>; ++s) other_metric[s] = points_.lanes(metric + s, first);
    for (std::size_t i = members.begin; i < members.end && (near & ~met) != 0; ++i) {
      if constexpr (!Tensor) {
        V distance2{};
        for (int a = 0; a < Dim; ++a) {
          const V dx = points_(x + a, i) - place[a];
          distance2 += dx * dx;
        }
        const V reach = simd::max(simd::all<V>(points_(support, i)), points_.lanes(support, first)) +
                        points_(margin, i) + other_margin;
        met |= simd::lanes_less(distance2, V(reach * reach));
      } else {
        // |H x| grows by at most |H| times the margin while the lists are in use.
        V dx[Dim], own_eta2{}, other_eta2{};
        for (int a = 0; a < Dim; ++a) dx[a] = points_(x + a, i) - place[a];
        for (int a = 0, s = Dim; a < Dim; ++a) {
          own_eta2 += points_(metric + a, i) * dx[a] * dx[a];
          other_eta2 += other_metric[a] * dx[a] * dx[a];
          for (int b = a + 1; b < Dim; ++b, ++s) {
            own_eta2 += 2 * points_(metric + s, i) * dx[a] * dx[b];
            other_eta2 += 2 * other_metric[s] * dx[a] * dx[b];
          }
        }
        const V widening = points_(margin, i) + other_margin;
        const V own_reach = support_per_h_ + widening * points_(per_length, i),
                other_reach = support_per_h_ + widening * points_.lanes(per_length, first);
        met |= simd::lanes_less(own_eta2, V(own_reach * own_reach)) |
               simd::lanes_less(other_eta2, V(other_reach * other_reach));
      }
    }
    return met & near;
  };
  const auto first_bits = [](std::size_t count) { return count >= lanes ? (1u << lanes) - 1 : (1u << count) - 1; };
  const auto take_leaf = [&](std::size_t leaf) {
    for (std::size_t first = leaves_[leaf].begin; first < leaves_[leaf].end; first += lanes) {
      unsigned bits = first_bits(leaves_[leaf].end - first) & near_box(points_, first, x, x, extent, support, margin);
      if (bits != 0) bits = near_members(first, bits);
      append(found, bits, static_cast<std::uint32_t>(first));
    }
  };
  const auto descend = [&](auto&& self, std::size_t l, std::size_t begin, std::size_t end) -> void {
    for (std::size_t first = begin; first < end; first += lanes)
      for (unsigned near = first_bits(end - first) &
                           near_box(levels_[l], first, low, high, largest_extent, largest_support, largest_margin);
           near != 0; near &= near - 1) {
        const std::size_t node = first + static_cast<std::size_t>(std::countr_zero(near));
        if (l == 0)
          take_leaf(node);
        else
          self(self, l - 1, node * fan_out, std::min((node + 1) * fan_out, levels_[l - 1].count));
      }
  };
  descend(descend, levels_.size() - 1, 0, levels_.back().count);
}

template <int Dim>
bool PairLists<Dim>::valid(const Particles<Dim>& particles, double elapsed) const {
  const std::size_t n = particles.size();
  if (built_for_ != n) return false;
  const auto overrun = [&](std::size_t i) { return slack(i, particles, i, elapsed); };
  if (parallel_min(n, 0.0, overrun).index != n) return false;
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    const Ghost& ghost = ghosts_.ghosts[k];
    if (ghost.owner == 0 || ghost.transform != 0) continue;
    if (slack(n + k, ghosts_.owner(ghost, particles), ghost.source, elapsed) < 0) return false;
  }
  return true;
}

template <int Dim>
double PairLists<Dim>::slack(std::size_t place, const Particles<Dim>& owner, std::size_t i, double elapsed) const {
  double moved2 = 0;
  for (int a = 0; a < Dim; ++a) {
    const double d = owner.column(Field::position, a)[i] - points_(x + a, place) - drift_[a] * elapsed;
    moved2 += d * d;
  }
  double grown = 0;
  if (!tensor_) {
    const double now = support_per_h_ * owner.column(Field::smoothing_length)[i] * stretch_of(owner, i);
    grown = std::max(0.0, now - points_(support, place));
  } else {
    Symmetric<Dim> then;
    for (int k = 0; k < symmetric_size<Dim>; ++k) then[k] = points_(metric + k, place);
    const double stretch = stretch_of(owner, i);
    const double out = outgrowth<Dim>(matrix_of<Dim>(then),
                                      Mat<Dim>(owner.symmetric(Field::smoothing_metric, i) / (stretch * stretch)));
    grown = (out - 1) * support_per_h_ / points_(per_length, place);
  }
  return points_(margin, place) - std::sqrt(moved2) - grown;
}

template <int Dim>
double PairLists<Dim>::mean_candidates() const {
  return clusters_.empty() ? 0 : static_cast<double>(total_candidates_) / static_cast<double>(clusters_.size());
}

template <int Dim>
std::size_t PairLists<Dim>::bytes() const {
  std::size_t total = points_.bytes() + ghosts_.bytes() + (clusters_.capacity() + leaves_.capacity()) * sizeof(Cluster);
  for (const auto& level : levels_) total += level.bytes();
  for (const auto& list : block_lists_) total += list.capacity() * sizeof(std::uint32_t);
  return total;
}

template <int Dim>
template <int Columns>
simd::Doubles PairLists<Dim>::Table<Columns>::lanes(int column, std::size_t first) const {
  simd::Doubles values;
  std::memcpy(&values, &columns[static_cast<std::size_t>(column)][first], sizeof values);
  return values;
}

template <int Dim>
template <int Columns>
std::size_t PairLists<Dim>::Table<Columns>::bytes() const {
  std::size_t total = 0;
  for (const auto& column : columns) total += column.capacity() * sizeof(double);
  return total;
}

template class PairLists<2>;
template class PairLists<3>;

}  // namespace ejecta
