#include "material/eos_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "material/strength_loop.hpp"

namespace ejecta {
namespace {

constexpr IdealGas air{1.4, 1.2};
constexpr Tillotson basalt{2700, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5};
constexpr MieGrueneisen steel{
    .rho0 = 7900, .c0 = 4570, .S1 = 1.49, .gamma0 = 1.93, .b = 0.5, .heat_capacity = 450, .melt_temperature = 2380};
constexpr Elastic stiff{.shear_modulus = 77e9, .bulk_modulus = 160e9};

/// The cells of a grid: arrays of its own, of more cells than one thread takes.
struct Cells {
  std::vector<double> density, specific_energy, reacted, pressure, sound_speed, distension, stress_factor,
      shear_modulus;

  static auto all() {
    return std::array{&Cells::density,     &Cells::specific_energy, &Cells::reacted,       &Cells::pressure,
                      &Cells::sound_speed, &Cells::distension,      &Cells::stress_factor, &Cells::shear_modulus};
  }

  Cells() = default;
  /// Between half and twice of a density [kg/m^3], and up to an energy [J/kg].
  Cells(double rho, double most) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int k = 0; k < 3000; ++k) {
      density.push_back(rho * (0.5 + 1.5 * uniform(random)));
      specific_energy.push_back(most * uniform(random));
      reacted.push_back(uniform(random));
    }
    pressure = sound_speed = std::vector<double>(density.size(), -1);
  }
  /// One of them alone.
  Cells alone(std::size_t k) const {
    Cells one;
    for (const auto column : all())
      if (!(this->*column).empty()) (one.*column).push_back((this->*column)[k]);
    return one;
  }
  EosColumns columns() {
    return {.density = density,
            .specific_energy = specific_energy,
            .reacted = reacted,
            .pressure = pressure,
            .sound_speed = sound_speed,
            .distension = distension,
            .stress_factor = stress_factor,
            .shear_modulus = shear_modulus};
  }
};

Material solid(const Eos& eos) {
  Material material;
  material.eos = eos;
  material.elastic = stiff;
  return material;
}

/// Brings the cells to their states. A cell evaluated alone, as a span of one, has the same bits.
std::int64_t evaluate(const Material& material, Cells& cells, const DistensionSearch& search = {}) {
  const Cells before = cells;
  const std::int64_t lost = equation_of_state(material, cells.columns(), search);
  for (std::size_t k = 0; k < cells.density.size(); k += 7) {
    Cells one = before.alone(k);
    const Cells after = cells.alone(k);
    equation_of_state(material, one.columns(), search);
    for (const auto column : Cells::all()) EXPECT_EQ(one.*column, after.*column) << k;
  }
  return lost;
}

/// Equal but for what a compiler makes of a b + c in another place.
void expect_state(const Cells& cells, std::size_t k, double pressure, double sound_speed) {
  const double stiffness = cells.density[k] * sound_speed * sound_speed;
  ASSERT_NEAR(cells.pressure[k], pressure, 1e-12 * (std::abs(pressure) + stiffness)) << k;
  ASSERT_NEAR(cells.sound_speed[k], sound_speed, 1e-12 * sound_speed) << k;
}

template <class EosT>
void expect_dense_states(const EosT& eos, Material material, double most) {
  material.eos = eos;
  Cells cells(eos.reference_density(), most);
  EXPECT_EQ(evaluate(material, cells), 0);
  for (std::size_t k = 0; k < cells.density.size(); ++k) {
    const double rho = cells.density[k];
    const EosPoint point = eos.evaluate(rho, cells.specific_energy[k]);
    const double fluid = sound_speed(point, rho, eos.sound_speed_floor());
    const double shear = material.elastic ? material.elastic->shear_modulus : 0;
    expect_state(cells, k, point.pressure, std::sqrt(fluid * fluid + 4 * shear / (3 * std::max(rho, 7900.0))));
  }
}

TEST(EosLoop, GivesCellsTheStatesOfTheModels) {
  expect_dense_states(air, {}, 1e6);
  expect_dense_states(basalt, {}, 30e6);
  expect_dense_states(steel, solid(steel), 1e6);
  expect_dense_states(LinearEos{1010, 852, 0.5}, {}, 1e5);
}

