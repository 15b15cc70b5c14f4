#pragma once
/// Who may interact with whom. Particles are taken in clusters of W consecutive ones (one per vector lane); the list of
/// a cluster holds every particle or ghost that may come within reach of any of its members while the list is in use.
#include <cstdint>
#include <span>
#include <vector>

#include "base/simd.hpp"
#include "particles/ghosts.hpp"
#include "particles/particles.hpp"

namespace ejecta {

struct Cluster {
  std::uint32_t begin, end;                  ///< members: particles begin..end-1, of one material, at most W
  std::size_t list_begin = 0, list_end = 0;  ///< place of its candidates in the list of its block
};

template <int Dim>
class PairLists {
 public:
  struct Settings {
    double support = 2;  ///< support radius of the kernel in units of h
    std::size_t cluster_size = simd::lanes<double>;
    double horizon = 0;  ///< time for which lists should stay valid [s]
    Boundary boundary;
  };

  /// Builds the lists. Two particles are candidates if r < max(support h_i, support h_j) + margin_i + margin_j, where
  /// the margin of a particle covers its own motion relative to the mean for the horizon: fast or far-flung particles
  /// widen their own search only. With smoothing tensors either ellipsoid may reach the other, |H_i x| < support or
  /// |H_j x| < support, each widened by the margins. The support of bonded particles is drawn out with their bonds.
  void build(const Particles<Dim>& particles, const Settings& settings, const Guests<Dim>& guests = {});

  /// True while no particle and no guest has moved (or grown its support) by more than its margin since the lists were
  /// built at an elapsed time [s] ago. Whoever hands other guests in builds anew.
  bool valid(const Particles<Dim>& particles, double elapsed) const;
  void invalidate() { built_for_ = 0; }
  bool built() const { return built_for_ != 0; }

  const std::vector<Cluster>& clusters() const { return clusters_; }
  std::span<const std::uint32_t> candidates(std::size_t cluster) const {
    const Cluster& c = clusters_[cluster];
    return {block_lists_[cluster / clusters_per_block].data() + c.list_begin, c.list_end - c.list_begin};
  }
  /// Candidate index n + k stands for ghosts().ghosts[k].
  const GhostList<Dim>& ghosts() const { return ghosts_; }
  /// Mean number of candidates per cluster.
  double mean_candidates() const;
  std::size_t bytes() const;

 private:
  /// Numbers of points or nodes, column by column, so that a search tests as many of them at a time as a register has
  /// lanes. Behind the last one there is room for a whole register.
  template <int Columns>
  struct Table {
    std::array<std::vector<double>, Columns> columns;
    void resize(std::size_t n, int used = Columns) {
      const std::size_t needed = n + simd::lanes<double>;
      for (int k = 0; k < used; ++k) {
        auto& column = columns[static_cast<std::size_t>(k)];
        if (column.capacity() < needed) column.reserve(needed + needed / 8);  // ghosts come and go
        column.resize(needed);
      }
    }
    double& operator()(int column, std::size_t i) { return columns[static_cast<std::size_t>(column)][i]; }
    double operator()(int column, std::size_t i) const { return columns[static_cast<std::size_t>(column)][i]; }
    simd::Doubles lanes(int column, std::size_t first) const;
    std::size_t bytes() const;
  };
  /// Columns of a point. Lengths are in m; with smoothing tensors support and extent are as wide as they may become.
  static constexpr int x = 0, support = Dim, margin = support + 1, columns_of_all = margin + 1;
  static constexpr int metric = columns_of_all;                ///< G = H H [1/m^2], with smoothing tensors
  static constexpr int extent = metric + symmetric_size<Dim>;  ///< half of the bounding box of the support
  static constexpr int per_length = extent + Dim;              ///< 1/shortest semi-axis of |H x| = 1 [1/m]
  using Points = Table<per_length + 1>;
  /// Columns of a node: its box, and the largest of what is in it.
  static constexpr int low = 0, high = Dim, largest_extent = 2 * Dim, largest_support = 3 * Dim,
                       largest_margin = largest_support + 1;
  struct Level : Table<largest_margin + 1> {
    std::size_t count = 0;
  };
  void make_points(const Particles<Dim>& particles, const Settings& settings, const Guests<Dim>& guests);
  /// Makes particle i of an owner the point `place`.
  void set_point(std::size_t place, const Particles<Dim>& owner, std::size_t i, const Settings& settings);
  /// Margin of a point less what its particle has moved and grown since the lists were built `elapsed` [s] ago [m].
  double slack(std::size_t place, const Particles<Dim>& owner, std::size_t i, double elapsed) const;
  void make_clusters(const Particles<Dim>& particles, std::size_t cluster_size);
  void make_tree();
  template <bool Tensor>
  void search(std::size_t cluster, std::vector<std::uint32_t>& found) const;

  static constexpr std::size_t fan_out = 8;
  std::size_t built_for_ = 0;
  double support_per_h_ = 0;
  Points points_;                      ///< particles, then ghosts, as of the time of building
  bool tensor_ = false;                ///< whether they have smoothing tensors
  Vec<Dim> drift_ = Vec<Dim>::Zero();  ///< mean velocity at that time [m/s]
  GhostList<Dim> ghosts_;
  std::vector<Cluster> clusters_;  ///< of particles
  std::vector<Cluster> leaves_;    ///< clusters, then groups of ghosts
  std::vector<Level> levels_;      ///< of the tree, from the leaves up
  static constexpr std::size_t clusters_per_block = 64;
  std::vector<std::vector<std::uint32_t>> block_lists_;  ///< candidates of 64 clusters each
  std::size_t total_candidates_ = 0;
};

}  // namespace ejecta
