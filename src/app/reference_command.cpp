#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/job.hpp"
#include "app/options.hpp"
#include "app/run_folder.hpp"
#include "base/errors.hpp"
#include "output/csv.hpp"
#include "reference/reference_run.hpp"
#include "reference/sedov.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

std::string quantity(double value, const char* unit) {
  return std::isnan(value) ? std::string("none") : format_quantity(value, unit);
}

std::optional<Geometry> read_geometry(const std::string& word) {
  if (word == "planar") return Geometry::planar;
  if (word == "cylindrical") return Geometry::cylindrical;
  if (word == "spherical") return Geometry::spherical;
  return std::nullopt;
}

const char* word_of(Geometry geometry) {
  return geometry == Geometry::planar ? "planar" : geometry == Geometry::cylindrical ? "cylindrical" : "spherical";
}

double read_spacing(const std::string& text) {
  double spacing = 0;
  try {
    spacing = parse_quantity(text, "m");
  } catch (const InputError& error) {
    throw InputError(std::string("--spacing: ") + error.what());
  }
  if (!(spacing > 0)) throw InputError("--spacing: expected a length > 0, got " + text);
  return spacing;
}

/// Those of output.times before the end, and the end.
std::vector<double> times_of(const Scene& scene) {
  std::vector<double> times;
  for (const double t : scene.output.times)
    if (t < scene.time_end) times.push_back(t);
  times.push_back(scene.time_end);
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void write_profiles(const fs::path& file, const ReferenceRun& run, Geometry geometry) {
  const CsvColumn columns[] = {{"time", "s"},         {geometry == Geometry::planar ? "x" : "radius", "m"},
                               {"density", "kg/m^3"}, {"velocity", "m/s"},
                               {"pressure", "Pa"},    {"specific energy", "J/kg"}};
  std::vector<std::vector<CsvCell>> rows;
  for (const RadialProfile& p : run.profiles)
    for (std::size_t i = 0; i < p.position.size(); ++i)
      rows.push_back({p.time, p.position[i], p.density[i], p.velocity[i], p.pressure[i], p.specific_energy[i]});
  write_csv(file, columns, rows);
}

void write_shocks(const fs::path& file, const ReferenceRun& run) {
  const CsvColumn columns[] = {{"time", "s"}, {"radius", "m"}, {"peak_density", "kg/m^3"}, {"peak_pressure", "Pa"}};
  std::vector<std::vector<CsvCell>> rows;
  for (const ShockRecord& s : run.shocks) rows.push_back({s.time, s.radius, s.peak_density, s.peak_pressure});
  write_csv(file, columns, rows);
}

/// Shocks are captured to first order: what halving the cells has changed is what is still missing.
void print_blast(const RadialProblem& problem, const ReferenceRun& coarse, const ReferenceRun& fine,
                 const std::vector<double>& times) {
  const Blast& blast = *problem.blast;
  const IdealGas* gas = std::get_if<IdealGas>(&problem.eos);
  const char* energy_unit = problem.geometry == Geometry::planar        ? "J/m^2"
                            : problem.geometry == Geometry::cylindrical ? "J/m"
                                                                        : "J";
  fmt::print("charge             radius {}, energy {}; around it {}, {}\n", quantity(blast.radius, "m"),
             quantity(blast.energy, energy_unit), quantity(blast.ambient_density, "kg/m^3"),
             quantity(blast.ambient_pressure, "Pa"));
  fmt::print("\nshock radius [m] with cells of {} and {}, what halving them changed, and the limit by Richardson\n",
             quantity(coarse.spacing, "m"), quantity(fine.spacing, "m"));
  fmt::print("{:>12} {:>10} {:>10} {:>9} {:>10} {:>12}\n", "time", "coarse", "fine", "change", "limit", "pressure");
  for (const double t : times) {
    const ShockRecord &c = coarse.shocks[coarse.shock_at(t)], &f = fine.shocks[fine.shock_at(t)];
    fmt::print("{:>12} {:>10.6g} {:>10.6g} {:>7.3f} % {:>10.6g} {:>12}\n", quantity(t, "s"), c.radius, f.radius,
               100 * (f.radius / c.radius - 1), 2 * f.radius - c.radius, quantity(f.peak_pressure, "Pa"));
  }
  fmt::print("\nlargest density [kg/m^3] and where [m], speed of the shock");
  if (gas) fmt::print(", density behind it by Rankine and Hugoniot, radius of a point source (Sedov)");
  fmt::print("\n{:>12} {:>10} {:>10} {:>12}", "time", "density", "at", "speed");
  if (gas) fmt::print(" {:>10} {:>10} {:>9}", "behind", "Sedov", "ratio");
  fmt::print("\n");
  for (const double t : times) {
    const std::size_t k = fine.shock_at(t);
    const ShockRecord& f = fine.shocks[k];
    const double speed = fine.shock_speed(k);
    fmt::print("{:>12} {:>10.5g} {:>10.5g} {:>12}", quantity(t, "s"), f.peak_density, f.peak_density_radius,
               quantity(speed, "m/s"));
    if (gas) {
      fmt::print(" {:>10.5g}", density_behind_shock(gas->gamma, blast.ambient_density, blast.ambient_pressure, speed));
      if (Sedov::exists(problem.geometry, gas->gamma)) {
        const double sedov = Sedov(problem.geometry, gas->gamma).radius(blast.energy, blast.ambient_density, t);
        fmt::print(" {:>10.6g} {:>9.5f}", sedov, f.radius / sedov);
      }
    }
    fmt::print("\n");
  }
}

void print_difference(const char* heading, const ReferenceRun& coarse, const ReferenceRun& fine,
                      const RiemannProblem& exact) {
  fmt::print("\n{}\n{:>12} {:>32} {:>32} {:>32}\n", heading, "time", "density [kg/m^3]", "velocity [m/s]",
             "pressure [Pa]");
  for (std::size_t k = 0; k < fine.profiles.size(); ++k) {
    const auto c = difference(coarse.profiles[k], coarse.spacing, exact);
    const auto f = difference(fine.profiles[k], fine.spacing, exact);
    fmt::print("{:>12}", quantity(fine.profiles[k].time, "s"));
    const auto triple = [](double a, double b) {
      fmt::print("   {:>10.4g} {:>10.4g} {:>8}", a, b, b > 0 ? fmt::format("{:.2f}", std::log2(a / b)) : "exact");
    };
    if (c && f) {
      triple(c->density, f->density);
      triple(c->velocity, f->velocity);
      triple(c->pressure, f->pressure);
      fmt::print("\n");
    } else {
      fmt::print("   a wave has reached an end\n");
    }
  }
}

void print_line(const RadialProblem& problem, const ReferenceRun& coarse, const ReferenceRun& fine) {
  fmt::print("line               {} to {}\n", quantity(problem.start, "m"), quantity(problem.end, "m"));
  fmt::print("\nmean absolute difference between cells of {} and {}\n{:>12} {:>16} {:>16} {:>16}\n",
             quantity(coarse.spacing, "m"), quantity(fine.spacing, "m"), "time", "density [kg/m^3]", "velocity [m/s]",
             "pressure [Pa]");
  for (std::size_t k = 0; k < fine.profiles.size(); ++k) {
    const MeanDifference d = difference(coarse.profiles[k], fine.profiles[k]);
    fmt::print("{:>12} {:>16.4g} {:>16.4g} {:>16.4g}\n", quantity(fine.profiles[k].time, "s"), d.density, d.velocity,
               d.pressure);
  }
  if (const auto riemann = riemann_problem(problem)) {
    const ExactRiemann& exact = riemann->exact;
    fmt::print("\nRiemann's problem at x = {}, exactly: ", quantity(riemann->interface, "m"));
    if (exact.vacuum())
      fmt::print("a vacuum opens\n");
    else
      fmt::print("p* {:.6g} Pa, u* {:.6g} m/s, densities {:.6g} and {:.6g} kg/m^3 beside the contact\n",
                 exact.star_pressure(), exact.star_velocity(), exact.star_density_left(), exact.star_density_right());
    print_difference("mean absolute error against it, coarse and fine, and the order between them", coarse, fine,
                     *riemann);
  }
}

}  // namespace

