#include "schemes/pair_pass.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstring>

#include "unit/base/thread_counts.hpp"
#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

constexpr Kernel all_kernels[] = {Kernel::cubic_spline, Kernel::quintic_spline, Kernel::wendland_c2,
                                  Kernel::wendland_c4};
std::vector<double> random_shares(std::size_t n, unsigned seed) {
  Uniform uniform(seed);
  std::vector<double> shares(n);
  for (double& s : shares) s = uniform(0, 1);
  return shares;
}

/// Largest errors of a pass against the reference, each relative to the sum of the magnitudes of the terms.
struct Errors {
  double acceleration = 0, heating = 0, gradient = 0, moment = 0, approach = 0;
};

template <int Dim>
Errors errors_against_reference(std::size_t n, const PairPassSettings& settings) {
  auto p = random_matter<Dim>(n, 21, settings.stress);
  sort_in_space(p, cluster_size(settings.precision));
  if (settings.stress) std::ranges::copy(random_shares(n, 22), p.column(Field::intact_share).begin());
  const Reference<Dim> reference(p, settings);  // before the pass renews the gradients that it reads
  run_rates(p, settings);
  Errors worst;
  const auto keep_largest = [](double& largest, double error) { largest = std::max(largest, error); };
  for (std::size_t i = 0; i < n; ++i) {
    const Sums<Dim> sums = reference.rates(i);
    keep_largest(worst.acceleration,
                 (p.vector(Field::acceleration, i) - sums.acceleration).norm() / sums.acceleration_scale);
    keep_largest(worst.heating, std::abs(p.column(Field::specific_energy_rate)[i] - sums.heating) / sums.heating_scale);
    keep_largest(worst.moment, std::abs(p.column(Field::zeroth_moment)[i] / sums.moment - 1));
    keep_largest(worst.approach,
                 std::abs(p.column(Field::largest_mu)[i] - sums.approach) / std::max(sums.approach, 1.0));
    keep_largest(worst.gradient, (velocity_gradient_of(p, i) - sums.gradient).norm() / sums.gradient_scale);
  }
  return worst;
}

template <int Dim>
void expect_formulas(std::size_t n, const PairPassSettings& settings) {
  const bool mixed = settings.precision == Precision::mixed;
  const double tolerance = mixed ? 3e-6 : 3e-14;
  SCOPED_TRACE(testing::Message() << Dim << "D, kernel " << static_cast<int>(settings.kernel) << ", "
                                  << (mixed ? "mixed" : "double") << ", stress " << settings.stress << ", correction "
                                  << settings.gradient_correction << ", n " << n);
  const Errors errors = errors_against_reference<Dim>(n, settings);
  EXPECT_LT(errors.acceleration, tolerance);
  EXPECT_LT(errors.heating, tolerance);
  EXPECT_LT(errors.gradient, 10 * tolerance);
  EXPECT_LT(errors.moment, 10 * tolerance);
  EXPECT_LT(errors.approach, 10 * tolerance);
}

TEST(PairPass, RatesAreTheFormulasForEveryKernel) {
  for (const Kernel kernel : all_kernels)
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      expect_formulas<2>(150, settings_of(kernel, precision, true, true));
      expect_formulas<3>(200, settings_of(kernel, precision, true, true));
    }
}

TEST(PairPass, RatesAreTheFormulasForGasAndSolidWithAndWithoutCorrection) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const auto& [stress, correction] : {std::pair{false, false}, {true, false}, {true, true}}) {
      expect_formulas<2>(150, settings_of(Kernel::wendland_c2, precision, stress, correction));
      expect_formulas<3>(200, settings_of(Kernel::wendland_c2, precision, stress, correction));
    }
}

TEST(PairPass, LanesBeyondTheEndOfAClusterAddNothing) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const std::size_t n : {2u, 9u, 17u, 31u})
      expect_formulas<3>(n, settings_of(Kernel::cubic_spline, precision, true, true));
}