TEST(EosLoop, CrushesPorousCells) {
  Material pumice = solid(basalt);
  pumice.porosity = Porosity{.curve = CrushCurve::quadratic(3, 1e6, 200e6), .sound_speed = 500};
  const DistensionSearch search{DistensionSolver::safe_newton, 1e-13};
  Cells cells(900, 1e6);
  cells.distension = std::vector<double>(cells.density.size(), 2.5);
  cells.stress_factor = cells.shear_modulus = std::vector<double>(cells.density.size(), -1);
  EXPECT_EQ(evaluate(pumice, cells, search), 0);
  int crushed = 0;
  for (std::size_t k = 0; k < cells.density.size(); ++k) {
    const double rho = cells.density[k], alpha = cells.distension[k];
    const DistensionResult r =
        solve_distension(pumice.porosity->curve, basalt, rho, cells.specific_energy[k], 2.5, search);
    ASSERT_NEAR(alpha, r.alpha, 1e-11) << k;
    const EosPoint solid = basalt.evaluate(alpha * rho, cells.specific_energy[k]);
    const double fluid = sound_speed(solid, alpha * rho, basalt.sound_speed_floor());
    const double speed = std::sqrt(fluid * fluid + 4 * 77e9 / (3 * std::max(alpha * rho, 2700.0)));
    ASSERT_NEAR(cells.pressure[k], solid.pressure / alpha, 1e-12 * rho * speed * speed) << k;
    ASSERT_NEAR(cells.sound_speed[k], porous_sound_speed(*pumice.porosity, speed, alpha), 1e-11 * speed) << k;
    ASSERT_NEAR(cells.stress_factor[k], stress_factor(pumice.porosity->curve, r.solid, rho, r.alpha), 1e-7) << k;
    ASSERT_EQ(cells.shear_modulus[k], 77e9) << k;
    crushed += alpha < 2.5;
  }
  EXPECT_GT(crushed, 1000);
  EXPECT_LT(crushed, 4900);
}

TEST(EosLoop, CountsTheDistensionsThatWereNotFound) {
  Material pumice = solid(basalt);
  pumice.porosity = Porosity{.curve = CrushCurve::quadratic(3, 1e6, 200e6)};
  const DistensionSearch search{DistensionSolver::newton, 1e-14};
  Cells cells(900, 1e6);
  cells.distension = std::vector<double>(cells.density.size(), 3);
  const Cells before = cells;
  std::int64_t lost = 0;
  for (std::size_t k = 0; k < cells.density.size(); ++k) {
    Cells one = before.alone(k);
    lost += equation_of_state(pumice, one.columns(), search);
  }
  EXPECT_GT(lost, 0);
  EXPECT_EQ(evaluate(pumice, cells, search), lost);
}

TEST(EosLoop, VariesTheShearModulus) {
  const SteinbergGuinan law{.yield_stress = 0.34e9,
                            .yield_limit = 2.5e9,
                            .hardening = 43,
                            .hardening_exponent = 0.35,
                            .stiffening = 0.0226e-9,
                            .softening = 0.455e-3};
  Material material = solid(steel);
  material.strength = law;
  Cells cells(7900, 1e6);
  cells.shear_modulus = std::vector<double>(cells.density.size(), -1);
  evaluate(material, cells);
  for (std::size_t k = 0; k < cells.density.size(); ++k) {
    const double rho = cells.density[k], e = cells.specific_energy[k];
    const EosPoint point = steel.evaluate(rho, e);
    const double shear = 77e9 * law.shear_factor(point.pressure, rho / 7900, warmth(steel, rho, e));
    ASSERT_NEAR(cells.shear_modulus[k], shear, 1e-10 * 77e9) << k;
    const double fluid = sound_speed(point, rho, steel.sound_speed_floor());
    expect_state(cells, k, point.pressure,
                 std::sqrt(fluid * fluid + 4 * cells.shear_modulus[k] / (3 * std::max(rho, 7900.0))));
  }
}

/// Two ideal gases, one of which turns into the other and sets energy free.
struct Burning {
  IdealGas fresh{1.3, 1.2}, burnt{1.2, 1.2};
  double release = 3e6;  ///< J/kg

