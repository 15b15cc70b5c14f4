#include "schemes/flux.hpp"

#include <gtest/gtest.h>

#include "schemes/pair_pass_kinds.hpp"
#include "schemes/pair_records_impl.hpp"
#include "unit/schemes/acoustic_flux.hpp"
#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

constexpr PassKind gas{};

PairPassSettings gas_settings(Precision precision) {
  auto settings = settings_of(Kernel::wendland_c2, precision, false, false);
  settings.velocity_gradient = false;
  settings.alike = 1e9;
  return settings;
}

template <class T>
Particles<2> with_acoustic_flux(const PairPassSettings& settings) {
  auto p = random_matter<2>(500, 71, false, 2);
  for (double& pressure : p.column(Field::pressure)) pressure = std::abs(pressure);
  sort_in_space(p, cluster_size(settings.precision));
  PairLists<2> lists;
  lists.build(p, {kernel_support(settings.kernel), cluster_size(settings.precision), 0, {}});
  PairPassOf<T, 2, gas, WendlandC2, AcousticFlux>(settings).rates(p, lists);
  return p;
}

TEST(Flux, ARiemannSolverGivesItsFormulas) {
  const auto settings = gas_settings(Precision::double_precision);
  const auto p = with_acoustic_flux<double>(settings);
  const KernelFunctions kernel = functions_of(settings.kernel, 2);
  const auto h = p.column(Field::smoothing_length), m = p.column(Field::mass), rho = p.column(Field::density),
             pressure = p.column(Field::pressure), c = p.column(Field::sound_speed);
  const auto reference = [&](std::size_t i) {
    return settings.rules.reference_density[static_cast<std::size_t>(p.label(Label::material)[i])];
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    Vec<2> acceleration = Vec<2>::Zero();
    double heating = 0, acceleration_scale = 0, heating_scale = 0;
    for (std::size_t j = 0; j < p.size(); ++j) {
      const Vec<2> x = p.vector(Field::position, j) - p.vector(Field::position, i),
                   v = p.vector(Field::velocity, j) - p.vector(Field::velocity, i);
      const double r = x.norm();
      if (r == 0) continue;
      const auto slope = [&](double size) { return kernel.norm * kernel.slope(r / size) / (size * size * size); };
      const Vec<2> e = x / r, g = -0.5 * (slope(h[i]) + slope(h[j])) * e;
      const double Z_i = rho[i] * c[i], Z_j = rho[j] * c[j], jump = v.dot(e);
      const double star = (Z_j * pressure[i] + Z_i * pressure[j] - Z_i * Z_j * jump) / (Z_i + Z_j);
      const double u_star = (Z_j * jump - (pressure[j] - pressure[i])) / (Z_i + Z_j);  // beyond that of i
      const double r_i = reference(i) / rho[i], r_j = reference(j) / rho[j];
      const double sum =
          r_i * r_i * pressure[i] + r_j * r_j * pressure[j] + r_i * r_j * (2 * star - pressure[i] - pressure[j]);
      const Vec<2> force = -m[i] / reference(i) * m[j] / reference(j) * sum * g;
      // Of the velocity of the contact only what is along the pair differs from the mean of both.
      const Vec<2> contact = 0.5 * v + (u_star - 0.5 * jump) * e;
      acceleration += force / m[i];
      heating += force.dot(contact) / m[i];
      acceleration_scale += force.norm() / m[i];
      heating_scale += force.norm() * (v.norm() + std::abs(u_star)) / m[i];
    }
    EXPECT_LT((p.vector(Field::acceleration, i) - acceleration).norm(), 3e-14 * acceleration_scale);
    EXPECT_NEAR(p.column(Field::specific_energy_rate)[i], heating, 3e-13 * heating_scale);
  }
}

TEST(Flux, MomentumAndEnergyAreExactWithARiemannSolverToo) {
  const Balance in_double = balance_of(with_acoustic_flux<double>(gas_settings(Precision::double_precision)));
  EXPECT_LT(in_double.momentum, 1e-14);
  EXPECT_LT(in_double.angular_momentum, 1e-13);
  EXPECT_LT(in_double.energy, 1e-13);
  const Balance mixed = balance_of(with_acoustic_flux<float>(gas_settings(Precision::mixed)));
  EXPECT_LT(mixed.momentum, 1e-14);
  EXPECT_LT(mixed.energy, 1e-8);
}

}  // namespace
}  // namespace ejecta