TEST(PairPass, AGasWithoutGradientsHasTheSameRates) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    auto p = random_matter<3>(200, 23, false);
    auto with = settings_of(Kernel::wendland_c2, precision, false, false), without = with;
    without.velocity_gradient = false;
    // Viscosity by the whole approach, with gradients or without.
    std::ranges::fill(p.column(Field::shock_switch), 1.0);
    auto q = p;
    const Reference<3> reference(p, with);
    const auto column = q.column(Field::velocity_gradient);
    const std::vector<double> untouched(column.begin(), column.end());
    run_rates(p, with);
    run_rates(q, without);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Sums<3> sums = reference.rates(i);
      const double tolerance = precision == Precision::mixed ? 3e-6 : 3e-14;
      EXPECT_LE((p.vector(Field::acceleration, i) - q.vector(Field::acceleration, i)).norm(),
                tolerance * sums.acceleration_scale);
      EXPECT_NEAR(p.column(Field::specific_energy_rate)[i], q.column(Field::specific_energy_rate)[i],
                  tolerance * sums.heating_scale);
      EXPECT_EQ(q.column(Field::velocity_gradient)[i], untouched[i]) << "nobody writes it";
    }
  }
}

template <int Dim>
void expect_density(std::size_t n, Kernel kernel, Precision precision) {
  auto p = random_matter<Dim>(n, 24, false);
  const auto settings = settings_of(kernel, precision, false, false);
  const Reference<Dim> reference(p, settings);
  PairLists<Dim> lists;
  lists.build(p, {kernel_support(kernel), cluster_size(precision), 0, {}});
  make_pair_pass<Dim>(settings)->density(p, lists);
  const double tolerance = precision == Precision::mixed ? 3e-6 : 3e-14;
  for (std::size_t i = 0; i < n; ++i) {
    const Sums<Dim> sums = reference.rates(i);
    EXPECT_NEAR(p.column(Field::density)[i] / sums.density, 1, tolerance);
    EXPECT_NEAR(p.column(Field::zeroth_moment)[i] / sums.moment, 1, 10 * tolerance);
  }
}

TEST(PairPass, DensityIsTheSumOverTheMassesOfNeighbours) {
  for (const Kernel kernel : all_kernels)
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      expect_density<2>(150, kernel, precision);
      expect_density<3>(200, kernel, precision);
    }
}

/// The largest relative difference of the rate of the density by the velocity gradient from that of the sum over
/// masses, in a cloud of one smoothing length.
double error_of_continuity(double alike) {
  auto settings = settings_of(Kernel::wendland_c4, Precision::double_precision, false, false);
  settings.alike = alike;
  auto p = random_matter<3>(500, 25, false);
  std::ranges::fill(p.column(Field::smoothing_length), 1.5 * spacing);
  std::ranges::fill(p.label(Label::material), 0);
  const auto density_after = [&](double dt) {
    auto q = p;
    for (std::size_t i = 0; i < q.size(); ++i)
      q.set_vector(Field::position, i, p.vector(Field::position, i) + dt * p.vector(Field::velocity, i));
    PairLists<3> lists;
    lists.build(q, {kernel_support(settings.kernel), cluster_size(settings.precision), 0, {}});
    make_pair_pass<3>(settings)->density(q, lists);
    return std::vector(q.column(Field::density).begin(), q.column(Field::density).end());
  };
  std::ranges::copy(density_after(0), p.column(Field::density).begin());
  const double dt = 1e-5 * spacing / 100;
  const auto later = density_after(dt), earlier = density_after(-dt);
  run_rates(p, settings);
  double worst = 0, fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double rate = (later[i] - earlier[i]) / (2 * dt);
    worst = std::max(worst, std::abs(-p.column(Field::density)[i] * velocity_gradient_of(p, i).trace() - rate));
    fastest = std::max(fastest, std::abs(rate));
  }
  return worst / fastest;
}

TEST(PairPass, BetweenAlikeDensitiesContinuityIsTheRateOfTheSumOverMasses) {
  EXPECT_LT(error_of_continuity(1e9), 1e-7);
  EXPECT_GT(error_of_continuity(0.1), 0.01) << "weights by volume are others";
}

