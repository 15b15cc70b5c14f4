#pragma once
/// Gradients that are exact for linear fields, and what makes the pair forces their adjoint.
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace ejecta {

/// Smallest stretch of the moment matrix M_i = sum_j V_j x_ji (grad W)^T that is inverted as it stands: 1 in the
/// interior, 1/2 at a flat face, about 1/4 at a corner. In directions with fewer neighbours than that gradients fade
/// with the neighbours instead of growing beyond limits: a particle torn off all others strains no more.
inline constexpr double least_moment = 0.2;

/// Bound on (h^2 sum_j |V_j grad W|^2)^(1/2) over the smallest stretch, how much of a relative velocity a particle
/// takes for strain [1/h]: just above that of a corner of a lattice. The few of a torn clump come nearer to each other
/// than a spacing; exact gradients would make them swing faster than steps of signal crossings follow, and the energy
/// of such swings would be taken from their heat (docs/pair_pass.md).
inline constexpr double most_stiffness = 1.75;

/// Smallest stretch that is inverted, of particles with this (h^2 sum_j |V_j grad W|^2)^(1/2).
inline double least_stretch(double stiffness) { return std::max(least_moment, stiffness / most_stiffness); }

/// What becomes of the raw sum R = sum_j V_j v_ji (grad W)^T and of a stress sigma:
///   L = P R Q^T,   T = P sigma Q,   sigma : L = T : R.
/// With enough neighbours P = I and Q = M^-T, so that L is exact for linear fields [Randles & Libersky 1996] and the
/// pair forces V_i V_j (T_i + T_j) grad W are its adjoint: work and heat agree, and T M^T = sigma is symmetric, so that
/// angular momentum is conserved exactly [Bonet & Lok 1999]. With too few, M = U s V^T is inverted with p/s in place of
/// 1/s, p = min(1, s/least), and P = U p U^T. Then T M^T = P sigma P, still symmetric, and a rigid rotation
/// R = W M gives L = P W P, which has no strain: both invariances hold however few the neighbours are.
template <int Dim>
struct GradientCorrection {
  Mat<Dim> Q = Mat<Dim>::Identity(), P = Mat<Dim>::Identity();
  bool whole = true;  ///< P = I

  Mat<Dim> gradient(const Mat<Dim>& raw) const {
    const Mat<Dim> corrected = raw * Q.transpose();
    return whole ? corrected : Mat<Dim>(P * corrected);
  }
  Mat<Dim> stress(const Mat<Dim>& sigma) const {
    const Mat<Dim> corrected = sigma * Q;
    return whole ? corrected : Mat<Dim>(P * corrected);
  }
};

/// With the moment matrix, and the smallest stretch of it that is inverted as it stands.
template <int Dim>
GradientCorrection<Dim> gradient_correction(const Mat<Dim>& moment, double least = least_moment) {
  GradientCorrection<Dim> c;
  const Mat<Dim> inverse = moment.inverse();
  // The Frobenius norm of the inverse is at least its largest stretch: this spares most particles the decomposition. A
  // determinant below the least possible one is checked too: that of few neighbours is round-off, and so is the
  // inverse.
  const double least_determinant = Dim == 2 ? least * least : least * least * least;
  if (std::abs(moment.determinant()) >= least_determinant && inverse.squaredNorm() * least * least < 1) {
    c.Q = inverse.transpose();
    return c;
  }
  const Eigen::JacobiSVD<Mat<Dim>> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // A copy: GCC 12 takes a reference for uninitialised. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
  const Vec<Dim> s = svd.singularValues();
  if (s[Dim - 1] >= least) {
    c.Q = inverse.transpose();
    return c;
  }
  Vec<Dim> share, reciprocal;
  for (int k = 0; k < Dim; ++k) {
    share[k] = std::min(1.0, s[k] / least);
    reciprocal[k] = 1 / std::max(s[k], least);
  }
  c.P = svd.matrixU() * share.asDiagonal() * svd.matrixU().transpose();
  c.Q = svd.matrixU() * reciprocal.asDiagonal() * svd.matrixV().transpose();
  c.whole = false;
  return c;
}

/// A particle in contact with other pieces, across a surface of normal n, is strained by them along n alone: with the
/// gradients L_own of its own neighbours and L_all of all,
///   L = L_own + n [n.(L_all - L_own) n] n^T,
/// so that what slides or turns along does not shear it, and a common rotation is one. The adjoint of that for a stress
/// sigma, of which s = min(0, n.sigma n) passes on (contact pushes and never pulls):
///   on others    T' = P_all s n n^T Q_all
///   on its own   T = P_own (sigma - s n n^T) Q_own + T'
/// Work is heat here too, and T M_own^T + T' M_others^T is symmetric: angular momentum stays exact.
template <int Dim>
struct ContactStress {
  Mat<Dim> own, others;
};
template <int Dim>
ContactStress<Dim> contact_stress(const Mat<Dim>& sigma, const Vec<Dim>& normal, const GradientCorrection<Dim>& own,
                                  const GradientCorrection<Dim>& all) {
  const Mat<Dim> passed = std::min(0.0, normal.dot(sigma * normal)) * normal * normal.transpose();
  const Mat<Dim> others = all.stress(passed);
  return {own.stress(sigma - passed) + others, others};
}
/// Opening strains nothing that is not pressed.
template <int Dim>
Mat<Dim> contact_gradient(const Mat<Dim>& own, const Mat<Dim>& all, const Vec<Dim>& normal, bool pressed) {
  const double opening = normal.dot((all - own) * normal);
  return pressed || opening < 0 ? Mat<Dim>(own + opening * normal * normal.transpose()) : own;
}

}  // namespace ejecta
