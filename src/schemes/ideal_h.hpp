#pragma once
/// The ideal H: a smoothing tensor whose ellipsoid sees the same number of neighbours along every axis, found from the
/// present neighbours alone (the aim of Owen 2010, section II; by another way, because his eqs. 5-6 do not converge).
///
/// Why it works. Smoothed over many neighbours a uniform body looks uniform in every affine frame: a second moment with
/// a smooth weight knows nothing of shape, and what little it says comes from the gap between first and second
/// neighbours. So each particle
/// 1. singles out its true first shell: a neighbour behind another (beyond the plane through that one) is not in it. A
///    free surface completes the shell by its mirror image. Its plain covariance M then answers a strain F exactly, as
///    F M F^T, as long as the shell is right;
/// 2. takes the mean of the logarithms of its neighbours' votes, weighted by the kernel. Without the mean 10 % disorder
///    reaches aspects that fail the band of single particles, and surfaces are not round;
/// 3. draws the mean towards round by its own variance, A |A|^2/(|A|^2 + 3 var): exactly nothing on a perfect lattice,
///    nearly nothing where anisotropy stands out, and nearly all of it where there is only noise;
/// 4. chooses the shell in the frame H~^s, s = 1 - 0.1 ln(aspect) (at least 1/2; H~ unimodular). With s = 1 the shell
///    would be affine invariant: in endless shear every H that moves with the flow would be a perfect answer. With s =
///    0 stretched and disordered sets are taken for round ones.
/// docs/pair_pass.md has figures.
#include <array>

#include "base/simd.hpp"
#include "base/types.hpp"
#include "schemes/lane_algebra.hpp"

namespace ejecta {

/// s : t of two symmetric tensors.
template <int Dim>
double symmetric_product(const Symmetric<Dim>& s, const Symmetric<Dim>& t) {
  constexpr int off = symmetric_size<Dim> - Dim;
  return s.dot(t) + s.template tail<off>().dot(t.template tail<off>());
}

/// A vote of one particle on the shape of H: the logarithm of the covariance of its first shell, made unimodular.
/// The shape of H is its inverse square root.
template <int Dim>
struct ShapeVote {
  Symmetric<Dim> log_covariance = Symmetric<Dim>::Zero();  ///< traceless
  double confidence = 0;  ///< 0..1: how much of the surroundings the first shell covers; 0: no vote
  double spacing = 0;     ///< root mean square distance to the first shell per axis, in units of h/n_h
};

/// Collects the neighbours of some particles, one in each lane of V (double or simd::Doubles), and lets each vote.
template <int Dim, class V = simd::Doubles>
class FirstShells {
 public:
  static constexpr int lanes = std::is_same_v<V, double> ? 1 : simd::lanes<double>;

  /// `support`: radius of the kernel in units of h.
  FirstShells(double nodes_per_h, double support);

  /// A particle with the metric G = H H [1/m^2], SPD to round-off.
  void place(int lane, const Mat<Dim>& metric);

  /// A neighbour at offset x = x_j - x_i [m] from each lane; any values. What lies outside the support is left out;
  /// `apart` is 0 in lanes that it concerns and infinite in others.
  void add(const V (&x)[Dim], V apart = {});

  /// Neighbours inside the support so far.
  int neighbours(int lane) const { return static_cast<int>(simd::lane(neighbours_, lane)); }

  /// `reach`: how far H may look for neighbours along directions in which it has none, relative to the others.
  ShapeVote<Dim> vote(int lane, double reach);

 private:
  /// Candidates kept for a first shell, the nearest ones; a regular lattice has at most 12 (2D) or 28 (3D).
  static constexpr int capacity_ = Dim == 2 ? 32 : 64;
  using Column = std::array<double, capacity_>;
  struct Shell {
    Mat<Dim> log_metric, frame, frame_inverse;
    std::array<Column, Dim> u;  ///< offsets of the candidates, in units of the node spacing, in the frame
    Column u2;
    int kept = 0;
  };
  void keep(Shell& shell, const std::array<double, Dim>& u, double u2);
  void complete(Mat<Dim>& moment, const Mat<Dim>& cover, int lane, double reach) const;

  double nodes_per_h_, support2_, per_reach2_;
  V metric_[symmetric_size<Dim>] = {}, to_nodes_[symmetric_size<Dim>] = {};
  V around_[symmetric_size<Dim>] = {};  ///< sum of n n^T over all neighbours
  V neighbours_ = {};
  std::array<Shell, lanes> shells_;
};

/// Weighted means of the votes of particles, one in each lane of V (double or simd::Doubles), and their neighbours, and
/// how much to trust them.
template <int Dim, class V = double>
class VoteMean {
 public:
  /// `weight` is the kernel at the place of the voter.
  void add(V weight, const ShapeVote<Dim>& vote) {
    const V w = weight * vote.confidence, w2 = w * w;
    weight_ += w;
    weight2_ += w2;
    norm2_ += w2 * symmetric_product<Dim>(vote.log_covariance, vote.log_covariance);
    for (int s = 0; s < symmetric_size<Dim>; ++s) {
      sum_[s] += w * vote.log_covariance[s];
      sum2_[s] += w2 * vote.log_covariance[s];
    }
  }
  bool empty(int lane = 0) const { return !(simd::lane(weight_, lane) > 0); }
  /// The mean logarithm of the covariance, drawn towards round by its own noise.
  Symmetric<Dim> shrunk(int lane = 0) const;

 private:
  V weight_ = {}, weight2_ = {}, norm2_ = {};
  V sum_[symmetric_size<Dim>] = {}, sum2_[symmetric_size<Dim>] = {};
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
