#include "schemes/riemann_flux.hpp"

#include <gtest/gtest.h>

#include "material/exact_riemann.hpp"
#include "schemes/lattice_sums.hpp"
#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

constexpr double gamma_of_air = 1.4;

PairPassSettings godunov(PairRiemann riemann, PairLimiter limiter, PairFaces faces) {
  auto settings = settings_of(Kernel::wendland_c2, Precision::double_precision, false, false);
  settings.velocity_gradient = false;
  settings.godunov = {riemann, limiter, faces, 1.02, 0.97};
  return settings;
}

const std::vector<Field> slopes{Field::density_gradient, Field::pressure_gradient, Field::face_correction};

/// An ideal gas with enough neighbours around every particle.
template <int Dim>
Particles<Dim> random_gas(std::size_t n, unsigned seed, std::vector<Field> more = slopes) {
  auto p = random_matter<Dim>(n, seed, false, 2, more);
  even_surroundings(p);
  Uniform uniform(seed + 7);
  for (std::size_t i = 0; i < n; ++i) {
    p.column(Field::pressure)[i] = uniform(1e8, 1e9);
    p.column(Field::density)[i] *= uniform(0.8, 1.2);
    p.column(Field::sound_speed)[i] =
        std::sqrt(gamma_of_air * p.column(Field::pressure)[i] / p.column(Field::density)[i]);
    for (int a = 0; a < Dim; ++a) p.column(Field::velocity, a)[i] *= 10;
  }
  return p;
}

template <int Dim>
void run(Particles<Dim>& p, const PairPassSettings& settings, const Boundary& boundary = {}) {
  PairLists<Dim> lists;
  lists.build(p, {kernel_support(settings.kernel), cluster_size(settings.precision), 0, boundary});
  const auto pass = make_pair_pass<Dim>(settings);
  pass->slopes(p, lists);
  pass->rates(p, lists);
}

/// grad_i W of a pair, the mean of both.
template <int Dim>
Vec<Dim> kernel_gradient(const Particles<Dim>& p, const KernelFunctions& kernel, std::size_t i, std::size_t j) {
  const Vec<Dim> x = p.vector(Field::position, j) - p.vector(Field::position, i);
  const double r = x.norm();
  if (r == 0) return Vec<Dim>::Zero();
  const auto slope = [&](std::size_t k) {
    const double h = p.column(Field::smoothing_length)[k];
    return kernel.norm * kernel.slope(r / h) / std::pow(h, Dim + 1);
  };
  return -0.5 * (slope(i) + slope(j)) / r * x;
}

double limited(double slope, double difference, PairLimiter limiter) {
  if (limiter == PairLimiter::none) return 0;
  const double other = 2 * slope - difference;  // what the slope makes of the change on the other side
  if (slope * difference <= 0 || other * difference <= 0) return 0;
  return std::copysign(std::min({std::abs(slope), 2 * std::abs(other), 2 * std::abs(difference)}), slope);
}