int reference_command(const ReferenceOptions& options) {
  std::optional<Geometry> geometry;
  if (!options.geometry.empty()) {
    geometry = read_geometry(options.geometry);
    if (!geometry)
      throw InputError(
          fmt::format("--geometry: expected planar, cylindrical or spherical, got \"{}\"", options.geometry));
  }
  double spacing = options.spacing.empty() ? unset : read_spacing(options.spacing);
  const Job job = read_input(options.scene_file, options.overrides);
  const Scene& scene = job.scene;
  const fs::path folder = options.out.empty() ? fs::path("runs") / (scene.name + "_reference") : fs::path(options.out);
  check_reference_folder(folder);
  const RadialProblem problem = radial_problem(scene, job.materials.list, geometry);
  spacing = fitting_spacing(problem, is_set(spacing) ? spacing : problem.default_spacing);
  if (problem.blast && spacing > problem.blast->radius)
    throw InputError(fmt::format("--spacing: expected at most the radius of the charge, {}, got {}",
                                 quantity(problem.blast->radius, "m"), quantity(spacing, "m")));
  const std::vector<double> times = times_of(scene);
  const ReferenceRun coarse = run_reference(problem, 2 * spacing, times), fine = run_reference(problem, spacing, times);

  clear_reference_folder(folder);
  write_profiles(folder / "profile.csv", fine, problem.geometry);
  if (problem.blast) write_shocks(folder / "shock.csv", fine);
  fmt::print("reference          {}, cells of {}, second order; in {}\n", word_of(problem.geometry),
             quantity(spacing, "m"), folder.string());
  if (problem.blast)
    print_blast(problem, coarse, fine, times);
  else
    print_line(problem, coarse, fine);
  fmt::print("\n{:>12} {:>10} {:>12} {:>14} {:>14} {:>10}\n", "cells of", "steps", "cell steps", "mass error",
             "energy error", "wall time");
  for (const ReferenceRun* run : {&coarse, &fine})
    fmt::print("{:>12} {:>10} {:>12.3g} {:>14.1e} {:>14.1e} {:>10}\n", quantity(run->spacing, "m"), run->steps,
               static_cast<double>(run->cell_steps), run->errors.mass, run->errors.energy,
               quantity(run->wall_time, "s"));
  return exit_code::done;
}

}  // namespace ejecta
