#include "schemes/ideal_h.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace ejecta {

namespace {

// Lengths in units of the node spacing h/n_h.
constexpr double shell_radius = 2.0;     ///< nothing farther belongs to a first shell
constexpr double coincident = 0.05;      ///< what is nearer has no direction worth a vote
constexpr double shadow_begin = 0.70;    ///< a neighbour with this tau begins to be behind another ...
constexpr double shadow_end = 0.95;      ///< ... and with this one is; the diagonal of a square has exactly 1
constexpr double frame_shrinkage = 0.1;  ///< see frame_power()
constexpr double shrinkage = 3;          ///< kappa: weight of the variance of a mean vote against its square

/// Cubic step from 0 at a to 1 at b.
double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// f of a symmetric matrix by its eigenvalues.
template <int Dim, class F>
Mat<Dim> function_of(const Mat<Dim>& m, F&& f) {
  const Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver(m);
  return solver.eigenvectors() * solver.eigenvalues().unaryExpr(f).asDiagonal() * solver.eigenvectors().transpose();
}

/// Logarithms of the eigenvalues of a metric and its eigenvectors. Round-off may leave the smallest eigenvalue of a
/// very long ellipsoid at or below 0: it is lifted, to an aspect of 1e7.
template <int Dim>
struct LogMetric {
  Mat<Dim> axes;
  Vec<Dim> logs;  ///< of the unimodular metric: sum 0
  double size;    ///< mean logarithm: G = exp(size) exp(logs)
  explicit LogMetric(const Mat<Dim>& metric) {
    const Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver(metric);
    axes = solver.eigenvectors();
    const double largest = solver.eigenvalues()[Dim - 1];
    logs = solver.eigenvalues().unaryExpr([&](double l) { return std::log(std::max(l, 1e-14 * largest)); });
    size = logs.mean();
    logs.array() -= size;
  }
  template <class F>
  Mat<Dim> map(F&& f) const {
    return axes * logs.unaryExpr(f).asDiagonal() * axes.transpose();
  }
};

/// s(a): the first shell is chosen in the frame H~^s.
double frame_power(double log_aspect) { return std::max(0.5, 1 - frame_shrinkage * log_aspect); }

template <int Dim>
double norm2(const Symmetric<Dim>& s) {
  return s.squaredNorm() + s.template tail<symmetric_size<Dim> - Dim>().squaredNorm();
}

template <int Dim>
double product(const Symmetric<Dim>& a, const Symmetric<Dim>& b) {
  constexpr int off = symmetric_size<Dim> - Dim;
  return a.dot(b) + a.template tail<off>().dot(b.template tail<off>());
}

}  // namespace

template <int Dim>
FirstShell<Dim>::FirstShell(const Mat<Dim>& metric, double nodes_per_h, double support)
    : metric_(metric),
      support2_(support * support),
      reach2_(shell_radius * shell_radius / (nodes_per_h * nodes_per_h)) {
  const LogMetric<Dim> log_metric(metric);
  const double log_aspect = 0.5 * (log_metric.logs[Dim - 1] - log_metric.logs[0]);
  const double power = 0.5 * frame_power(log_aspect);
  log_metric_ = log_metric.map([](double l) { return l; });
  frame_ = log_metric.map([&](double l) { return std::exp(power * l); });
  frame_inverse_ = log_metric.map([&](double l) { return std::exp(-power * l); });
  to_nodes_ = nodes_per_h * std::exp(0.5 * log_metric.size) * frame_;
}

template <int Dim>
void FirstShell<Dim>::add(const Vec<Dim>& x) {
  const double eta2 = x.dot(metric_ * x);
  if (!(eta2 < support2_)) return;
  const Vec<Dim> u = to_nodes_ * x;
  const double u2 = u.squaredNorm();
  if (!(u2 > coincident * coincident)) return;
  ++neighbours_;
  around_ += u * u.transpose() / u2;
  constexpr double near = 0.75 * shell_radius;
  if (eta2 < reach2_ || u2 < near * near) keep({u, u2});
}

template <int Dim>
void FirstShell<Dim>::keep(const Candidate& candidate) {
  if (kept_ < capacity_) {
    candidates_[kept_++] = candidate;
    return;
  }
  auto farthest = std::max_element(candidates_.begin(), candidates_.end(),
                                   [](const Candidate& a, const Candidate& b) { return a.u2 < b.u2; });
  if (candidate.u2 < farthest->u2) *farthest = candidate;
}

/// 1 for members of the first shell, 0 for those behind one: candidate j is behind k if it lies beyond the plane
/// through k across the line to k. tau = (u_j.u_k)/|u_k|^2 = 1 on the plane; 1/2 is the Voronoi cell's.
template <int Dim>
std::array<double, FirstShell<Dim>::capacity_> FirstShell<Dim>::unshadowed() const {
  std::array<double, capacity_> share;
  for (int j = 0; j < kept_; ++j) {
    double tau = 0;
    for (int k = 0; k < kept_; ++k)
      if (k != j) tau = std::max(tau, candidates_[j].u.dot(candidates_[k].u) / candidates_[k].u2);
    share[j] = 1 - smooth_step(shadow_begin, shadow_end, tau);
  }
  return share;
}

