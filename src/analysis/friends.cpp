#include "analysis/friends.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"
#include "particles/smoothing_metric.hpp"

namespace ejecta {

namespace {

/// Sets of particles, each with its shift by box lengths relative to the root of its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n), shift_(n, BoxShift::Zero()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  struct Place {
    std::uint32_t root;
    BoxShift shift;
  };
  Place find(std::uint32_t i) {
    BoxShift shift = BoxShift::Zero();
    while (parent_[i] != i) {
      const std::uint32_t above = parent_[i];
      shift_[i] += shift_[above];
      parent_[i] = parent_[above];
      shift += shift_[i];
      i = parent_[i];
    }
    return {i, shift};
  }
  /// Joins j and the image of i that is moved by `moved` box lengths. The lower index becomes the root, so the sets do
  /// not depend on the order of the calls.
  void join(std::uint32_t i, std::uint32_t j, const BoxShift& moved) {
    const Place a = find(i), b = find(j);
    if (a.root == b.root) return;  // also a piece that meets itself round the box: it stays as it was found
    const BoxShift between = a.shift - b.shift - moved;
    const std::uint32_t upper = std::max(a.root, b.root);
    parent_[upper] = std::min(a.root, b.root);
    shift_[upper] = upper == b.root ? between : BoxShift(-between);
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<BoxShift> shift_;  ///< to the parent
};

/// A cell of one of the grids; `level` counts half octaves of particle size.
struct Cell {
  int level;
  std::array<std::int64_t, 3> index;
};

/// Particles sorted into hashed cells, with what every look at them asks for. Two cells may share a bucket: that only
/// costs a distance check. Blocks of 4 x 4 x 4 cells lie together in memory, so that most looks around a particle do
/// not leave the cache.
class HashedCells {
 public:
  struct Entry {
    Vec<3> place;
    std::uint32_t index;
    int piece;
  };

  HashedCells(const FragmentInput& in, const std::vector<std::uint32_t>& members, const std::vector<Cell>& cell_of)
      : mask_(std::bit_ceil(std::max<std::size_t>(members.size() + 1, 64)) - 1),
        start_(mask_ + 2, 0),
        sorted_(members.size()) {
    for (const std::uint32_t i : members) ++start_[bucket(cell_of[i]) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (const std::uint32_t i : members) sorted_[next[bucket(cell_of[i])]++] = {in.place(i), i, in.piece(i)};
  }
  std::span<const Entry> at(const Cell& cell) const {
    const std::size_t b = bucket(cell);
    return {sorted_.data() + start_[b], start_[b + 1] - start_[b]};
  }

 private:
  std::size_t bucket(const Cell& cell) const {
    std::uint64_t hash = static_cast<std::uint64_t>(cell.level), within = 0;
    for (const std::int64_t index : cell.index) {  // multiply and rotate by odd constants spreads blocks apart
      hash = (hash ^ static_cast<std::uint64_t>(index >> 2)) * 0x9E3779B97F4A7C15ull;
      hash = std::rotl(hash, 29);
      within = within << 2 | static_cast<std::uint64_t>(index & 3);
    }
    return static_cast<std::size_t>((hash ^ (hash >> 32)) << 6 | within) & mask_;
  }
  std::size_t mask_;
  std::vector<std::uint32_t> start_;
  std::vector<Entry> sorted_;
};

/// |x_ij| < b (d_i + d_j) / 2.
class LinkBySpacing {
 public:
  LinkBySpacing(const FragmentInput& in, const std::vector<std::uint32_t>& members, double b) : reach_(in.size()) {
    for (const std::uint32_t i : members) reach_[i] = b * in.particle_size(i);
  }
  /// No link of this particle with one of no larger reach is longer [m].
  double reach(std::size_t i) const { return reach_[i]; }
  bool operator()(std::size_t i, std::size_t j, const Vec<3>& x) const {
    const double link = 0.5 * (reach_[i] + reach_[j]);
    return x.squaredNorm() < link * link;
  }

 private:
  std::vector<double> reach_;
};

/// n_h |H_i x| < b or n_h |H_j x| < b.
class LinkBySupport {
 public:
  LinkBySupport(const FragmentInput& in, const std::vector<std::uint32_t>& members, double b)
      : metric_(in.size()), reach_(in.size()) {
    const double scale = in.nodes_per_h * in.nodes_per_h / (b * b);
    for (const std::uint32_t i : members) {
      metric_[i] = scale * metric_of(in, i);
      reach_[i] = std::sqrt(metric_[i].inverse().diagonal().maxCoeff());
      if (std::isnormal(reach_[i])) continue;
      reach_[i] = b * in.particle_size(i);  // H of a failing run may be broken
      metric_[i] = round_metric<3>(reach_[i]);
    }
  }
  double reach(std::size_t i) const { return reach_[i]; }
  bool operator()(std::size_t i, std::size_t j, const Vec<3>& x) const {
    return x.dot(metric_[i] * x) < 1 || x.dot(metric_[j] * x) < 1;
  }

