#include "schemes/ideal_h.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/principal_axes.hpp"

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

/// Logarithms of the eigenvalues of a metric and its eigenvectors. Round-off may leave the smallest eigenvalue of a
/// very long ellipsoid at or below 0: it is lifted, to an aspect of 1e7.
template <int Dim>
struct LogMetric : PrincipalAxes<Dim> {  // values: logarithms of the unimodular metric, with sum 0
  double size;                           ///< mean logarithm: G = exp(size) exp(values)
  using PrincipalAxes<Dim>::values;
  explicit LogMetric(const Mat<Dim>& metric) : PrincipalAxes<Dim>(metric) {
    const double least = 1e-14 * values[Dim - 1];
    values = values.unaryExpr([&](double l) { return std::log(std::max(l, least)); });
    size = values.mean();
    values.array() -= size;
  }
  Mat<Dim> logarithm() const {
    return this->map([](double l) { return l; });
  }
};

template <int Dim, class F>
Mat<Dim> function_of(const Mat<Dim>& m, F&& f) {
  return PrincipalAxes<Dim>(m).map(f);
}

/// s(a): the first shell is chosen in the frame H~^s.
double frame_power(double log_aspect) { return std::max(0.5, 1 - frame_shrinkage * log_aspect); }

/// Adds w x x^T.
template <int Dim, class V>
void add_square(V (&sum)[symmetric_size<Dim>], V w, const V (&x)[Dim]) {
  int s = Dim;
  for (int a = 0; a < Dim; ++a) {
    const V wx = w * x[a];
    sum[a] += wx * x[a];
    for (int b = a + 1; b < Dim; ++b) sum[s++] += wx * x[b];
  }
}

template <int Dim>
Mat<Dim> to_matrix(const double (&s)[symmetric_size<Dim>]) {
  return matrix_of<Dim>(Eigen::Map<const Symmetric<Dim>>(s));
}

/// True if m - 1 has no eigenvalue below 0; false also where round-off leaves that open.
template <int Dim>
bool at_least_one(const Mat<Dim>& m) {
  const Mat<Dim> excess = m - Mat<Dim>::Identity();
  if (!(excess(0, 0) > 0) || !(excess.template topLeftCorner<2, 2>().determinant() > 0)) return false;
  return Dim == 2 || excess.determinant() > 0;
}

using simd::Doubles;
constexpr int width = simd::lanes<double>;

