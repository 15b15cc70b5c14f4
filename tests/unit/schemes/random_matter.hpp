#pragma once
/// Random clouds with every field a pass reads, a run of the pass over them, and what must balance in the end.
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "schemes/pair_pass.hpp"
#include "unit/particles/cloud.hpp"

namespace ejecta {

inline constexpr double spacing = 0.0013;  ///< of the test clouds [m]

template <int Dim>
Eigen::JacobiSVD<Mat<Dim>> svd_of(const Mat<Dim>& m) {
  const Eigen::JacobiSVD<Mat<Dim>> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) throw std::runtime_error("a matrix without singular values");
  return svd;
}

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
  // Powers of two, so that weights are exact where masses and densities are.
  s.rules.reference_density = {2048, 1024};
  s.alike = 2.5;  // pairs of weights by mass, by volume, and in between
  return s;
}

/// n particles of a cloud with that mean spacing, from -0.3 to 0.7 of its edge; every field that rates() reads is
/// random. Ranges of two materials, two bodies.
template <int Dim>
Particles<Dim> random_matter(std::size_t n, unsigned seed, bool stress, double h_spread = 1.5,
                             std::vector<Field> more = {}) {
  std::vector<Field> fields{
      Field::smoothing_length,     Field::density,       Field::pressure,   Field::sound_speed,
      Field::specific_energy_rate, Field::zeroth_moment, Field::largest_mu, Field::viscosity_factor,
      Field::velocity_gradient,    Field::shock_switch};
  if (stress) fields.insert(fields.end(), {Field::deviatoric_stress, Field::intact_share});
  fields.insert(fields.end(), more.begin(), more.end());
  Particles<Dim> p = random_cloud<Dim>(n, seed, spacing, h_spread * spacing, fields);
  Uniform uniform(seed + 1);
  const double edge = spacing * std::pow(static_cast<double>(n), 1.0 / Dim);
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < Dim; ++a) {
      p.column(Field::position, a)[i] = edge * (p.column(Field::position, a)[i] - 0.3);
      p.column(Field::velocity, a)[i] = uniform(-100, 100);
    }
    p.column(Field::mass)[i] = uniform(1, 2) * 2000 * std::pow(spacing, Dim);
    p.column(Field::density)[i] = uniform(300, 3000);
    p.column(Field::pressure)[i] = uniform(-1e8, 1e9);
    p.column(Field::sound_speed)[i] = uniform(1000, 3000);
    p.column(Field::viscosity_factor)[i] = uniform(0, 1);
    p.column(Field::shock_switch)[i] = uniform(0, 1);
    // Compression in most, of the size of the differences in velocity.
    for (int k = 0; k < Dim * Dim; ++k)
      p.column(Field::velocity_gradient, k)[i] =
          uniform(-1, 1) * 20 / spacing - (k % (Dim + 1) == 0 ? 30 / spacing : 0);
    for (int k = 0; stress && k < deviator_size<Dim>; ++k)
      p.column(Field::deviatoric_stress, k)[i] = uniform(-5e8, 5e8);
    if (stress) p.column(Field::intact_share)[i] = 1;
    p.label(Label::material)[i] = p.label(Label::body)[i] = i < n / 3 ? 0 : 1;
  }
  p.set_material_ranges({{0, n / 3}, {n / 3, n}});
  return p;
}

/// Gives every particle of a cloud enough neighbours, none of which stands for most of them: volumes nearly alike, and
/// supports wider by `wider`.
template <int Dim>
void even_surroundings(Particles<Dim>& p, double wider = 1.5) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.column(Field::density)[i] = p.column(Field::mass)[i] / std::pow(spacing, Dim) * (i % 3 == 0 ? 0.9 : 1.1);
    p.column(Field::smoothing_length)[i] *= wider;
  }
}

/// Makes two pieces of a cloud: body 1 is where x > 0.
template <int Dim>
void split_in_two(Particles<Dim>& p, PairPassSettings& settings) {
  for (std::size_t i = 0; i < p.size(); ++i) p.label(Label::body)[i] = p.column(Field::position)[i] > 0;
  settings.rules.sizes = {spacing, spacing};
  settings.rules.pieces = {2, 3};
  settings.contacts = true;
}

/// Lists and a pass for the particles as they are; returns the lists.
template <int Dim>
PairLists<Dim> run_rates(Particles<Dim>& p, const PairPassSettings& settings, const Boundary& boundary = {},
                         const Guests<Dim>& guests = {}) {
  PairLists<Dim> lists;
  lists.build(p, {kernel_support(settings.kernel), cluster_size(settings.precision), 0, boundary}, guests);
  make_pair_pass<Dim>(settings)->rates(p, lists);
  return lists;
}

template <int Dim>
Mat<Dim> velocity_gradient_of(const Particles<Dim>& p, std::size_t i) {
  return p.tensor(Field::velocity_gradient, i);
}

/// Sums over all particles that must vanish, relative to those of the magnitudes of their terms.
struct Balance {
  double momentum, angular_momentum, energy;
};
template <int Dim>
Balance balance_of(const Particles<Dim>& p) {
  Vec<Dim> force = Vec<Dim>::Zero();
  Mat<Dim> torque = Mat<Dim>::Zero();
  double energy = 0, force_scale = 0, torque_scale = 0, energy_scale = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim> f = p.column(Field::mass)[i] * p.vector(Field::acceleration, i), x = p.vector(Field::position, i);
    const double heat = p.column(Field::mass)[i] * p.column(Field::specific_energy_rate)[i],
                 work = f.dot(p.vector(Field::velocity, i));
    force += f;
    torque += x * f.transpose() - f * x.transpose();
    energy += heat + work;
    force_scale += f.norm();
    torque_scale += x.norm() * f.norm();
    energy_scale += std::abs(heat) + std::abs(work);
  }
  return {force.norm() / force_scale, torque.norm() / torque_scale, std::abs(energy) / energy_scale};
}

}  // namespace ejecta