 private:
  static Mat<3> metric_of(const FragmentInput& in, std::size_t i) {
    const auto& g = in.smoothing_metric;
    if (g[0].empty()) return round_metric<3>(in.smoothing_length[i]);
    if (in.dimension() == 3)
      return matrix_of<3>((Symmetric<3>() << g[0][i], g[1][i], g[2][i], g[3][i], g[4][i], g[5][i]).finished());
    Mat<3> metric =
        Mat<3>::Identity() * std::max(g[0][i], g[1][i]);  // the third axis of the plane is never looked along
    metric.topLeftCorner<2, 2>() << g[0][i], g[2][i], g[2][i], g[1][i];
    return metric;
  }
  std::vector<Mat<3>> metric_;
  std::vector<double> reach_;
};

/// Calls body(position, box lengths moved) for particle i and for those of its images beyond periodic faces that are
/// nearer than `reach` [m] to the box.
template <class Body>
void for_images(const FragmentInput& in, std::size_t i, double reach, Body&& body) {
  const Vec<3> x = in.place(i);
  BoxShift low = BoxShift::Zero(), high = BoxShift::Zero();
  for (int a = 0; a < in.dimension(); ++a) {
    const std::size_t axis = static_cast<std::size_t>(a);
    if (!(in.box[axis].length > 0)) continue;
    low[a] = x[a] > in.box[axis].min + in.box[axis].length - reach ? -1 : 0;
    high[a] = x[a] < in.box[axis].min + reach ? 1 : 0;
  }
  BoxShift moved;
  for (moved[2] = low[2]; moved[2] <= high[2]; ++moved[2])
    for (moved[1] = low[1]; moved[1] <= high[1]; ++moved[1])
      for (moved[0] = low[0]; moved[0] <= high[0]; ++moved[0]) body(in.unwrapped(x, moved), moved);
}

/// Joins all friends among `members`. Each particle looks into the grids of its own and of larger levels, whose cells
/// are at least as wide as any link between the two.
template <class Link>
void join_linked(const FragmentInput& in, const std::vector<std::uint32_t>& members, const Link& linked,
                 DisjointSets& sets) {
  std::vector<Cell> cell_of(in.size());
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : members) smallest = std::min(smallest, linked.reach(i));

  const auto cell_width = [&](int level) { return smallest * std::exp2(0.5 * (level + 1)); };
  const auto cell_at = [&](const Vec<3>& x, int level) {
    // Beyond this many cells neighbours can no longer be told apart in double precision anyway.
    constexpr double far = 1e15;
    Cell cell{level, {0, 0, 0}};
    for (int a = 0; a < in.dimension(); ++a) {
      const double place = std::floor(x[a] / cell_width(level));
      cell.index[static_cast<std::size_t>(a)] =
          static_cast<std::int64_t>(place > -far ? std::min(place, far) : -far);  // NaN goes to -far
    }
    return cell;
  };
  std::vector<int> levels;
  for (const std::uint32_t i : members) {
    const int level = static_cast<int>(2 * std::log2(linked.reach(i) / smallest));
    cell_of[i] = cell_at(in.place(i), level);
    levels.push_back(level);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());

  const HashedCells cells(in, members, cell_of);
  const int depth = in.dimension() == 3 ? 1 : 0;
  struct Pair {
    std::uint32_t i, j;
    BoxShift moved;
  };
  constexpr std::size_t grain = 2048;  // members; who are friends is found by all threads, and joined by one
  std::vector<std::vector<Pair>> pairs((members.size() + grain - 1) / grain);
  const auto look_around = [&](std::uint32_t i, std::vector<Pair>& found) {
    const int piece = in.piece(i);
    for (auto level = std::lower_bound(levels.begin(), levels.end(), cell_of[i].level); level != levels.end();
         ++level) {
      for_images(in, i, cell_width(*level), [&](const Vec<3>& x, const BoxShift& moved) {
        const Cell home = cell_at(x, *level);
        for (int dz = -depth; dz <= depth; ++dz)
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
              for (const HashedCells::Entry& other :
                   cells.at({*level, {home.index[0] + dx, home.index[1] + dy, home.index[2] + dz}})) {
                if (other.index <= i && *level == cell_of[i].level) continue;  // seen from the other
                if (other.piece == piece && linked(i, other.index, other.place - x))
                  found.push_back({i, other.index, moved});
              }
      });
    }
  };
  parallel_blocks(members.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) look_around(members[k], pairs[begin / grain]);
  });
  for (const std::vector<Pair>& found : pairs)
    for (const Pair& pair : found) sets.join(pair.i, pair.j, pair.moved);
}

}  // namespace

Friends join_friends(const FragmentInput& in, const std::vector<std::uint32_t>& members,
                     const FragmentSettings& settings) {
  DisjointSets sets(in.size());
  const bool by_support = settings.link == FragmentLink::support ||
                          (settings.link == FragmentLink::automatic && !in.smoothing_metric[0].empty());
  if (by_support) {
    join_linked(in, members, LinkBySupport(in, members, settings.linking_length), sets);
  } else {
    join_linked(in, members, LinkBySpacing(in, members, settings.linking_length), sets);
  }
  Friends friends{std::vector<std::uint32_t>(in.size()), std::vector<BoxShift>(in.size())};
  for (std::uint32_t i = 0; i < in.size(); ++i) {
    const auto [root, shift] = sets.find(i);
    friends.root[i] = root;
    friends.shift[i] = shift;
  }
  return friends;
}

}  // namespace ejecta