/// As many numbers as a register holds, from a place on.
Doubles load(const double* from) {
  Doubles v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
void store(double* to, Doubles v) { std::memcpy(to, &v, sizeof v); }

Doubles smooth_step(double a, double b, Doubles x) {
  const Doubles t = simd::min(simd::max((x - a) * (1 / (b - a)), Doubles{}), Doubles{} + 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

template <int Dim, class V>
FirstShells<Dim, V>::FirstShells(double nodes_per_h, double support)
    : nodes_per_h_(nodes_per_h),
      support2_(support * support),
      per_reach2_(nodes_per_h * nodes_per_h / (shell_radius * shell_radius)) {}

template <int Dim, class V>
void FirstShells<Dim, V>::place(int lane, const Mat<Dim>& metric) {
  const LogMetric<Dim> log_metric(metric);
  const double log_aspect = 0.5 * (log_metric.values[Dim - 1] - log_metric.values[0]);
  const double power = 0.5 * frame_power(log_aspect);
  Shell& shell = shells_[static_cast<std::size_t>(lane)];
  shell.log_metric = log_metric.logarithm();
  shell.frame = log_metric.map([&](double l) { return std::exp(power * l); });
  shell.frame_inverse = log_metric.map([&](double l) { return std::exp(-power * l); });
  const Symmetric<Dim> G = symmetric_of<Dim>(metric),
                       T = nodes_per_h_ * std::exp(0.5 * log_metric.size) * symmetric_of<Dim>(shell.frame);
  for (int s = 0; s < symmetric_size<Dim>; ++s) {
    simd::set_lane(metric_[s], lane, G[s]);
    simd::set_lane(to_nodes_[s], lane, T[s]);
  }
}

template <int Dim, class V>
void FirstShells<Dim, V>::add(const V (&x)[Dim], V apart) {
  V image[Dim], u[Dim];
  const V eta2 = quadratic_form<Dim>(metric_, x, image) + apart;
  if (!simd::any_less(eta2, simd::all<V>(support2_))) return;
  quadratic_form<Dim>(to_nodes_, x, u);
  V u2 = u[0] * u[0];
  for (int a = 1; a < Dim; ++a) u2 += u[a] * u[a];
  const auto counts = (eta2 < simd::all<V>(support2_)) & (u2 > V{} + coincident * coincident);
  const V zero{}, one = zero + 1.0;
  neighbours_ += counts ? one : zero;
  for (V& component : u) component = counts ? component : zero;
  add_square<Dim>(around_, counts ? simd::reciprocal(u2) : zero, u);
  constexpr double near = 0.75 * shell_radius;
  const V distance = simd::min(V(eta2 * per_reach2_), V(u2 * (1 / (near * near))));
  for (unsigned bits = simd::lanes_less(counts ? distance : one, one); bits; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    std::array<double, Dim> offset;
    for (int a = 0; a < Dim; ++a) offset[a] = simd::lane(u[a], lane);
    keep(shells_[static_cast<std::size_t>(lane)], offset, simd::lane(u2, lane));
  }
}

template <int Dim, class V>
void FirstShells<Dim, V>::keep(Shell& shell, const std::array<double, Dim>& u, double u2) {
  int place = shell.kept;
  if (place < capacity_) {
    ++shell.kept;
  } else {
    place = static_cast<int>(std::max_element(shell.u2.begin(), shell.u2.end()) - shell.u2.begin());
    if (!(u2 < shell.u2[place])) return;
  }
  for (int a = 0; a < Dim; ++a) shell.u[a][place] = u[a];
  shell.u2[place] = u2;
}

template <int Dim, class V>
ShapeVote<Dim> FirstShells<Dim, V>::vote(int lane, double reach) {
  Shell& shell = shells_[static_cast<std::size_t>(lane)];
  ShapeVote<Dim> result;
  result.log_covariance = symmetric_of<Dim>(-shell.log_metric);
  if (shell.kept == 0) return result;
  for (int k = shell.kept; k % width; ++k) {  // points at 0 fill the last vector up and are behind nothing
    for (auto& column : shell.u) column[k] = 0;
    shell.u2[k] = 1;
  }
  Column reciprocal;
  for (int k = 0; k < shell.kept; k += width) store(&reciprocal[k], 1 / load(&shell.u2[k]));
  // Candidate j is behind k if it lies beyond the plane through k across the line to k. tau = (u_j.u_k)/|u_k|^2 = 1 on
  // the plane; 1/2 is the Voronoi cell's. Those behind none make the first shell.
  std::array<Column, Dim> n;  ///< directions of its members
  Column u2, share;
  int size = 0;
  for (int j = 0; j < shell.kept; j += width) {
    Doubles u[Dim], tau{};
    for (int a = 0; a < Dim; ++a) u[a] = load(&shell.u[a][j]);
    Doubles place;
    for (int k = 0; k < width; ++k) place[k] = j + k;
    for (int k = 0; k < shell.kept; ++k) {
      Doubles along = u[0] * shell.u[0][k];
      for (int a = 1; a < Dim; ++a) along += u[a] * shell.u[a][k];
      tau = place != simd::all<Doubles>(static_cast<double>(k)) ? simd::max(tau, along * reciprocal[k]) : tau;
    }
    const Doubles in_front = 1 - smooth_step(shadow_begin, shadow_end, tau);
    for (int k = 0; k < std::min(width, shell.kept - j); ++k) {
      if (!(in_front[k] > 0)) continue;
      const double r = std::sqrt(reciprocal[j + k]);
      for (int a = 0; a < Dim; ++a) n[a][size] = r * shell.u[a][j + k];
      u2[size] = shell.u2[j + k];
      share[size++] = in_front[k];
    }
  }
  for (int k = size; k % width; ++k)
    for (auto& column : n) column[k] = 0;
  // A neighbour without one opposite counts for that too: at a surface the shell is completed by its mirror image.
  double moment_sum[symmetric_size<Dim>] = {}, cover_sum[symmetric_size<Dim>] = {}, weight = 0;
  for (int j = 0; j < size; j += width) {
    Doubles opposite{};
    for (int k = 0; k < size; ++k) {
      Doubles cosine = load(&n[0][j]) * n[0][k];
      for (int a = 1; a < Dim; ++a) cosine += load(&n[a][j]) * n[a][k];
      opposite = simd::max(opposite, share[k] * smooth_step(0.5, 0.8, -cosine));
    }
    for (int k = j; k < std::min(j + width, size); ++k) {
      const double w = share[k] * (2 - opposite[k - j]);
      double direction[Dim];
      for (int a = 0; a < Dim; ++a) direction[a] = n[a][k];
      add_square<Dim>(cover_sum, w, direction);
      add_square<Dim>(moment_sum, w * u2[k], direction);
      weight += w;
    }
  }
  if (!(weight > 0)) return result;
  result.confidence = std::min(1.0, weight / (2 * Dim));
  Mat<Dim> moment = to_matrix<Dim>(moment_sum);
  const Mat<Dim> cover = to_matrix<Dim>(cover_sum);
  result.spacing = std::sqrt(moment.trace() / cover.trace());
  if (!at_least_one<Dim>(cover)) complete(moment, cover, lane, reach);
  const Mat<Dim> covariance = shell.frame_inverse * moment * shell.frame_inverse;
  result.log_covariance = symmetric_of<Dim>(LogMetric<Dim>(0.5 * (covariance + covariance.transpose())).logarithm());
  return result;
}

/// Adds to the moment for directions that the shell does not cover. Where other neighbours lie there, beyond the shell,
/// the nearest of them are at least near the edge of the candidates; where there are none H may look `reach` times as
/// far as elsewhere.
template <int Dim, class V>
void FirstShells<Dim, V>::complete(Mat<Dim>& moment, const Mat<Dim>& cover, int lane, double reach) const {
  const Shell& shell = shells_[static_cast<std::size_t>(lane)];
  double around[symmetric_size<Dim>];
  for (int s = 0; s < symmetric_size<Dim>; ++s) around[s] = simd::lane(around_[s], lane);
  const Mat<Dim> root = function_of<Dim>(cover, [](double c) { return std::sqrt(std::max(0.0, 1 - c)); });
  const PrincipalAxes<Dim> others(to_matrix<Dim>(around) - cover);
  const Mat<Dim> beyond = others.map([](double n) { return smooth_step(0.02, 1, n); });
  const Mat<Dim> empty = others.map([](double n) { return std::sqrt(1 - smooth_step(0.02, 1, n)); });
  const double edge = 0.75 * shell_radius;
  const double beyond2 = std::max(moment.trace() / cover.trace(), edge * edge);
  const double lab2 = (shell.frame_inverse * moment * shell.frame_inverse).trace() / cover.trace();
  moment += 2 * root * (reach * reach * lab2 * empty * shell.frame * shell.frame * empty + beyond2 * beyond) * root;
}

template <int Dim, class V>
Symmetric<Dim> VoteMean<Dim, V>::shrunk(int lane) const {
  if (empty(lane)) return Symmetric<Dim>::Zero();
  const double weight = simd::lane(weight_, lane);
  Symmetric<Dim> mean, sum2;
  for (int s = 0; s < symmetric_size<Dim>; ++s) {
    mean[s] = simd::lane(sum_[s], lane) / weight;
    sum2[s] = simd::lane(sum2_[s], lane);
  }
  const double mean2 = symmetric_product<Dim>(mean, mean);
  const double variance = std::max(0.0, simd::lane(norm2_, lane) - 2 * symmetric_product<Dim>(mean, sum2) +
                                            mean2 * simd::lane(weight2_, lane)) /
                          (weight * weight);
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
  Mat<Dim> shape = evolved.logarithm();
  if (!keep) {
    const Mat<Dim> change = -matrix_of<Dim>(log_covariance) - shape;
    Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver;
    solver.computeDirect(change, Eigen::EigenvaluesOnly);
    const double wanted = 0.5 * solver.eigenvalues().cwiseAbs().maxCoeff();  // of an axis of H
    const double allowed = std::log(limits.largest_change);
    actions.change = wanted > allowed;
    actions.moved = std::min(wanted, allowed);
    shape += (actions.change ? allowed / wanted : 1.0) * change;
  }
  PrincipalAxes<Dim> principal(shape);
  Vec<Dim>& logs = principal.values;
  const double spread = logs[Dim - 1] - logs[0];
  actions.aspect = spread > widest;
  if (actions.aspect) logs *= widest / spread;
  logs.array() += evolved.size - logs.mean();
  const Mat<Dim> result = principal.map([](double l) { return std::exp(l); });
  return 0.5 * (result + result.transpose());
}

template <int Dim>
double aspect(const Mat<Dim>& metric) {
  const LogMetric<Dim> log_metric(metric);
  return std::exp(0.5 * (log_metric.values[Dim - 1] - log_metric.values[0]));
}

template class FirstShells<2, double>;
template class FirstShells<3, double>;
template class FirstShells<2, Doubles>;
template class FirstShells<3, Doubles>;
template class VoteMean<2, double>;
template class VoteMean<3, double>;
template class VoteMean<2, Doubles>;
template class VoteMean<3, Doubles>;
template Mat<2> reshaped<2>(const Mat<2>&, const Symmetric<2>&, bool, const ShapeLimits&, ShapeActions&);
template Mat<3> reshaped<3>(const Mat<3>&, const Symmetric<3>&, bool, const ShapeLimits&, ShapeActions&);
template double aspect<2>(const Mat<2>&);
template double aspect<3>(const Mat<3>&);

}  // namespace ejecta
