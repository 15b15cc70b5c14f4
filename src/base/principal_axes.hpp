#pragma once
/// Eigenvalues and eigenvectors of small symmetric matrices.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/types.hpp"

namespace ejecta {

/// m = axes diag(values) axes^T, values ascending, exact to a few units in the last place of the largest.
template <int Dim>
struct PrincipalAxes {
  Vec<Dim> values;
  Mat<Dim> axes;  ///< orthonormal columns

  explicit PrincipalAxes(const Mat<Dim>& m) {
    if constexpr (Dim == 2) {  // in closed form; a library's iteration takes ten times as long
      const double mean = 0.5 * (m(0, 0) + m(1, 1)), d = 0.5 * (m(0, 0) - m(1, 1)), b = 0.5 * (m(0, 1) + m(1, 0));
      const double radius = std::sqrt(d * d + b * b);
      values = {mean - radius, mean + radius};
      Vec<2> longest = d >= 0 ? Vec<2>(d + radius, b) : Vec<2>(b, radius - d);  // without cancellation
      const double norm2 = longest.squaredNorm();
      longest = norm2 > 0 ? Vec<2>(longest / std::sqrt(norm2)) : Vec<2>(0, 1);
      axes << longest[1], longest[0], -longest[0], longest[1];
    } else {
      const Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver(m);
      values = solver.eigenvalues();
      axes = solver.eigenvectors();
    }
  }

  /// axes diag(f(values)) axes^T
  template <class F>
  Mat<Dim> map(F&& f) const {
    return axes * values.unaryExpr(f).asDiagonal() * axes.transpose();
  }
};

}  // namespace ejecta