template <int Dim>
void expect_formulas(PairLimiter limiter, PairFaces faces, PairRiemann solver) {
  const auto settings = godunov(solver, limiter, faces);
  auto p = random_gas<Dim>(Dim == 2 ? 300 : 400, 91);
  sort_in_space(p, cluster_size(settings.precision));
  run(p, settings);
  const KernelFunctions kernel = functions_of(settings.kernel, Dim);
  const std::size_t n = p.size();
  const auto rho = p.column(Field::density), P = p.column(Field::pressure), m = p.column(Field::mass);
  std::vector<Vec<Dim>> density_slope(n), pressure_slope(n);
  std::vector<Mat<Dim>> strain(n), B(n);
  for (std::size_t i = 0; i < n; ++i) {
    Mat<Dim> M = Mat<Dim>::Zero(), L = M;
    Vec<Dim> of_density = Vec<Dim>::Zero(), of_pressure = of_density;
    double squares = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Vec<Dim> g = m[j] / rho[j] * kernel_gradient(p, kernel, i, j);
      M += (p.vector(Field::position, j) - p.vector(Field::position, i)) * g.transpose();
      L += (p.vector(Field::velocity, j) - p.vector(Field::velocity, i)) * g.transpose();
      of_density += (rho[j] - rho[i]) * g;
      of_pressure += (P[j] - P[i]) * g;
      squares += g.squaredNorm();
    }
    B[i] = Inverse<Dim>::of(M, squares * p.column(Field::smoothing_length)[i] * p.column(Field::smoothing_length)[i]).Q;
    density_slope[i] = B[i] * of_density;
    pressure_slope[i] = B[i] * of_pressure;
    strain[i] = L * B[i].transpose();
    const double scale = rho[i] / spacing;
    EXPECT_LT((p.vector(Field::density_gradient, i) - density_slope[i]).norm(), 1e-11 * scale);
    EXPECT_LT((p.vector(Field::pressure_gradient, i) - pressure_slope[i]).norm(), 1e-11 * 1e9 / spacing);
    EXPECT_LT((p.tensor(Field::velocity_gradient, i) - strain[i]).norm(), 1e-11 * 1e3 / spacing);
  }
  for (std::size_t i = 0; i < n; ++i) {
    Vec<Dim> acceleration = Vec<Dim>::Zero();
    double heating = 0, acceleration_scale = 0, heating_scale = 0, approach = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Vec<Dim> x = p.vector(Field::position, j) - p.vector(Field::position, i),
                     v = p.vector(Field::velocity, j) - p.vector(Field::velocity, i),
                     g = kernel_gradient(p, kernel, i, j);
      if (g.isZero(0)) continue;
      const Vec<Dim> e = x.normalized(),
                     face = faces == PairFaces::kernel ? Vec<Dim>(g / 0.97) : Vec<Dim>(0.5 * (B[i] + B[j]) * g);
      const double u = v.dot(e);
      const auto change = [&](std::size_t k, const std::vector<Vec<Dim>>& slope, double difference) {
        return limited(slope[k].dot(x), difference, limiter);
      };
      const double u_i = limited(e.dot(strain[i] * x), u, limiter), u_j = limited(e.dot(strain[j] * x), u, limiter);
      const GasState ours{rho[i] + 0.5 * change(i, density_slope, rho[j] - rho[i]), 0.5 * u_i,
                          P[i] + 0.5 * change(i, pressure_slope, P[j] - P[i])},
          theirs{rho[j] - 0.5 * change(j, density_slope, rho[j] - rho[i]), u - 0.5 * u_j,
                 P[j] - 0.5 * change(j, pressure_slope, P[j] - P[i])};
      double star = 0, u_star = 0;
      if (solver == PairRiemann::exact) {
        const ExactRiemann riemann(ours, theirs, gamma_of_air);
        ASSERT_FALSE(riemann.vacuum());
        star = riemann.star_pressure();
        u_star = riemann.star_velocity();
      } else {
        const auto gas = [](const GasState& of) {
          const auto all = [](double a) { return simd::all<simd::Doubles>(a); };
          return MeetingGas<simd::Doubles>{all(of.density), all(of.pressure), all(gamma_of_air)};
        };
        const auto found =
            approximate_star(gas(ours), gas(theirs), simd::all<simd::Doubles>(theirs.velocity - ours.velocity));
        star = found.pressure[0];
        u_star = ours.velocity - found.faster_left[0];
      }
      const Vec<Dim> force = -2 * m[i] / rho[i] * m[j] / rho[j] * star * face,
                     contact = 0.5 * v + (u_star - 0.5 * u) * e;
      acceleration += force / m[i];
      heating += force.dot(contact) / m[i];
      acceleration_scale += force.norm() / m[i];
      heating_scale += force.norm() * (v.norm() + std::abs(u_star)) / m[i];
      if (x.norm() < 2 * p.column(Field::smoothing_length)[i]) approach = std::min(approach, u);
    }
    EXPECT_LT((p.vector(Field::acceleration, i) - acceleration).norm(), 1e-9 * acceleration_scale);
    EXPECT_NEAR(p.column(Field::specific_energy_rate)[i], heating, 1e-9 * heating_scale);
    EXPECT_NEAR(p.column(Field::largest_mu)[i], -approach, 1e-9 * 1e3);
  }
}

TEST(RiemannFlux, IsWhatItsFormulasSay) {
  using enum PairLimiter;
  expect_formulas<2>(none, PairFaces::kernel, PairRiemann::exact);
  expect_formulas<2>(monotonised_central, PairFaces::renormalised, PairRiemann::exact);
  expect_formulas<2>(monotonised_central, PairFaces::kernel, PairRiemann::approximate);
  expect_formulas<3>(monotonised_central, PairFaces::renormalised, PairRiemann::approximate);
}

