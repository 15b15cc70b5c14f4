#pragma once
/// What the smoothing ellipsoid of a particle leaves on a picture plane: its section by the plane, or its projection.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace ejecta {

/// |H x|^2 = least + (x - centre).form (x - centre) for points x of the plane, relative to the particle.
struct Footprint {
  Vec<2> centre;  ///< m
  double least;   ///< 1
  Mat<2> form;    ///< 1/m^2

  /// Half width and half height of where |H x| < support [m]; NaN or 0 if that is nowhere.
  Vec<2> reach(double support) const {
    const Mat<2> inverse = form.inverse();
    return ((support * support - least) * inverse.diagonal()).cwiseSqrt();
  }
};

/// The parts of a 3D metric G = H H seen by a picture whose axes are x and z: G = [plane, tilt; tilt^T, depth].
struct SplitMetric {
  Mat<2> plane;
  Vec<2> tilt;
  double depth;
  explicit SplitMetric(const Mat<3>& g) : tilt(g(0, 1), g(2, 1)), depth(g(1, 1)) {
    plane << g(0, 0), g(0, 2), g(0, 2), g(2, 2);
  }
};

/// Section at `distance` [m] along y from the particle: q^2 = d.plane d + 2 distance tilt.d + distance^2 depth, with
/// the square completed.
inline Footprint section(const Mat<3>& metric, double distance) {
  const SplitMetric g(metric);
  const Vec<2> shift = g.plane.inverse() * g.tilt;
  return {-distance * shift, distance * distance * (g.depth - g.tilt.dot(shift)), g.plane};
}

/// Projection along y: at a line of sight d beside the particle q^2 = d.form d + depth (y - y0)^2, form the Schur
/// complement of depth. So the line integral of det(H) W(|H x|) is sqrt(det form) times the one of W(sqrt(q^2)) for the
/// unit sphere at the impact parameter sqrt(d.form d).
inline Footprint projection(const Mat<3>& metric) {
  const SplitMetric g(metric);
  return {Vec<2>::Zero(), 0, g.plane - g.tilt * g.tilt.transpose() / g.depth};
}

/// `form` with semi-axes of at least `length` [m].
inline Mat<2> widened(const Mat<2>& form, double length) {
  const double most = 1 / (length * length);
  if (!(form.trace() > most)) return form;  // no eigenvalue beyond
  Eigen::SelfAdjointEigenSolver<Mat<2>> axes;
  axes.computeDirect(form);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMin(most).asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace ejecta