/// Largest acceleration that one pressure gives to the inner particles of a lattice whose density jumps to a thousandth
/// at x = 0, relative to that of a free face of the thin matter.
double unrest_at_a_contact(double alike) {
  auto settings = settings_of(Kernel::wendland_c2, Precision::double_precision, false, false);
  settings.alike = alike;
  constexpr int wide = 12;
  auto p = random_matter<2>(wide * wide, 25, false);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const int column = static_cast<int>(i) / wide, row = static_cast<int>(i) % wide;
    p.set_vector(Field::position, i, spacing * Vec<2>(column + 0.5 - wide / 2, row + 0.5 - wide / 2));
    p.set_vector(Field::velocity, i, Vec<2>::Zero());
    p.label(Label::material)[i] = 0;
    p.column(Field::smoothing_length)[i] = 1.5 * spacing;
    p.column(Field::pressure)[i] = 1e5;
    p.column(Field::density)[i] = column < wide / 2 ? 1000 : 1;
    p.column(Field::mass)[i] = p.column(Field::density)[i] * spacing * spacing;
  }
  run_rates(p, settings);
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.vector(Field::position, i).cwiseAbs().maxCoeff() < 3 * spacing)
      most = std::max(most, p.vector(Field::acceleration, i).norm());
  return most / (1e5 / spacing);
}

TEST(PairPass, AContactOfVeryDifferentDensitiesIsAtRest) {
  EXPECT_LT(unrest_at_a_contact(4), 1e-11);
  EXPECT_GT(unrest_at_a_contact(1e9), 1) << "weights by mass throw the thin matter off";
}

template <int Dim>
bool same_bits(const Particles<Dim>& p, const Particles<Dim>& q) {
  for (const Field f : p.fields())
    for (int k = 0; k < components(info(f).shape, Dim); ++k)
      if (std::memcmp(p.column(f, k).data(), q.column(f, k).data(), p.size() * sizeof(double)) != 0) return false;
  return true;
}

TEST(PairPass, EveryThreadCountGivesTheSameBits) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    const auto settings = settings_of(Kernel::wendland_c4, precision, true, true);
    std::vector<Particles<3>> results;
    for_thread_counts([&](int) {
      auto p = random_matter<3>(2000, 28, true);
      sort_in_space(p, cluster_size(precision));
      const auto lists = run_rates(p, settings);
      make_pair_pass<3>(settings)->density(p, lists);
      results.push_back(std::move(p));
    });
    EXPECT_TRUE(same_bits(results[0], results[1]));
    EXPECT_TRUE(same_bits(results[0], results[2]));
  }
}

TEST(PairPass, TheCorrectedGradientOfALinearFlowIsExact) {
  Mat<3> A;
  A << 1, -2, 3, 0.5, -1.5, 2.5, -3, 0.25, 4;
  A *= 1e4;
  for (const Kernel kernel : all_kernels)
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      auto p = random_matter<3>(1000, 29, true);
      even_surroundings(p);
      for (std::size_t i = 0; i < p.size(); ++i)
        p.set_vector(Field::velocity, i, A * p.vector(Field::position, i) + Vec<3>(30, 20, 10));
      auto plain = p;
      run_rates(p, settings_of(kernel, precision, true, true));
      run_rates(plain, settings_of(kernel, precision, true, false));
      std::size_t interior = 0;
      double error = 0, plain_error = 0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec<3> cells = p.vector(Field::position, i) / spacing + Vec<3>::Constant(3);  // 0 to 10 along each edge
        if (cells.minCoeff() < 2 || cells.maxCoeff() > 8) continue;
        ++interior;
        error = std::max(error, (velocity_gradient_of(p, i) - A).norm() / A.norm());
        plain_error = std::max(plain_error, (velocity_gradient_of(plain, i) - A).norm() / A.norm());
      }
      EXPECT_GT(interior, 100u);
      EXPECT_LT(error, precision == Precision::mixed ? 1e-5 : 1e-13);
      EXPECT_GT(plain_error, 0.05) << "a random cloud needs the correction";
    }
}

