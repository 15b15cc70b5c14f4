#pragma once
/// The ideal H: a smoothing tensor whose ellipsoid sees the same number of neighbours along every axis, found from the
/// present neighbours alone (the aim of Owen 2010, section II; by another way, because his eqs. 5-6 do not converge).
#include <array>

#include "base/types.hpp"

namespace ejecta {

/// A vote of one particle on the shape of H: the logarithm of the covariance of its first shell, made unimodular.
/// The shape of H is its inverse square root.
template <int Dim>
struct ShapeVote {
  Symmetric<Dim> log_covariance = Symmetric<Dim>::Zero();  ///< traceless
  double confidence = 0;  ///< 0..1: how much of the surroundings the first shell covers; 0: no vote
  double spacing = 0;     ///< root mean square distance to the first shell per axis, in units of h/n_h
};

/// Collects the neighbours of one particle and votes.
template <int Dim>
class FirstShell {
 public:
  /// `metric` is G = H H of the particle [1/m^2], SPD to round-off; `support` the radius of the kernel in units of h.
  FirstShell(const Mat<Dim>& metric, double nodes_per_h, double support);

  /// A neighbour at offset x = x_j - x_i [m]; any values. What lies outside the support is left out.
  void add(const Vec<Dim>& x);

  /// Neighbours inside the support so far.
  int neighbours() const { return neighbours_; }

  /// `reach`: how far H may look for neighbours along directions in which it has none, relative to the others.
  ShapeVote<Dim> vote(double reach) const;

 private:
  /// Candidates kept for the first shell, the nearest ones; a regular lattice has at most 12 (2D) or 28 (3D).
  static constexpr int capacity_ = Dim == 2 ? 32 : 64;
  struct Candidate {
    Vec<Dim> u;
    double u2;
  };
  void keep(const Candidate& candidate);
  std::array<double, capacity_> unshadowed() const;

  Mat<Dim> metric_, to_nodes_, frame_, frame_inverse_, log_metric_;
  double support2_, reach2_;
  Mat<Dim> around_ = Mat<Dim>::Zero();  ///< sum of n n^T over all neighbours
  int neighbours_ = 0, kept_ = 0;
  std::array<Candidate, capacity_> candidates_;
};

/// Weighted mean of the votes of a particle and its neighbours, and how much to trust it.
template <int Dim>
class VoteMean {
 public:
  /// `weight` is the kernel at the place of the voter.
  void add(double weight, const ShapeVote<Dim>& vote);
  bool empty() const { return !(weight_ > 0); }
  /// The mean logarithm of the covariance, drawn towards round by its own noise.
  Symmetric<Dim> shrunk() const;

 private:
  double weight_ = 0, weight2_ = 0, norm2_ = 0;
  Symmetric<Dim> sum_ = Symmetric<Dim>::Zero(), sum2_ = Symmetric<Dim>::Zero();
};

/// What a new shape must respect.
struct ShapeLimits {
  double largest_aspect;      ///< longest over shortest axis
  double largest_change = 2;  ///< of any axis, as a factor, by one vote
  int fewest_neighbours;      ///< below this the evolved shape stays
};

/// What a new shape came to, and which limits acted.
struct ShapeActions {
  double moved = 0;     ///< largest |logarithm| of the factor of an axis
  bool kept = false;    ///< too few neighbours: no new shape
  bool change = false;  ///< moved only part of the way
  bool aspect = false;  ///< held at the largest aspect
};

/// The metric for the mean vote: G's determinant, the shape of exp(-log_covariance) as far as the limits allow.
/// SPD for every SPD `metric` and finite `log_covariance`. `keep`: too few have voted.
template <int Dim>
Mat<Dim> reshaped(const Mat<Dim>& metric, const Symmetric<Dim>& log_covariance, bool keep, const ShapeLimits& limits,
                  ShapeActions& actions);

/// Longest over shortest axis of the ellipsoid of a metric.
template <int Dim>
double aspect(const Mat<Dim>& metric);

}  // namespace ejecta
