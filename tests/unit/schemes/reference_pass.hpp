#pragma once
/// The pair sums of pair_pass.hpp as a plain double loop over all pairs, written from the formulas alone; and random
/// clouds with every field a pass reads.
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "schemes/kernels.hpp"
#include "schemes/pair_pass.hpp"
#include "unit/particles/cloud.hpp"

namespace ejecta {

inline constexpr double spacing = 0.0013;  ///< of the test clouds [m]

inline PairPassSettings settings_of(Kernel kernel, Precision precision, bool stress, bool correction) {
  PairPassSettings s;
  s.kernel = kernel;
  s.precision = precision;
  s.stress = stress;
  s.velocity_gradient = true;
  s.gradient_correction = correction;
  s.viscosity_alpha = 1.5;
  s.viscosity_beta = 2.5;
  s.length_unit = 1.0 / 1024;
  return s;
}

/// n particles of a cloud with that mean spacing; every field that rates() reads is random. Ranges of two
/// materials.
template <int Dim>
Particles<Dim> random_matter(std::size_t n, unsigned seed, bool stress, double h_spread = 1.5,
                             std::vector<Field> more = {}) {
  std::vector<Field> fields{Field::smoothing_length, Field::density,      Field::pressure,
                            Field::sound_speed,      Field::heating,      Field::neighbour_sum,
                            Field::approach_speed,   Field::shear_switch, Field::velocity_gradient};
  if (stress) fields.push_back(Field::deviatoric_stress);
  fields.insert(fields.end(), more.begin(), more.end());
  Particles<Dim> p = random_cloud<Dim>(n, seed, spacing, h_spread * spacing, fields);
  Uniform uniform(seed + 1);
  const double edge = spacing * std::pow(static_cast<double>(n), 1.0 / Dim);
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < Dim; ++a) {
      p.column(Field::position, a)[i] = edge * (p.column(Field::position, a)[i] - 0.3);
      p.column(Field::velocity, a)[i] = uniform(-100, 100);
    }
    // A number that single precision holds: set-up makes such masses for mixed precision.
    p.column(Field::mass)[i] = static_cast<float>(uniform(1, 2) * 2000 * std::pow(spacing, Dim));
    p.column(Field::density)[i] = uniform(1500, 3000);
    p.column(Field::pressure)[i] = uniform(-1e8, 1e9);
    p.column(Field::sound_speed)[i] = uniform(1000, 3000);
    p.column(Field::shear_switch)[i] = uniform(0, 1);
    for (int k = 0; stress && k < deviator_size<Dim>; ++k)
      p.column(Field::deviatoric_stress, k)[i] = uniform(-5e8, 5e8);
  }
  p.set_material_ranges({{0, n / 3}, {n / 3, n}});
  return p;
}

/// Sums of one particle, and of the magnitudes of their terms: round-off is measured against those.
template <int Dim>
struct Sums {
  Vec<Dim> acceleration = Vec<Dim>::Zero();
  double heating = 0, moment = 0, approach = 0;
  Mat<Dim> gradient = Mat<Dim>::Zero(), spread = Mat<Dim>::Zero();
  double acceleration_scale = 0, heating_scale = 0, gradient_scale = 0;
};

/// sigma = -P I + S of particle i; `intact` scales the deviator (empty: 1).
template <int Dim>
Mat<Dim> stress_of(const Particles<Dim>& p, std::span<const double> intact, std::size_t i) {
  Mat<Dim> sigma = -p.column(Field::pressure)[i] * Mat<Dim>::Identity();
  if (!p.has(Field::deviatoric_stress)) return sigma;
  const auto s = [&](int k) { return (intact.empty() ? 1 : intact[i]) * p.column(Field::deviatoric_stress, k)[i]; };
  sigma(0, 0) += s(0);
  sigma(1, 1) += s(1);
  sigma(0, 1) += s(2);
  sigma(1, 0) += s(2);
  if constexpr (Dim == 3) {
    sigma(2, 2) -= s(0) + s(1);
    sigma(0, 2) += s(3);
    sigma(2, 0) += s(3);
    sigma(1, 2) += s(4);
    sigma(2, 1) += s(4);
  }
  return sigma;
}

/// The sums of particle i over all others.
template <int Dim>
Sums<Dim> reference_rates(const Particles<Dim>& p, const PairPassSettings& settings, std::span<const double> intact,
                          std::size_t i) {
  return with_kernel(settings.kernel, [&](auto kernel) {
    using K = decltype(kernel);
    Sums<Dim> sums;
    const auto h = p.column(Field::smoothing_length), rho = p.column(Field::density), c = p.column(Field::sound_speed),
               mass = p.column(Field::mass), balsara = p.column(Field::shear_switch);
    const auto slope = [](double q) { return q < K::support ? q * K::slope_over_q(q, 1 / q) : 0.0; };
    const Mat<Dim> own = stress_of(p, intact, i) / (rho[i] * rho[i]);
    for (std::size_t j = 0; j < p.size(); ++j) {
      const Vec<Dim> x = p.vector(Field::position, i) - p.vector(Field::position, j);
      const Vec<Dim> v = p.vector(Field::velocity, i) - p.vector(Field::velocity, j);
      const double r = x.norm();
      if (r == 0) continue;
      const double dW = 0.5 * K::template norm<Dim> *
                        (slope(r / h[i]) / std::pow(h[i], Dim + 1) + slope(r / h[j]) / std::pow(h[j], Dim + 1));
      const Vec<Dim> gradW = dW / r * x;
      const double mean_h = 0.5 * (h[i] + h[j]);
      const double mu = v.dot(x) < 0 ? mean_h * v.dot(x) / (r * r + 0.01 * mean_h * mean_h) : 0;
      const double viscosity =
          0.5 * (balsara[i] + balsara[j]) * 0.5 * (1 / rho[i] + 1 / rho[j]) *
          (-settings.viscosity_alpha * 0.5 * (c[i] + c[j]) * mu + settings.viscosity_beta * mu * mu);
      const Mat<Dim> one = Mat<Dim>::Identity();
      const Vec<Dim> force = mass[j] * (own + stress_of(p, intact, j) / (rho[j] * rho[j]) - viscosity * one) * gradW;
      const double heat = -mass[j] * v.dot((own - 0.5 * viscosity * one) * gradW);
      sums.acceleration += force;
      sums.heating += heat;
      sums.moment -= slope(r / h[i]);
      if (r < K::support * h[i]) sums.approach = std::max(sums.approach, -mu);
      sums.gradient -= mass[j] / rho[i] * v * gradW.transpose();
      sums.spread -= mass[j] / rho[i] * x * gradW.transpose();
      sums.acceleration_scale += force.norm();
      sums.heating_scale += mass[j] * v.norm() * (own - 0.5 * viscosity * one).norm() * gradW.norm();
      sums.gradient_scale += mass[j] / rho[i] * v.norm() * gradW.norm();
    }
    return sums;
  });
}

/// Lists and a pass for the particles as they are; returns the lists.
template <int Dim>
PairLists<Dim> run_rates(Particles<Dim>& p, const PairPassSettings& settings, std::span<const double> intact = {}) {
  PairLists<Dim> lists;
  lists.build(p, {kernel_support(settings.kernel), cluster_size(settings.precision), 0, settings.boundary});
  make_pair_pass<Dim>(settings)->rates(p, lists, intact);
  return lists;
}

template <int Dim>
Mat<Dim> velocity_gradient_of(const Particles<Dim>& p, std::size_t i) {
  Mat<Dim> L;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) L(a, b) = p.column(Field::velocity_gradient, a * Dim + b)[i];
  return L;
}

}  // namespace ejecta
