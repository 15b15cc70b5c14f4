#pragma once
/// The metric G = H H of a smoothing tensor H (symmetric, positive definite): |H x|^2 = x.G x, so that G alone enters
/// neighbour search, kernel and gradient. Semi-axes of the ellipsoid |H x| = 1 are h_k = G_k^(-1/2) [m].
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace ejecta {

/// Round: H = I/h.
template <int Dim>
Mat<Dim> round_metric(double h) {
  return Mat<Dim>::Identity() / (h * h);
}

/// Smoothing length h = det(H)^(-1/Dim) = det(G)^(-1/(2 Dim)) [m].
template <int Dim>
double smoothing_length_of(const Mat<Dim>& metric) {
  const double determinant = metric.determinant();
  return 1 / (Dim == 2 ? std::sqrt(std::sqrt(determinant)) : std::sqrt(std::cbrt(determinant)));
}

/// Shortest and longest semi-axis [m].
struct Axes {
  double shortest, longest;
};
template <int Dim>
Axes axes_of(const Mat<Dim>& metric) {
  if constexpr (Dim == 2) {
    const double mean = 0.5 * metric.trace(), spread = std::hypot(0.5 * (metric(0, 0) - metric(1, 1)), metric(0, 1));
    const double largest = mean + spread;  // the product of the two does not cancel as their difference would
    return {1 / std::sqrt(largest), std::sqrt(largest / metric.determinant())};
  } else {
    Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver;
    solver.computeDirect(metric, Eigen::EigenvaluesOnly);
    return {1 / std::sqrt(solver.eigenvalues()[Dim - 1]), 1 / std::sqrt(solver.eigenvalues()[0])};
  }
}

/// No more than the shortest semi-axis [m]; equal to it if the ellipsoid is a sphere or flat and round.
template <int Dim>
double shortest_axis_bound(const Mat<Dim>& metric) {
  // The largest of n eigenvalues is at most mean + sqrt((n - 1)/n) |deviator|.
  const double mean = metric.trace() / Dim, deviator2 = std::max(0.0, metric.squaredNorm() - Dim * mean * mean);
  return (1 - 1e-7) / std::sqrt(mean + std::sqrt((Dim - 1.0) / Dim * deviator2));
}

/// The metric carried along by a velocity gradient L_ab = dv_a/dx_b [1/s] for a time dt [s]: G' = A^T G A with
/// A = (I + dt/2 L)^-1 (I - dt/2 L), so that |H x| of points of the fluid stays what it was. Exact in a rigid rotation
/// to second order of its angle, and positive definite for any L short of dt L = 2.
/// H itself obeys dH/dt = Omega H - H L [Owen et al. 1998], with a spin Omega whose only task is to keep H symmetric;
/// for G it drops out.
template <int Dim>
Mat<Dim> carried_metric(const Mat<Dim>& metric, const Mat<Dim>& gradient, double dt) {
  const Mat<Dim> half = 0.5 * dt * gradient, one = Mat<Dim>::Identity();
  const Mat<Dim> a = (one + half).inverse() * (one - half);
  const Mat<Dim> carried = a.transpose() * metric * a;
  return 0.5 * (carried + carried.transpose());
}

/// The metric with its longest axis cut to `largest_aspect` times the shortest, volume kept; unchanged if within.
template <int Dim>
Mat<Dim> limited_metric(const Mat<Dim>& metric, double largest_aspect) {
  // tr G tr G^-1 bounds the square of the aspect, and spares most particles the eigenvalues.
  if (metric.trace() * metric.inverse().trace() < largest_aspect * largest_aspect) return metric;
  Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver;
  solver.computeDirect(metric);
  Vec<Dim> values = solver.eigenvalues();
  const double least = values[Dim - 1] / (largest_aspect * largest_aspect);
  if (values[0] >= least) return metric;
  const double before = values.prod();
  for (int k = 0; k < Dim; ++k) values[k] = std::max(values[k], least);
  values *= std::pow(before / values.prod(), 1.0 / Dim);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

/// Bound on how far the ellipsoid of `now` sticks out of that of `then`: the smallest k found easily for which
/// |H_now x| <= 1 implies |H_then x| <= k. Exact if they are equal.
template <int Dim>
double outgrowth(const Mat<Dim>& then, const Mat<Dim>& now) {
  // The eigenvalues of A = G_then G_now^-1 are the squared stretches; their distance from 1 is at most the Frobenius
  // norm of A - I in its eigenframe.
  const Mat<Dim> a = then * now.inverse();
  const double distance2 = (a * a).trace() - 2 * a.trace() + Dim;
  return std::sqrt(1 + std::sqrt(std::max(0.0, distance2)));
}

}  // namespace ejecta