template <int Dim>
ShapeVote<Dim> FirstShell<Dim>::vote(double reach) const {
  ShapeVote<Dim> result;
  result.log_covariance = symmetric_of<Dim>(-log_metric_);
  if (kept_ == 0) return result;
  const auto share = unshadowed();
  Mat<Dim> moment = Mat<Dim>::Zero(), cover = Mat<Dim>::Zero();
  double weight = 0;
  for (int j = 0; j < kept_; ++j) {
    if (share[j] == 0) continue;
    // A neighbour without one opposite counts for that too: at a surface the shell is completed by its mirror image.
    double opposite = 0;
    for (int k = 0; k < kept_; ++k) {
      const double dot = -candidates_[j].u.dot(candidates_[k].u);
      if (share[k] > opposite && dot > 0)
        opposite = std::max(opposite,
                            share[k] * smooth_step(0.5, 0.8, dot / std::sqrt(candidates_[j].u2 * candidates_[k].u2)));
    }
    const double w = share[j] * (2 - opposite);
    moment += w * candidates_[j].u * candidates_[j].u.transpose();
    cover += w / candidates_[j].u2 * candidates_[j].u * candidates_[j].u.transpose();
    weight += w;
  }
  if (!(weight > 0)) return result;
  result.confidence = std::min(1.0, weight / (2 * Dim));
  result.spacing = std::sqrt(moment.trace() / cover.trace());

  const Mat<Dim> gaps = function_of<Dim>(cover, [](double c) { return std::max(0.0, 1 - c); });
  if (gaps.trace() > 0) {
    // Directions that the shell does not cover. Where other neighbours lie there, beyond the shell, the nearest of them
    // are at least near the edge of the candidates; where there are none H may look `reach` times as far as elsewhere.
    const Mat<Dim> beyond = function_of<Dim>(around_ - cover, [](double n) { return smooth_step(0.02, 1, n); });
    const Mat<Dim> root = function_of<Dim>(gaps, [](double g) { return std::sqrt(std::max(g, 0.0)); });
    const Mat<Dim> empty = function_of<Dim>(beyond, [](double b) { return std::sqrt(std::clamp(1 - b, 0.0, 1.0)); });
    const double edge = 0.75 * shell_radius;
    const double beyond2 = std::max(moment.trace() / cover.trace(), edge * edge);
    const double lab2 = (frame_inverse_ * moment * frame_inverse_).trace() / cover.trace();
    moment += 2 * root * (reach * reach * lab2 * empty * frame_ * frame_ * empty + beyond2 * beyond) * root;
  }
  const Mat<Dim> covariance = frame_inverse_ * moment * frame_inverse_;
  Mat<Dim> log_covariance = LogMetric<Dim>(0.5 * (covariance + covariance.transpose())).map([](double l) { return l; });
  result.log_covariance = symmetric_of<Dim>(log_covariance);
  return result;
}

template <int Dim>
void VoteMean<Dim>::add(double weight, const ShapeVote<Dim>& vote) {
  const double w = weight * vote.confidence, w2 = w * w;
  weight_ += w;
  weight2_ += w2;
  norm2_ += w2 * norm2<Dim>(vote.log_covariance);
  sum_ += w * vote.log_covariance;
  sum2_ += w2 * vote.log_covariance;
}

template <int Dim>
Symmetric<Dim> VoteMean<Dim>::shrunk() const {
  if (empty()) return Symmetric<Dim>::Zero();
  const Symmetric<Dim> mean = sum_ / weight_;
  const double mean2 = norm2<Dim>(mean);
  const double variance =
      std::max(0.0, norm2_ - 2 * product<Dim>(mean, sum2_) + mean2 * weight2_) / (weight_ * weight_);
  if (!(mean2 > 0)) return Symmetric<Dim>::Zero();
  return mean2 / (mean2 + shrinkage * variance) * mean;
}

template <int Dim>
Mat<Dim> reshaped(const Mat<Dim>& metric, const Symmetric<Dim>& log_covariance, bool keep, const ShapeLimits& limits,
                  ShapeActions& actions) {
  const LogMetric<Dim> evolved(metric);
  const double widest = 2 * std::log(limits.largest_aspect);  // ratio of the eigenvalues of G is the aspect squared
  actions = {};
  actions.kept = keep;
  Mat<Dim> shape = evolved.map([](double l) { return l; });
  if (!keep) {
    const Mat<Dim> change = -matrix_of<Dim>(log_covariance) - shape;
    const Eigen::SelfAdjointEigenSolver<Mat<Dim>> change_solver(change, Eigen::EigenvaluesOnly);
    const double wanted = 0.5 * change_solver.eigenvalues().cwiseAbs().maxCoeff();  // of an axis of H
    const double allowed = std::log(limits.largest_change);
    actions.change = wanted > allowed;
    actions.moved = std::min(wanted, allowed);
    shape += (actions.change ? allowed / wanted : 1.0) * change;
  }
  const Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver(shape);
  Vec<Dim> logs = solver.eigenvalues();
  const double spread = logs[Dim - 1] - logs[0];
  actions.aspect = spread > widest;
  if (actions.aspect) logs *= widest / spread;
  logs.array() += evolved.size - logs.mean();
  const Mat<Dim> result =
      solver.eigenvectors() * logs.array().exp().matrix().asDiagonal() * solver.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

template <int Dim>
double aspect(const Mat<Dim>& metric) {
  const LogMetric<Dim> log_metric(metric);
  return std::exp(0.5 * (log_metric.logs[Dim - 1] - log_metric.logs[0]));
}

template class FirstShell<2>;
template class FirstShell<3>;
template class VoteMean<2>;
template class VoteMean<3>;
template Mat<2> reshaped<2>(const Mat<2>&, const Symmetric<2>&, bool, const ShapeLimits&, ShapeActions&);
template Mat<3> reshaped<3>(const Mat<3>&, const Symmetric<3>&, bool, const ShapeLimits&, ShapeActions&);
template double aspect<2>(const Mat<2>&);
template double aspect<3>(const Mat<3>&);

}  // namespace ejecta