/// Acceleration by the viscosity alone, summed over a compressed cloud; every particle knows its strain from before.
double viscous_force(double shock_switch, double noise) {
  auto p = random_matter<3>(600, 33, true);
  Mat<3> A;
  A << -1, 0.3, 0.1, -0.2, -1.2, 0.2, 0.1, 0.1, -0.9;
  A *= 1e4;
  Uniform uniform(34);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<3> jump = noise * A.norm() * spacing * Vec<3>(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    p.set_vector(Field::velocity, i, A * p.vector(Field::position, i) + jump);
    for (int k = 0; k < 9; ++k) p.column(Field::velocity_gradient, k)[i] = A(k / 3, k % 3);
    p.column(Field::pressure)[i] = 0;
    for (int k = 0; k < deviator_size<3>; ++k) p.column(Field::deviatoric_stress, k)[i] = 0;
    p.column(Field::shock_switch)[i] = shock_switch;
  }
  run_rates(p, settings_of(Kernel::wendland_c2, Precision::double_precision, true, true));
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.vector(Field::acceleration, i).norm();
  return sum;
}

TEST(Viscosity, LeavesSmoothFlowAloneButNotShocksNorDisorder) {
  const double shock = viscous_force(1, 0);
  EXPECT_GT(shock, 0);
  EXPECT_LT(viscous_force(0, 0), 1e-12 * shock) << "a linear flow is smooth";
  EXPECT_NEAR(viscous_force(0.5, 0), 0.5 * shock, 0.1 * shock) << "beyond the linear term of the viscosity";
  EXPECT_GT(viscous_force(0, 3), 0.3 * viscous_force(1, 3)) << "what a disordered lattice does is damped";
}

/// A cloud with ellipsoids of aspect up to `aspect` turned at random, moving as A x; the largest error of the corrected
/// gradient, relative to A, where the neighbours span space.
template <int Dim>
double error_with_tensors(Kernel kernel, Precision precision, const Mat<Dim>& A, double aspect) {
  auto p = random_matter<Dim>(800, 31, true, 1.5, {Field::smoothing_metric});
  even_surroundings(p);
  Uniform uniform(32);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Mat<Dim> random = Mat<Dim>::NullaryExpr([&] { return uniform(-1, 1); });
    const Mat<Dim> turn = Eigen::SelfAdjointEigenSolver<Mat<Dim>>(random + random.transpose()).eigenvectors();
    Vec<Dim> axes = Vec<Dim>::Ones();
    axes[0] = uniform(1, aspect);
    axes *= 2.4 * spacing / std::pow(axes[0], 1.0 / Dim);
    p.set_symmetric(Field::smoothing_metric, i,
                    turn * axes.array().square().inverse().matrix().asDiagonal() * turn.transpose());
    p.column(Field::smoothing_length)[i] = std::pow(axes.prod(), 1.0 / Dim);
    p.set_vector(Field::velocity, i, A * p.vector(Field::position, i));
  }
  auto settings = settings_of(kernel, precision, true, true);
  settings.asph = true;
  run_rates(p, settings);
  const double edge = spacing * std::pow(static_cast<double>(p.size()), 1.0 / Dim);
  std::size_t interior = 0;
  double error = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim> place = p.vector(Field::position, i) / edge;  // -0.3 to 0.7
    if (place.minCoeff() < -0.1 || place.maxCoeff() > 0.5) continue;
    ++interior;
    error = std::max(error, (velocity_gradient_of(p, i) - A).norm() / A.norm());
  }
  EXPECT_GT(interior, 100u);
  return error;
}

TEST(PairPass, TheCorrectedGradientOfALinearFlowIsExactWithTensors) {
  Mat<3> A;
  A << 1, -2, 3, 0.5, -1.5, 2.5, -3, 0.25, 4;
  A *= 1e4;
  for (const Kernel kernel : all_kernels)
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      const double limit = precision == Precision::mixed ? 3e-5 : 1e-12;
      EXPECT_LT(error_with_tensors<2>(kernel, precision, A.topLeftCorner<2, 2>(), 3), limit);
      EXPECT_LT(error_with_tensors<3>(kernel, precision, A, 3), limit);
    }
}