/// Every way to choose.
template <class Body>
void for_settings(Body&& body) {
  for (const auto riemann : {PairRiemann::approximate, PairRiemann::exact})
    for (const auto limiter : {PairLimiter::monotonised_central, PairLimiter::inutsuka, PairLimiter::none})
      for (const auto faces : {PairFaces::renormalised, PairFaces::kernel}) body(godunov(riemann, limiter, faces));
}

TEST(RiemannFlux, BothOfAPairFeelTheSameForceBitForBit) {
  for_settings([](const PairPassSettings& settings) {
    // Pairs far from each other, of one mass: accelerations are forces.
    constexpr std::size_t pairs = 200;
    auto p = random_gas<2>(2 * pairs, 5);
    Uniform uniform(6);
    for (std::size_t k = 0; k < pairs; ++k)
      for (std::size_t i : {2 * k, 2 * k + 1}) {
        p.set_vector(Field::position, i,
                     Vec<2>(spacing * (static_cast<double>(k) * 50 + uniform(0, 1)), spacing * uniform(0, 1)));
        p.column(Field::mass)[i] = 1.0 / 1024;
        p.label(Label::material)[i] = 0;
      }
    p.set_material_ranges({{0, 2 * pairs}, {2 * pairs, 2 * pairs}});
    run(p, settings);
    bool any = false;
    for (std::size_t k = 0; k < pairs; ++k) {
      const Vec<2> one = p.vector(Field::acceleration, 2 * k), other = p.vector(Field::acceleration, 2 * k + 1);
      any = any || !one.isZero(0);
      for (int a = 0; a < 2; ++a) ASSERT_EQ(one[a], -other[a]);
    }
    EXPECT_TRUE(any);
  });
}

TEST(RiemannFlux, MomentumAndEnergyAreExact) {
  for_settings([](const PairPassSettings& settings) {
    auto plane = random_gas<2>(600, 71);
    run(plane, settings);
    auto space = random_gas<3>(600, 72);
    run(space, settings);
    EXPECT_LT(balance_of(plane).momentum, 1e-14);
    EXPECT_LT(balance_of(plane).energy, 1e-13);
    EXPECT_LT(balance_of(space).momentum, 1e-14);
    EXPECT_LT(balance_of(space).energy, 1e-13);
    if (settings.godunov->faces == PairFaces::kernel) {
      EXPECT_LT(balance_of(plane).angular_momentum, 1e-13);
    }
  });
}

TEST(RiemannFlux, TensorsDoTheSame) {
  for_settings([](PairPassSettings settings) {
    auto p = random_gas<2>(
        600, 73, {Field::density_gradient, Field::pressure_gradient, Field::face_correction, Field::smoothing_metric});
    random_ellipsoids(p, 3, 74);
    settings.asph = true;
    run(p, settings);
    EXPECT_LT(balance_of(p).momentum, 1e-14);
    EXPECT_LT(balance_of(p).energy, 1e-13);
  });
}

/// du_i/dt = sum_j m_j (H_i + H_j)/rho_ij (u_i - u_j) x_ij.grad W/r^2 on top of the heat of the flux, and what one
/// gains the others lose.
template <int Dim>
void expect_conduction(Kernel kernel, double linear, double quadratic) {
  auto settings = godunov({}, {}, {});
  settings.kernel = kernel;
  std::vector<Field> fields = slopes;
  fields.push_back(Field::specific_energy);
  auto p = random_gas<Dim>(Dim == 2 ? 300 : 400, 57, fields);
  sort_in_space(p, cluster_size(settings.precision));
  Uniform uniform(3);
  for (double& u : p.column(Field::specific_energy)) u = uniform(1e5, 1e6);
  run(p, settings);
  const std::vector<double> without(p.column(Field::specific_energy_rate).begin(),
                                    p.column(Field::specific_energy_rate).end());
  settings.godunov->linear_conduction = linear;
  settings.godunov->quadratic_conduction = quadratic;
  run(p, settings);
  const KernelFunctions functions = functions_of(kernel, Dim);
  const auto h = p.column(Field::smoothing_length), c = p.column(Field::sound_speed), m = p.column(Field::mass),
             rho = p.column(Field::density), u = p.column(Field::specific_energy);
  const auto H = [&](std::size_t i) {
    const double divergence = p.tensor(Field::velocity_gradient, i).trace();
    return linear * h[i] * c[i] + quadratic * h[i] * h[i] * (std::abs(divergence) - divergence);
  };
  double sum = 0, sizes = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    double expected = 0, scale = 0;
    for (std::size_t j = 0; j < p.size(); ++j) {
      const Vec<Dim> x = p.vector(Field::position, i) - p.vector(Field::position, j);
      if (i == j) continue;
      const double term = m[j] * (H(i) + H(j)) / (0.5 * (rho[i] + rho[j])) * (u[i] - u[j]) *
                          x.dot(kernel_gradient(p, functions, i, j)) / x.squaredNorm();
      expected += term;
      scale += std::abs(term);
    }
    const double found = p.column(Field::specific_energy_rate)[i] - without[i];
    EXPECT_NEAR(found, expected, 1e-11 * (scale + std::abs(without[i])));
    sum += m[i] * found;
    sizes += m[i] * (scale + std::abs(without[i]));
  }
  EXPECT_LT(std::abs(sum), 1e-14 * sizes);
}