  EosPoint evaluate(double rho, double e, double reacted = 0) const {
    const double hot = e + reacted * release;
    const EosPoint a = fresh.evaluate(rho, hot), b = burnt.evaluate(rho, hot);
    const auto mixed = [&](double of_fresh, double of_burnt) { return of_fresh + reacted * (of_burnt - of_fresh); };
    return {mixed(a.pressure, b.pressure), mixed(a.dP_drho, b.dP_drho), mixed(a.dP_de, b.dP_de)};
  }
  double reference_density() const { return 1.2; }
  double sound_speed_floor() const { return 0; }
};
static_assert(reacts<Burning>);
static_assert(!reacts<IdealGas> && !reacts<Tillotson> && !reacts<MieGrueneisen> && !reacts<LinearEos>);

TEST(EosLoop, FollowsAReaction) {
  const Burning mixture;
  Cells cells(1.2, 1e6);
  cells.reacted[0] = 0;
  cells.reacted[1] = 1;
  dense_states(mixture, ConstantShear{0}, cells.columns());
  for (std::size_t k = 0; k < cells.density.size(); ++k) {
    const double rho = cells.density[k];
    const EosPoint point = mixture.evaluate(rho, cells.specific_energy[k], cells.reacted[k]);
    expect_state(cells, k, point.pressure, sound_speed(point, rho, 0));
  }
  const auto is = [&](std::size_t k, const IdealGas& gas, double e) {
    EXPECT_DOUBLE_EQ(cells.pressure[k], gas.evaluate(cells.density[k], e).pressure);
    EXPECT_DOUBLE_EQ(cells.sound_speed[k], sound_speed(gas.evaluate(cells.density[k], e), cells.density[k], 0));
  };
  is(0, mixture.fresh, cells.specific_energy[0]);
  is(1, mixture.burnt, cells.specific_energy[1] + mixture.release);
}

TEST(StrengthLoop, BringsCellsBackToTheYieldSurface) {
  const std::size_t n = 3000;
  Material rock = solid(basalt);
  rock.melt_energy = 3.4e6;
  const Collins law{{90e6, 2, 1.5e9}, 0, 0.8, 1.2e9, 2.4e9};
  rock.strength = law;
  Cells cells(2700, 2e6);
  std::vector<double> pressure(n), damage(n), strain(n, 0.1), broken(n, 0.2);
  std::array<std::vector<double>, 5> stress;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t k = 0; k < n; ++k) {
    pressure[k] = 3e9 * (uniform(random) - 0.2);
    damage[k] = uniform(random);
    for (auto& component : stress) component.push_back(1e9 * (uniform(random) - 0.5));
  }
  const auto before = stress;
  StrengthColumns<3> columns{.density = {},
                             .specific_energy = std::span(cells.specific_energy).first(n),
                             .pressure = pressure,
                             .damage = damage,
                             .deviatoric_stress = {},
                             .plastic_strain = strain,
                             .shear_damage = broken};
  for (std::size_t k = 0; k < 5; ++k) columns.deviatoric_stress[k] = stress[k];
  apply_strength<3>(rock, columns, 1e-7);
  int yielded = 0;
  for (std::size_t k = 0; k < n; ++k) {
    Deviator<3> trial;
    for (int c = 0; c < 5; ++c) trial[c] = before[static_cast<std::size_t>(c)][k];
    const double yield = law.yield({.pressure = pressure[k], .damage = damage[k]}) *
                         melt_factor(cells.specific_energy[k], rock.melt_energy);
    const RadialReturn r = radial_return<3>(trial, yield, 77e9);
    for (std::size_t c = 0; c < 5; ++c) ASSERT_NEAR(stress[c][k], r.scale * before[c][k], 1e-3) << k;
    ASSERT_NEAR(strain[k], 0.1 + r.plastic_strain, 1e-13) << k;
    ASSERT_NEAR(broken[k], std::min(0.2 + r.plastic_strain / law.failure_strain(pressure[k]), 1.0), 1e-12) << k;
    yielded += r.scale < 1;
  }
  EXPECT_GT(yielded, 500);
  EXPECT_LT(yielded, 2900);
}

}  // namespace
}  // namespace ejecta
