#include "reference/radial_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/errors.hpp"
#include "material/exact_riemann.hpp"
#include "model/shock_front.hpp"
#include "reference/sedov.hpp"

namespace ejecta {
namespace {

constexpr IdealGas air{1.4, 1.2};

RadialCell cell(double density, double velocity, double pressure) {
  return {density, density * velocity, pressure / (air.gamma - 1) + 0.5 * density * velocity * velocity};
}

RadialFlow tube(int cells, const GasState& left, const GasState& right, RadialEdge edge) {
  std::vector<RadialCell> all;
  for (int i = 0; i < cells; ++i) {
    const GasState& s = i < cells / 2 ? left : right;
    all.push_back(cell(s.density, s.velocity, s.pressure));
  }
  return {air, {.start = -0.5, .spacing = 1.0 / cells, .lower = edge, .upper = edge}, all};
}

/// Mean absolute error of density or pressure against the exact solution, averaged over the cells.
double error_of(const RadialFlow& flow, const ExactRiemann& exact, double GasState::*value = &GasState::density) {
  const auto computed = value == &GasState::density ? flow.density() : flow.pressure();
  const double spacing = flow.position()[1] - flow.position()[0];
  double sum = 0;
  for (std::size_t i = 0; i < flow.position().size(); ++i) {
    double mean = 0;
    for (int k = 0; k < 16; ++k)
      mean += exact.at((flow.position()[i] + ((k + 0.5) / 16 - 0.5) * spacing) / flow.time()).*value / 16;
    sum += std::abs(computed[i] - mean) * spacing;
  }
  return sum;
}

/// Shocks are captured to first order. A contact widens with the cube root of the number of steps, so that the density
/// converges with an order between 2/3 and 1.
TEST(RadialFlow, SodsTubeConvergesToFirstOrder) {
  const GasState left{1, 0, 1}, right{0.125, 0, 0.1};
  const ExactRiemann exact(left, right, 1.4);
  std::vector<double> density, pressure;
  for (const int cells : {100, 200, 400, 800}) {
    RadialFlow flow = tube(cells, left, right, RadialEdge::open);
    flow.advance_to(0.2);
    EXPECT_EQ(flow.time(), 0.2);
    density.push_back(error_of(flow, exact));
    pressure.push_back(error_of(flow, exact, &GasState::pressure));
  }
  EXPECT_LT(density[3], 0.0008);
  EXPECT_LT(pressure[3], 0.0004);
  EXPECT_NEAR(std::log2(density[0] / density[3]) / 3, 0.85, 0.1);
  EXPECT_NEAR(std::log2(pressure[0] / pressure[3]) / 3, 1, 0.1);
}

/// Strong shocks, near vacuum and a slow contact (Toro 2009, table 4.1, to the times there).
TEST(RadialFlow, SurvivesTorosTubes) {
  struct Tube {
    GasState left, right;
    double time, error;
  };
  const Tube tubes[] = {{{1, -2, 0.4}, {1, 2, 0.4}, 0.15, 0.02},
                        {{1, 0, 1000}, {1, 0, 0.01}, 0.012, 0.12},
                        {{1, 0, 0.01}, {1, 0, 100}, 0.035, 0.12},
                        {{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 0.035, 0.5}};
  for (const Tube& t : tubes) {
    RadialFlow flow = tube(400, t.left, t.right, RadialEdge::open);
    flow.advance_to(t.time);
    EXPECT_LT(error_of(flow, ExactRiemann(t.left, t.right, 1.4)), t.error);
  }
}

/// A simple sound wave once through a periodic line, before it steepens; `eos` with the sound speed 1 at density 1.
double error_of_sound(const Eos& eos, double internal, int cells) {
  const double amplitude = 1e-6, k = 2 * std::numbers::pi;
  std::vector<RadialCell> all;
  for (int i = 0; i < cells; ++i) {
    // Averages over the cell.
    const double a = static_cast<double>(i) / cells, b = static_cast<double>(i + 1) / cells;
    const double wave = amplitude * (std::cos(k * a) - std::cos(k * b)) / k * cells;
    const double pressure = std::visit([&](const auto& e) { return e.evaluate(1, internal).pressure; }, eos);
    const double density = 1 + wave, e = internal + pressure * wave;  // along an isentrope, to first order
    all.push_back({density, density * wave, density * (e + 0.5 * wave * wave)});
  }
  RadialFlow flow(eos, {.spacing = 1.0 / cells, .lower = RadialEdge::periodic, .upper = RadialEdge::periodic}, all);
  flow.advance_to(1);
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const auto n = static_cast<std::size_t>(i);
    sum += std::abs(flow.density()[n] - all[n].density) / cells / amplitude;
  }
  return sum;
}

TEST(RadialFlow, SmoothWavesConvergeToSecondOrder) {
  const double e = 1 / (1.4 * 0.4);  // c^2 = gamma (gamma - 1) e = 1
  const double ideal[] = {error_of_sound(air, e, 50), error_of_sound(air, e, 100), error_of_sound(air, e, 200)};
  EXPECT_LT(ideal[2], 0.001);
  EXPECT_GT(std::log2(ideal[0] / ideal[1]), 1.7);  // extrema are clipped
  EXPECT_GT(std::log2(ideal[1] / ideal[2]), 1.7);
  // Any other matter goes another way through the code.
  const Eos linear = LinearEos{.rho0 = 1, .c0 = 1};
  const double other[] = {error_of_sound(linear, 0, 50), error_of_sound(linear, 0, 100)};
  EXPECT_LT(other[1], 0.004);
  EXPECT_GT(std::log2(other[0] / other[1]), 1.7);
}

/// Hot gas in cold gas at rest.
RadialFlow blast(Geometry geometry, double spacing, double radius, double density, double energy, double ambient,
                 std::size_t more = 16) {
  const double inside = energy / (all_directions(geometry) * shell_volume(geometry, 0, radius));
  std::vector<RadialCell> cells;
  for (std::size_t i = 0; i < static_cast<std::size_t>(radius / spacing) + more; ++i) {
    const double a = static_cast<double>(i) * spacing, b = a + spacing, middle = std::clamp(radius, a, b);
    const double in = shell_volume(geometry, a, middle) / shell_volume(geometry, a, b);
    cells.push_back({in * density + (1 - in), 0, in * inside + (1 - in) * ambient / 0.4});
  }
  return {air, {.geometry = geometry, .spacing = spacing}, cells};
}

TEST(RadialFlow, MassAndEnergyAreKept) {
  for (const Geometry geometry : {Geometry::planar, Geometry::cylindrical, Geometry::spherical}) {
    RadialFlow flow = blast(geometry, 0.01, 0.105, 100, 1000, 0.1);
    flow.advance_to(0.05);
    EXPECT_GT(flow.steps(), 200);
    EXPECT_GT(flow.position().size(), 100u);  // it has grown
    EXPECT_LT(std::abs(flow.errors().mass), 1e-13);
    EXPECT_LT(std::abs(flow.errors().energy), 1e-13);
  }
  for (const RadialEdge edge : {RadialEdge::open, RadialEdge::mirror}) {
    RadialFlow flow = tube(100, {1, 1, 1}, {0.125, 2, 0.1}, edge);
    flow.advance_to(1);  // waves have left, or have come back
    EXPECT_LT(std::abs(flow.errors().mass), 1e-13);
    EXPECT_LT(std::abs(flow.errors().energy), 1e-13);
  }
}

TEST(RadialFlow, GasAtRestStaysAtRestToTheLastBit) {
  for (const Geometry geometry : {Geometry::planar, Geometry::cylindrical, Geometry::spherical}) {
    const std::vector<RadialCell> cells(50, cell(1.225, 0, 102e3));
    RadialFlow flow(air, {.geometry = geometry, .spacing = 0.37, .upper = RadialEdge::mirror}, cells);
    flow.advance_to(0.1);
    for (std::size_t i = 0; i < 50; ++i) {
      EXPECT_EQ(flow.velocity()[i], 0);
      EXPECT_EQ(flow.density()[i], 1.225);
    }
  }
}

/// The radius of a point source, from a small hot disc or ball of the same density. Half way up the captured shock is a
/// part of a cell outside of it.
TEST(RadialFlow, BlastGoesWithSedov) {
  for (const Geometry geometry : {Geometry::cylindrical, Geometry::spherical}) {
    const double ambient = 1e-6;
    const Sedov sedov(geometry, 1.4);
    const double end = std::sqrt(sedov.alpha());  // energy 1, density 1, radius 1
    double radius[2];
    for (const int k : {0, 1}) {
      RadialFlow flow = blast(geometry, k ? 1.0 / 1000 : 1.0 / 500, 0.06, 1, 1, ambient);
      flow.advance_to(end);
      const auto front = find_shock_front(flow.position(), flow.pressure(), ambient);
      ASSERT_TRUE(front);
      radius[k] = front->radius;
      EXPECT_NEAR(front->peak_pressure / std::pow(sedov.speed(1, 1, end), 2), 2 / 2.4, 0.06);
    }
    EXPECT_NEAR(radius[1], 1, 1e-3);
    EXPECT_NEAR(2 * radius[1] - radius[0], 1, 3e-4);  // extrapolated
  }
}

/// Cells further out are quiet until the wave comes: how many there are at the start changes next to nothing.
TEST(RadialFlow, QuietEndGrowsWithTheWave) {
  RadialFlow few = blast(Geometry::spherical, 0.01, 0.1, 1, 1, 1e-3),
             many = blast(Geometry::spherical, 0.01, 0.1, 1, 1, 1e-3, 400);
  few.advance_to(0.5);
  many.advance_to(0.5);
  EXPECT_GT(few.position().size(), 60u);
  EXPECT_LT(few.position().size(), 250u);
  const auto a = find_shock_front(few.position(), few.pressure(), 1e-3),
             b = find_shock_front(many.position(), many.pressure(), 1e-3);
  EXPECT_NEAR(a->radius, b->radius, 1e-8);
}

/// Gas that runs against a mirror is what two gases that run against each other are (Noh's problem, without its
/// origin).
TEST(RadialFlow, MirrorStopsGasAsItsImageDoes) {
  const std::vector<RadialCell> cells(200, cell(1, -1, 0.01));
  RadialFlow flow(air, {.spacing = 0.005, .upper = RadialEdge::open}, cells);
  flow.advance_to(1);
  const ExactRiemann exact({1, 1, 0.01}, {1, -1, 0.01}, 1.4);
  EXPECT_NEAR(flow.density()[20], exact.star_density_left(), 0.01 * exact.star_density_left());
  EXPECT_NEAR(flow.pressure()[20], exact.star_pressure(), 0.001 * exact.star_pressure());
}

TEST(RadialFlow, SaysWhereItCannotGoOn) {
  std::vector<RadialCell> cells(20, cell(1, 0, 1));
  cells[7].energy = std::numeric_limits<double>::quiet_NaN();
  RadialFlow flow(air, {.spacing = 0.5, .upper = RadialEdge::mirror}, cells);
  try {
    flow.advance_to(1);
    FAIL();
  } catch (const SimulationError& error) {
    EXPECT_NE(std::string(error.what()).find("at 3.75 m"), std::string::npos) << error.what();
  }
}

TEST(RadialFlow, VolumesOfShells) {
  EXPECT_DOUBLE_EQ(all_directions(Geometry::cylindrical) * shell_volume(Geometry::cylindrical, 1, 2),
                   3 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(all_directions(Geometry::spherical) * shell_volume(Geometry::spherical, 1, 2),
                   28 * std::numbers::pi / 3);
  EXPECT_DOUBLE_EQ(shell_volume(Geometry::planar, -1, 2), 3);
}

}  // namespace
}  // namespace ejecta