TEST(RiemannFlux, ConductsHeatAsAskedFor) {
  for (const Kernel kernel : {Kernel::wendland_c2, Kernel::gaussian}) {
    expect_conduction<2>(kernel, 0.25, 0);
    expect_conduction<2>(kernel, 0.2, 0.4);
    expect_conduction<3>(kernel, 0, 0.5);
  }
}

/// A periodic square lattice of 16 x 16 particles with 1.3 in h.
Particles<2> lattice(Boundary& boundary, std::vector<Field> more = {}) {
  constexpr int rows = 16;
  more.insert(more.end(), slopes.begin(), slopes.end());
  auto p = random_gas<2>(rows * rows, 8, more);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const auto k = static_cast<std::size_t>(rows * i + j);
      p.set_vector(Field::position, k, spacing * Vec<2>(i, j));
      p.set_vector(Field::velocity, k, Vec<2>(300, -200));
      p.column(Field::mass)[k] = spacing * spacing;
      p.column(Field::density)[k] = 1;
      p.column(Field::pressure)[k] = 1;
      p.column(Field::sound_speed)[k] = std::sqrt(gamma_of_air);
      p.column(Field::smoothing_length)[k] = 1.3 * spacing;
    }
  boundary.lower = boundary.upper = {BoundaryKind::periodic, BoundaryKind::periodic, BoundaryKind::open};
  boundary.min = {-0.5 * spacing, -0.5 * spacing, 0};
  boundary.max = {(rows - 0.5) * spacing, (rows - 0.5) * spacing, 0};
  return p;
}

TEST(RiemannFlux, AUniformStateStaysAsItIs) {
  for_settings([](const PairPassSettings& settings) {
    Boundary boundary;
    auto p = lattice(boundary);
    run(p, settings, boundary);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_LT(p.vector(Field::acceleration, i).norm(), 1e-12 / spacing);
      EXPECT_LT(std::abs(p.column(Field::specific_energy_rate)[i]), 1e-10 / spacing);
    }
  });
}

/// Of gas that fills space, what its faces sweep is its change of volume: of a uniform strain of the velocity -tr A,
/// and at a uniform pressure the work on it is the heat, P/rho times that.
TEST(RiemannFlux, VolumesGoByWhatTheFacesSweep) {
  Boundary boundary;
  auto p = lattice(boundary, {Field::compression_rate});
  auto settings = godunov(PairRiemann::exact, PairLimiter::monotonised_central, PairFaces::renormalised);
  settings.godunov->lattice_density = lattice_sums(settings.kernel, 2, 1.3).density;
  Mat<2> A;
  A << -30, 12, 5, 80;
  for (std::size_t i = 0; i < p.size(); ++i) p.set_vector(Field::velocity, i, A * p.vector(Field::position, i));
  run(p, settings, boundary);
  int inside = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<2> x = p.vector(Field::position, i) / spacing;
    if (x.minCoeff() < 6 || x.maxCoeff() > 9) continue;  // the velocity jumps where the lattice ends
    ++inside;
    EXPECT_NEAR(p.column(Field::compression_rate)[i], -A.trace(), 1e-9 * A.norm());
    EXPECT_NEAR(p.column(Field::specific_energy_rate)[i], -A.trace(), 1e-9 * A.norm());
  }
  EXPECT_EQ(inside, 16);
}

