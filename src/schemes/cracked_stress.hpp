#pragma once
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/types.hpp"

namespace ejecta {

/// What cracks let through of a stress deviator [Pa]: S' = A^(1/2) S A^(1/2) with A = I - D, the intact share across
/// each direction. A crack with normal n (D n = n) leaves no traction, S' n = 0, and the stress along it whole; D = d I
/// gives the scalar law (1 - d) S. S' is no deviator any more.
/// A weight on the pairs alone, such as f_ij = 1 - max(n.D_i n, n.D_j n), does not do it: pairs oblique to the crack
/// then still carry a share <c^2 (1 - c^2)>/<c^2> of the traction across it, 1/4 in 2D and 2/5 in 3D.
template <int Dim>
Mat<Dim> transmitted(const Mat<Dim>& deviator, const Mat<Dim>& damage) {
  Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver;
  solver.computeDirect(damage);
  const Vec<Dim> intact = (1 - solver.eigenvalues().array()).max(0.0).sqrt();
  const Mat<Dim> root = solver.eigenvectors() * intact.asDiagonal() * solver.eigenvectors().transpose();
  return root * deviator * root;
}

}  // namespace ejecta