TEST(PairPass, AQuarterTurnTurnsTheRates) {
  // (x, y, z) -> (-y, x, z)
  const auto turn = [](const Vec<3>& v) { return Vec<3>(-v[1], v[0], v[2]); };
  const auto settings = settings_of(Kernel::wendland_c2, Precision::double_precision, true, true);
  Mat<3> rotation;
  rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  auto p = random_matter<3>(300, 30, true), q = p;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Mat<3> L = rotation * velocity_gradient_of(p, i) * rotation.transpose();
    for (int k = 0; k < 9; ++k) q.column(Field::velocity_gradient, k)[i] = L(k / 3, k % 3);
    q.set_vector(Field::position, i, turn(p.vector(Field::position, i)));
    q.set_vector(Field::velocity, i, turn(p.vector(Field::velocity, i)));
    const auto s = [&](int k) { return p.column(Field::deviatoric_stress, k)[i]; };  // xx yy xy xz yz
    const double turned[] = {s(1), s(0), -s(2), -s(4), s(3)};
    for (int k = 0; k < 5; ++k) q.column(Field::deviatoric_stress, k)[i] = turned[k];
  }
  const Reference<3> reference(p, settings);
  run_rates(p, settings);
  run_rates(q, settings);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Sums<3> sums = reference.rates(i);
    EXPECT_LT((q.vector(Field::acceleration, i) - turn(p.vector(Field::acceleration, i))).norm(),
              1e-13 * sums.acceleration_scale);
    EXPECT_NEAR(q.column(Field::specific_energy_rate)[i], p.column(Field::specific_energy_rate)[i],
                1e-13 * sums.heating_scale);
    const Mat<3> L = rotation * velocity_gradient_of(p, i) * rotation.transpose();
    EXPECT_LT((velocity_gradient_of(q, i) - L).norm(), 1e-11 * (L.norm() + sums.gradient_scale));
  }
}

TEST(PairPass, AParticleAloneFeelsNothing) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const Kernel kernel : all_kernels) {
      auto p = random_matter<3>(1, 31, true);
      const auto settings = settings_of(kernel, precision, true, true);
      const auto lists = run_rates(p, settings);
      EXPECT_EQ(p.vector(Field::acceleration, 0), Vec<3>(0, 0, 0));
      EXPECT_EQ(p.column(Field::specific_energy_rate)[0], 0);
      EXPECT_EQ(p.column(Field::zeroth_moment)[0], 0);
      EXPECT_EQ(p.column(Field::largest_mu)[0], 0);
      EXPECT_EQ(velocity_gradient_of(p, 0), Mat<3>::Zero());
      make_pair_pass<3>(settings)->density(p, lists);
      const double self =
          with_kernel(kernel, [](auto k) { return decltype(k)::template norm<3> * decltype(k)::value(0.0); });
      const double h = p.column(Field::smoothing_length)[0];
      EXPECT_NEAR(p.column(Field::density)[0] / (p.column(Field::mass)[0] * self / (h * h * h)), 1, 1e-6);
    }
}

TEST(PairPass, CoincidentParticlesStayFinite) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const Kernel kernel : all_kernels) {
      auto p = random_matter<3>(4, 32, true);
      for (std::size_t i = 1; i < 4; ++i) p.set_vector(Field::position, i, p.vector(Field::position, 0));
      run_rates(p, settings_of(kernel, precision, true, true));
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(p.vector(Field::acceleration, i), Vec<3>(0, 0, 0));
        EXPECT_TRUE(std::isfinite(p.column(Field::specific_energy_rate)[i]));
        EXPECT_TRUE(velocity_gradient_of(p, i).allFinite());
      }
    }
}

}  // namespace
}  // namespace ejecta
