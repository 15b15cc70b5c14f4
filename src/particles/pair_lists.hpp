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

inline constexpr std::size_t largest_cluster = 16;

struct Cluster {
  std::uint32_t begin, end;                  ///< members: particles begin..end-1, of one material, at most W
  std::size_t list_begin = 0, list_end = 0;  ///< place of its candidates in the list of its block
};

template <int Dim>
class PairLists {
 public:
  struct Settings {
    double support = 2;                              ///< support radius of the kernel in units of h
    std::size_t cluster_size = simd::lanes<double>;  ///< at most largest_cluster
    double horizon = 0;                              ///< time for which lists should stay valid [s]
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
  struct Node {
    std::array<double, Dim> low, high, extent{};  ///< extent: largest half width of a support along each axis
    double support = 0, margin = 0;
  };
  struct Point {
    std::array<double, Dim> x;
    double support, margin;
  };
  /// Reach of a particle with a smoothing tensor.
  struct Ellipsoid {
    std::array<double, symmetric_size<Dim>> metric;  ///< G = H H [1/m^2]
    std::array<double, Dim> extent;                  ///< half of its bounding box at the support [m]
    double per_length;                               ///< 1/shortest semi-axis of |H x| = 1 [1/m]
  };
  void make_points(const Particles<Dim>& particles, const Settings& settings, const Guests<Dim>& guests);
  Point point_of(const Particles<Dim>& particles, std::size_t i, const Settings& settings) const;
  /// And the support of its point.
  Ellipsoid ellipsoid_of(const Particles<Dim>& particles, std::size_t i, Point& point) const;
  void make_clusters(const Particles<Dim>& particles, std::size_t cluster_size);
  void make_tree();
  void search(std::size_t cluster, std::vector<std::uint32_t>& found) const;

  static constexpr std::size_t fan_out = 8;
  std::size_t built_for_ = 0;
  double support_per_h_ = 0;
  std::vector<Point> points_;          ///< particles, then ghosts, as of the time of building
  Vec<Dim> drift_ = Vec<Dim>::Zero();  ///< mean velocity at that time [m/s]
  std::vector<Ellipsoid> ellipsoids_;  ///< of the points; empty with isotropic smoothing
  GhostList<Dim> ghosts_;
  std::vector<Cluster> clusters_;  ///< of particles
  std::vector<Cluster> leaves_;    ///< clusters, then groups of ghosts
  std::vector<std::vector<Node>> levels_;
  static constexpr std::size_t clusters_per_block = 64;
  std::vector<std::vector<std::uint32_t>> block_lists_;  ///< candidates of 64 clusters each
  std::size_t total_candidates_ = 0;
};

}  // namespace ejecta