/// Whatever volumes have gained or lost is made good at the rate of sound crossings of h, and a contact stays as it is.
TEST(RiemannFlux, VolumesAreHeldToFillSpace) {
  Boundary boundary;
  auto settings = godunov({}, {}, {});
  settings.godunov->lattice_density = lattice_sums(settings.kernel, 2, 1.3).density;
  for (const double too_large : {1.0, 1.05, 0.9}) {
    auto p = lattice(boundary, {Field::compression_rate});
    for (std::size_t i = 0; i < p.size(); ++i) p.column(Field::density)[i] /= too_large;
    run(p, settings, boundary);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double crossing = p.column(Field::sound_speed)[i] / p.column(Field::smoothing_length)[i];
      ASSERT_NEAR(p.column(Field::compression_rate)[i], crossing * std::log(too_large), 1e-10 * crossing);
    }
  }
}

/// A volume that is out of all proportion is brought back to 1.7 or 0.6 times what counting its neighbours gives.
TEST(RiemannFlux, AStrayDensityIsBroughtBack) {
  Boundary boundary;
  auto settings = godunov({}, {}, {});
  settings.godunov->lattice_density = lattice_sums(settings.kernel, 2, 1.3).density;
  auto p = lattice(boundary, {Field::compression_rate});
  p.column(Field::density)[40] = 10;
  p.column(Field::density)[90] = 0.01;
  p.column(Field::density)[140] = 1.5;
  run(p, settings, boundary);
  EXPECT_NEAR(p.column(Field::density)[40], 1.7, 1e-12);
  EXPECT_NEAR(p.column(Field::density)[90], 0.6, 1e-12);
  EXPECT_EQ(p.column(Field::density)[140], 1.5);
}

TEST(RiemannFlux, AJumpOfTheDensityBetweenLikeVolumesStaysOne) {
  Boundary boundary;
  auto p = lattice(boundary);
  auto settings = godunov({}, {}, {});
  const LatticeSums sums = lattice_sums(settings.kernel, 2, 1.3);
  settings.godunov->lattice_density = sums.density;
  for (std::size_t i = 0; i < p.size(); i += 3) p.column(Field::mass)[i] *= 800;
  PairLists<2> lists;
  lists.build(p, {kernel_support(settings.kernel), cluster_size(settings.precision), 0, boundary});
  make_pair_pass<2>(settings)->density(p, lists);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(p.column(Field::density)[i], p.column(Field::mass)[i] / (spacing * spacing),
                1e-12 * p.column(Field::density)[i]);
}

/// Behind a symmetry plane there is what a mirror shows.
TEST(RiemannFlux, MirrorsActLikeTheirParticles) {
  for_settings([](const PairPassSettings& settings) {
    constexpr std::size_t n = 300;
    auto half = random_gas<2>(n, 21);
    for (std::size_t i = 0; i < n; ++i) half.column(Field::position)[i] += 0.35 * spacing * std::sqrt(n);
    double least = 0;
    for (const double x : half.column(Field::position)) least = std::min(least, x);
    for (double& x : half.column(Field::position)) x -= least - 0.01 * spacing;
    Particles<2> both;
    both.allocate(2 * n, half.fields());
    for (std::size_t i = 0; i < n; ++i)
      for (const std::size_t k : {i, i + n}) {
        for (const Field f : half.fields())
          for (int c = 0; c < components(info(f).shape, 2); ++c) both.column(f, c)[k] = half.column(f, c)[i];
        both.label(Label::material)[k] = both.label(Label::body)[k] = half.label(Label::material)[i];
        if (k == i) continue;
        both.column(Field::position)[k] *= -1;
        both.column(Field::velocity)[k] *= -1;
      }
    both.set_material_ranges({{0, 2 * n}});
    half.set_material_ranges({{0, n}});
    run(both, settings);
    Boundary boundary;
    boundary.lower[0] = BoundaryKind::symmetry;
    boundary.min = {0, 0, 0};
    run(half, settings, boundary);
    for (std::size_t i = 0; i < n; ++i) {
      const double scale = both.vector(Field::acceleration, i).norm() + 1e9;
      ASSERT_LT((half.vector(Field::acceleration, i) - both.vector(Field::acceleration, i)).norm(), 1e-9 * scale);
    }
  });
}

}  // namespace
}  // namespace ejecta
