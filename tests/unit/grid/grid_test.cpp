#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "material/exact_riemann.hpp"
#include "small_grids.hpp"

namespace ejecta {
namespace {

/// A tube along an axis with the jump of Sod (1978) in its middle, `across` cells wide.
std::string sod_tube(int dimension, int axis, int cells, int across, const std::string& more = "") {
  const double dx = 1.0 / cells;
  std::string size, min, max;
  const std::array names{"x", "y", "z"};
  for (int a = 0; a < dimension; ++a) {
    const double edge = a == axis ? 1 : across * dx;
    size += fmt::format("{}\"{} m\"", a ? ", " : "", edge);
    min += fmt::format("{}\"{} m\"", a ? ", " : "", -0.5 * edge);
    max += fmt::format("{}\"{} m\"", a ? ", " : "", 0.5 * edge);
  }
  std::string faces;
  for (int a = 0; a < dimension; ++a)
    faces += fmt::format("{} = \"{}\"\n", names[static_cast<std::size_t>(a)], a == axis ? "reflecting" : "periodic");
  const std::string profile =
      fmt::format("[bodies.profile]\ndensity = \"{0} < 0 ? 1 : 0.125\"\npressure = \"{0} < 0 ? 1 : 0.1\"\n",
                  names[static_cast<std::size_t>(axis)]);
  return gas_box(dimension, size, dx, 0.2, profile + fmt::format("[boundary]\n{}min = [{}]\nmax = [{}]\n", faces, min, max) + more);
}

/// Mean absolute error of the density in the tube.
template <int Dim>
double density_error(const Grid<Dim>& grid, int axis) {
  const ExactRiemann exact({1, 0, 1}, {0.125, 0, 0.1}, 1.4);
  double sum = 0;
  for (std::size_t i = 0; i < grid.elements(); ++i)
    sum += std::abs(grid.state(i).density - exact.at(grid.box().centre(grid.box().cell(i))[axis] / 0.2).density);
  return sum / static_cast<double>(grid.elements());
}

template <int Dim>
double error_of_tube(int axis, int cells, const std::vector<std::string>& overrides = {}) {
  const auto grid = make_grid<Dim>(sod_tube(Dim, axis, cells, 4), overrides);
  run_to_end(*grid, grid->scene());
  return density_error(*grid, axis);
}

TEST(Grid, SodsTubeConverges) {
  const double coarse = error_of_tube<2>(0, 100), fine = error_of_tube<2>(0, 200);
  EXPECT_LT(fine, 0.0027);
  EXPECT_GT(std::log2(coarse / fine), 0.85);
}

TEST(Grid, AxesAreAlike) {
  const double along_x = error_of_tube<2>(0, 100);
  EXPECT_NEAR(error_of_tube<2>(1, 100), along_x, 1e-12);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(error_of_tube<3>(axis, 100, {"grid.courant=0.8"}), along_x, 1e-12) << axis;
}

TEST(Grid, FluxesAndLimitersAreAsGoodAsTheirNames) {
  const double hllc = error_of_tube<2>(0, 100);
  const double exact = error_of_tube<2>(0, 100, {"grid.riemann=exact"});
  EXPECT_LT(exact, hllc);  // mostly by what the first steps make of the jump
  EXPECT_GT(exact, 0.7 * hllc);
  EXPECT_GT(error_of_tube<2>(0, 100, {"grid.limiter=minmod"}), 1.2 * hllc);
  EXPECT_GT(error_of_tube<2>(0, 100, {"grid.limiter=none"}), 2.5 * hllc);
}

/// A smooth vortex that the flow carries [Shu 1998], through a periodic box in `end` seconds and back to its place.
std::string vortex(int cells) {
  const std::string bump = "exp(1 - (x^2 + y^2))";
  const std::string cooler = "(1 - 0.4*25/(8*1.4*9.8696044)*" + bump + ")";
  return gas_box(2, "\"10 m\", \"10 m\"", 10.0 / cells, 10,
                 fmt::format("[bodies.profile]\ndensity = \"{0}^2.5\"\npressure = \"{0}^3.5\"\n"
                             "velocity = [\"1 - y*5/6.283185307*exp(0.5*(1 - x^2 - y^2))\", "
                             "\"1 + x*5/6.283185307*exp(0.5*(1 - x^2 - y^2))\"]\n"
                             "[boundary]\nx = \"periodic\"\ny = \"periodic\"\nmin = [\"-5 m\", \"-5 m\"]\nmax = [\"5 m\", \"5 m\"]\n",
                             cooler));
}

double vortex_error(int cells, const std::vector<std::string>& overrides = {}) {
  const auto start = make_grid<2>(vortex(cells), overrides), end = make_grid<2>(vortex(cells), overrides);
  run_to_end(*end, end->scene());
  double sum = 0;
  for (std::size_t i = 0; i < end->elements(); ++i) sum += std::abs(end->state(i).density - start->state(i).density);
  return sum / static_cast<double>(end->elements());
}

TEST(Grid, IsOfSecondOrderWhereFlowIsSmooth) {
  const double order = std::log2(vortex_error(40) / vortex_error(80));
  EXPECT_GT(order, 1.9) << order;
  const double first = std::log2(vortex_error(40, {"grid.limiter=none"}) / vortex_error(80, {"grid.limiter=none"}));
  EXPECT_LT(first, 1.2);
}

const std::string small_blast = R"([scene]
name = "blast"
dimension = 2
[resolution]
spacing = "0.5 m"
[time]
end = "0.2 ms"
[charge]
radius = "0.8 m"
density = "1000 kg/m^3"
energy_per_length = "4.184e12 J/m"
[gas]
density = "1.225 kg/m^3"
pressure = "102 kPa"
[numerics]
scheme = "fvm"
)";

TEST(Grid, LedgersCloseWhileTheBoxGrows) {
  const auto grid = make_grid<2>(small_blast, {"charge.start=0 s"});
  const std::size_t before = grid->elements();
  const int steps = run_to_end(*grid, grid->scene());
  EXPECT_GT(grid->elements(), 4 * before);
  EXPECT_GT(steps, 30);
  const ConservationErrors errors = conservation_errors(grid->initial, grid->conserved(), grid->external);
  EXPECT_LT(errors.mass, 1e-13);
  EXPECT_LT(errors.momentum, 1e-13);
  EXPECT_LT(std::abs(errors.energy), 1e-13);
}

/// Gas that streams obliquely out of open faces, with a hot spot off the middle.
const std::string stream = gas_box(2, "\"2 m\", \"2 m\"", 0.02, 0.8, R"([bodies.profile]
pressure = "hypot(x - 0.3, y + 0.2) < 0.25 ? 20 : 1"
velocity = ["1.5", "0.7"]
[boundary]
x = "open"
y = "open"
min = ["-1 m", "-1 m"]
max = ["1 m", "1 m"]
)");

TEST(Grid, WhatLeavesThroughOpenFacesIsBooked) {
  const auto grid = make_grid<2>(stream);
  run_to_end(*grid, grid->scene());
  EXPECT_GT(std::abs(grid->external.mass), 0.02 * grid->initial.mass);
  const ConservationErrors errors = conservation_errors(grid->initial, grid->conserved(), grid->external);
  EXPECT_LT(errors.mass, 1e-13);
  EXPECT_LT(errors.momentum, 1e-13);
  EXPECT_LT(std::abs(errors.energy), 1e-13);
}

TEST(Grid, WallsTakeMomentumAndNothingElse) {
  auto overrides = std::vector<std::string>{"boundary.x=reflecting", "boundary.y=symmetry"};
  const auto grid = make_grid<2>(stream, overrides);
  run_to_end(*grid, grid->scene());
  EXPECT_NEAR(grid->external.mass, 0, 1e-13 * grid->initial.mass);
  EXPECT_NEAR(grid->external.work, 0, 1e-13 * grid->initial.energy());
  EXPECT_GT(grid->external.impulse.norm(), 1e-3 * grid->initial.momentum_scale);
  EXPECT_LT(conservation_errors(grid->initial, grid->conserved(), grid->external).momentum, 1e-13);
}

TEST(Grid, ThreadsChangeNoBit) {
  std::vector<Conserved<2>> results;
  for (const int threads : {1, 3}) {
    set_threads(threads);
    const auto grid = make_grid<2>(small_blast, {"time.end=60 us"});
    run_to_end(*grid, grid->scene());
    results.push_back(grid->cells());
  }
  set_threads(1);
  EXPECT_EQ(results[0], results[1]);
}

/// What is at rest everywhere but in one place is skipped: that must not be seen in the result.
TEST(Grid, QuietTilesAreAsIfTheyHadBeenSwept) {
  const std::string blast = small_blast + "[boundary]\nmin = [\"-40 m\", \"-40 m\"]\nmax = [\"40 m\", \"40 m\"]\n";
  const std::vector<std::string> finer{"time.end=40 us", "resolution.spacing=0.2 m"};
  const auto grid = make_grid<2>(blast, finer), busy = make_grid<2>(blast, finer);
  busy->sweep_all_tiles();
  run_to_end(*grid, grid->scene());
  run_to_end(*busy, busy->scene());
  EXPECT_LT(grid->element_steps(), 0.6 * busy->element_steps());
  EXPECT_EQ(grid->cells(), busy->cells());
}

TEST(Grid, TurnedAndMirroredItIsTheSame) {
  const auto grid = make_grid<2>(stream);
  std::string turned = stream;
  const auto replace = [&](const std::string& a, const std::string& b) { turned.replace(turned.find(a), a.size(), b); };
  replace("hypot(x - 0.3, y + 0.2)", "hypot(y + 0.3, x + 0.2)");  // (x, y) -> (y, -x)
  replace("[\"1.5\", \"0.7\"]", "[\"0.7\", \"-1.5\"]");
  const auto other = make_grid<2>(turned);
  const int steps = run_to_end(*grid, grid->scene());
  EXPECT_EQ(steps, run_to_end(*other, other->scene()));
  double largest = 0;
  for (std::size_t i = 0; i < grid->elements(); ++i) {
    const auto cell = grid->box().cell(i);
    const std::size_t j = grid->box().index({cell[1], grid->box().cells[1] - 1 - cell[0]});
    largest = std::max(largest, std::abs(grid->state(i).density - other->state(j).density));
  }
  EXPECT_LT(largest, 1e-11);
}

TEST(Grid, UniformFlowStaysUniformBitForBit) {
  const auto grid = make_grid<3>(gas_box(3, "\"1 m\", \"1 m\", \"1 m\"", 0.05, 0.1,
                                         "velocity = [\"3 m/s\", \"-1 m/s\", \"0.5 m/s\"]\n[boundary]\nx = \"open\"\n"
                                         "min = [\"-0.5 m\", \"-0.5 m\", \"-0.5 m\"]\nmax = [\"0.5 m\", \"0.5 m\", \"0.5 m\"]\n"));
  const Conserved<3> before = grid->cells();
  grid->sweep_all_tiles();
  run_to_end(*grid, grid->scene());
  EXPECT_EQ(before, grid->cells());
}

/// A cold stream is stopped by a wall, and every other cell of it is denser by 0.1 %: how far rows are apart at the end.
double rows_apart(const std::vector<std::string>& overrides = {}) {
  const auto grid = make_grid<2>(gas_box(2, "\"1 m\", \"0.08 m\"", 0.01, 0.15, R"toml([bodies.profile]
density = "1 + 0.001*cos(_pi*(x/0.01 - 0.5))*cos(_pi*(y/0.01 - 0.5))"
velocity = ["-20", "0"]
[boundary]
x_min = "reflecting"
y = "periodic"
min = ["-0.5 m", "-0.04 m"]
max = ["0.5 m", "0.04 m"]
)toml"), overrides);
  run_to_end(*grid, grid->scene());
  double largest = 0;
  for (int x = 0; x < grid->box().cells[0]; ++x) {
    const double even = grid->state(grid->box().index({x, 0})).density, odd = grid->state(grid->box().index({x, 1})).density;
    largest = std::max(largest, std::abs(even / odd - 1));
  }
  return largest;
}

TEST(Grid, RowsThatAShockRunsAlongStayTogether) {
  EXPECT_LT(rows_apart(), 2.5e-3);  // ahead of the shock they are as far apart as they were
  EXPECT_GT(rows_apart({"grid.smearing=false"}), 0.02);
}

/// What sticks out of a periodic face comes in at the other one.
TEST(Grid, BodiesGoOnBehindPeriodicFaces) {
  const auto sums = [](double x) {
    const auto grid = make_grid<2>(R"([scene]
name = "across"
dimension = 2
[resolution]
spacing = "0.1 m"
[time]
end = "1 s"
[numerics]
scheme = "fvm"
[gas]
pressure = "1 Pa"
density = "1 kg/m^3"
[[bodies]]
name = "disc"
material = "air"
shape = "disc"
radius = "0.5 m"
density = "2 kg/m^3"
[bodies.profile]
velocity = ["1 + r", "0"]
[boundary]
x = "periodic"
min = ["-1 m", "-1 m"]
max = ["1 m", "1 m"]
)",
                                   {fmt::format("bodies.disc.center=[\"{} m\", \"0 m\"]", x)});
    return grid->conserved();
  };
  const auto middle = sums(0);
  for (const double x : {-1.0, 0.7, 3.2}) {
    const auto across = sums(x);
    EXPECT_NEAR(across.mass, middle.mass, 1e-12 * middle.mass) << x;
    EXPECT_NEAR(across.momentum[0], middle.momentum[0], 1e-12 * middle.momentum[0]) << x;
  }
}

/// Two streams part at 10 sound speeds: a near vacuum is left between them (Toro 2009, sect. 4.6).
TEST(Grid, NearVacuumSurvives) {
  const auto grid = make_grid<2>(gas_box(2, "\"1 m\", \"0.04 m\"", 0.01, 0.03, R"([bodies.profile]
velocity = ["x < 0 ? -12 : 12", "0"]
[boundary]
y = "periodic"
x = "open"
min = ["-0.5 m", "-0.02 m"]
max = ["0.5 m", "0.02 m"]
)"));
  run_to_end(*grid, grid->scene());
  double least = 1;
  for (std::size_t i = 0; i < grid->elements(); ++i) {
    least = std::min(least, grid->state(i).density);
    EXPECT_GT(grid->state(i).pressure, 0);
  }
  EXPECT_LT(least, 1e-2);
  EXPECT_LT(std::abs(conservation_errors(grid->initial, grid->conserved(), grid->external).energy), 1e-12);
}

TEST(Grid, PressureRatioOfAMillionSurvives) {
  const auto grid = make_grid<2>(gas_box(2, "\"1 m\", \"0.04 m\"", 0.01, 2e-4, R"([bodies.profile]
pressure = "x < 0 ? 1e6 : 1"
[boundary]
y = "periodic"
x = "reflecting"
min = ["-0.5 m", "-0.02 m"]
max = ["0.5 m", "0.02 m"]
)"));
  run_to_end(*grid, grid->scene());
  EXPECT_LT(std::abs(conservation_errors(grid->initial, grid->conserved(), grid->external).energy), 1e-13);
}

/// Water by Tillotson's equation: a weak shock from a piston of water at 50 m/s on each side.
TEST(Grid, TakesAnyEquationOfStateOfAFluid) {
  std::string scene = gas_box(2, "\"1 m\", \"0.04 m\"", 0.005, 1e-4, R"([bodies.profile]
velocity = ["x < 0 ? 50 : -50", "0"]
[boundary]
y = "periodic"
x = "open"
min = ["-0.5 m", "-0.02 m"]
max = ["0.5 m", "0.02 m"]
)");
  const auto replace = [&](const std::string& a, const std::string& b) { scene.replace(scene.find(a), a.size(), b); };
  replace("material = \"air\"", "material = \"water\"");
  replace("density = \"1 kg/m^3\"\npressure = \"1 Pa\"\n", "");
  const auto grid = make_grid<2>(scene);
  run_to_end(*grid, grid->scene());
  EXPECT_NEAR(grid->outset().pressure, 998 * 50 * 1478, 0.01 * grid->outset().pressure);  // the water hammer
  // Rankine and Hugoniot: dp = rho0 U u, with the compression u/U = 1 - rho0/rho.
  const CellState<2> middle = grid->state(grid->box().index({grid->box().cells[0] / 2 + 6, 2}));
  const double rho0 = reference_density(grid->material().eos), compression = 1 - rho0 / middle.density;
  EXPECT_NEAR(middle.pressure, rho0 * 50 * 50 / compression, 0.02 * middle.pressure);
  EXPECT_NEAR(middle.velocity[0], 0, 0.5);
  EXPECT_LT(std::abs(conservation_errors(grid->initial, grid->conserved(), grid->external).energy), 1e-12);
}

void expect_refused(const std::string& toml, const std::string& why, const std::vector<std::string>& overrides = {}) {
  try {
    make_grid<2>(toml, overrides);
    FAIL() << "accepted: " << why;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(Grid, RefusesWhatAGridCannotDo) {
  std::string solid = stream;
  solid.replace(solid.find("\"air\""), 5, "\"iron\"");
  solid.erase(solid.find("pressure = \"1 Pa\""), 17);
  solid.erase(solid.find("pressure = \"hypot"), solid.find("velocity") - solid.find("pressure = \"hypot"));
  expect_refused(solid, "carries no strength");
  expect_refused(stream, "whole number of cells", {"resolution.spacing=0.03 m"});
  expect_refused(stream, "something in every cell", {"bodies.gas.size=1 1 m"});
  expect_refused(stream, "a fluid has no pieces", {"fragments.enabled=true"});
  const std::string box = "[boundary]\nmin = [\"-0.5 m\", \"-0.5 m\"]\nmax = [\"0.5 m\", \"0.5 m\"]\n";
  expect_refused(small_blast + box, "a box that holds the charge");
  EXPECT_NO_THROW(make_grid<2>(small_blast));
}

TEST(Grid, AChargeHasItsEnergy) {
  for (const char* start : {"0 s", "50 us"}) {
    const auto grid = make_grid<2>(small_blast, {"resolution.spacing=0.1 m", std::string("charge.start=") + start});
    const Box<2>& box = grid->box();
    const double volume = static_cast<double>(box.size()) * box.cell_volume() - std::numbers::pi * 0.64;
    EXPECT_NEAR(grid->initial.energy() - 102e3 / 0.4 * volume, 4.184e12, 1e-3 * 4.184e12) << start;
    EXPECT_NEAR(grid->initial.mass, 1000 * std::numbers::pi * 0.64 + 1.225 * volume, 1e-3 * grid->initial.mass) << start;
  }
}

}  // namespace
}  // namespace ejecta
