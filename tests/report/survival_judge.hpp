#pragma once
/// Follows a run from outside and says what was wrong with it. Nothing here relies on what the core thinks of itself
/// but for the particles' columns: places, masses, densities, energies, smoothing.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "particles/smoothing_metric.hpp"
#include "simulation/simulation.hpp"
#include "sph/diagnostics.hpp"
#include "sph/stages.hpp"
#include "survival_runs.hpp"

namespace ejecta::survival {

struct Verdict {
  std::string kind = "survived";  ///< or what went wrong
  std::string message;            ///< of the core, if it gave up
  std::size_t particles = 0;
  std::int64_t steps = 0, short_steps = 0;  ///< short: below a thousandth of the first
  double reached = 0;                       ///< share of the time
  double energy_error = 0;                  ///< of the kinetic energy at the start
  double least_energy = 0;                  ///< most negative specific energy at any time, in units of v^2/2
  std::size_t negative = 0;                 ///< particles that ever had a negative energy
  double fastest = 0;                       ///< at any time, in impact speeds
  double thinnest = 1, densest = 1;         ///< density over mass/spacing^Dim where neighbours are on all sides
  double densest_spray = 1;                 ///< the same where supports have grown, but in a gas: torn matter
};

inline constexpr std::int64_t most_steps = 20000;
inline constexpr std::int64_t steps_between_densities = 20;
inline constexpr double largest_energy_error = 1e-9;
inline constexpr double least_specific_energy = -1e-3;             // cold starts may cool a little below zero
inline constexpr double largest_speed = 3, largest_speed_gas = 5;  // a gas that was hit flies into the void at 3.6 v
inline constexpr double largest_ratio = 3;
/// Drops of torn matter are dense and far apart, and their supports grow until they reach the next ones: they are not
/// too dense. Below this growth of h a particle that has four fifths of its neighbours has them at 1.35 spacings or
/// less.
inline constexpr double largest_growth = 1.2;

/// Density of every particle over m n, n the number density of its nearest neighbours, for those that have neighbours
/// of their own body on all sides; 1 for the others.
///
/// All in units of the particle's smoothing lengths, y = H x: a particle has its neighbours if its support |y| < 2
/// holds four fifths of those of the lattice, and one of the K nearest is within 60 degrees of each of the directions
/// (1, 0, 0), (1, 1, 1) and so on. n counts the K nearest (first and second shell of the square, the cubic lattice) and
/// the particle itself, in the sphere that reaches half way to the next.
template <int Dim>
std::vector<double> density_ratios(const Particles<Dim>& p, double nodes_per_h) {
  constexpr std::size_t nearest = Dim == 2 ? 8 : 18;
  constexpr double unit_sphere = Dim == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  const double lattice_radius = Dim == 2 ? 0.5 * (std::sqrt(2.0) + 2) : 0.5 * (std::sqrt(2.0) + std::sqrt(3.0));
  const double lattice_count = (nearest + 1) / (unit_sphere * std::pow(lattice_radius, Dim));
  const double full = 0.8 * unit_sphere * std::pow(2 * nodes_per_h, Dim);
  std::vector<Vec<Dim>> directions;
  for (int k = 0; k < std::pow(3, Dim); ++k) {
    Vec<Dim> d;
    for (int a = 0, rest = k; a < Dim; ++a, rest /= 3) d[a] = rest % 3 - 1;
    const int axes = static_cast<int>(d.squaredNorm());
    if (axes == 1 || axes == Dim) directions.push_back(d.normalized());
  }
  std::vector<double> ratios(p.size(), 1);
  std::vector<std::pair<double, Vec<Dim>>> near;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double h = p.column(Field::smoothing_length)[i];
    const Mat<Dim> metric =
        p.has(Field::smoothing_metric) ? p.symmetric(Field::smoothing_metric, i) : round_metric<Dim>(h);
    const Mat<Dim> to_support = metric.llt().matrixU();
    near.clear();
    for (std::size_t j = 0; j < p.size(); ++j)
      if (j != i && p.label(Label::body)[j] == p.label(Label::body)[i]) {
        const Vec<Dim> y = to_support * (p.vector(Field::position, j) - p.vector(Field::position, i));
        if (const double r = y.norm(); r < 2) near.emplace_back(r, y);
      }
    if (static_cast<double>(near.size() + 1) < full || near.size() <= nearest) continue;
    std::ranges::sort(near, {}, [](const auto& n) { return n.first; });
    const bool all_sides = std::ranges::all_of(directions, [&](const Vec<Dim>& d) {
      return std::any_of(near.begin(), near.begin() + nearest,
                         [&](const auto& n) { return n.second.dot(d) > 0.5 * n.first; });
    });
    if (!all_sides) continue;
    const double radius = 0.5 * (near[nearest - 1].first + near[nearest].first);
    const double count = (nearest + 1) / (unit_sphere * std::pow(radius, Dim)) / lattice_count;  // per det(H)
    ratios[i] = p.column(Field::density)[i] / (p.column(Field::mass)[i] * count * to_support.determinant());
  }
  return ratios;
}

/// Name of the failure that a message of the core tells of.
inline std::string kind_of(const std::string& message) {
  if (message.find("time step has collapsed") != std::string::npos) return "collapsed step";
  if (message.find("energy has drifted") != std::string::npos) return "energy drift";
  if (message.find("not finite or density not positive") != std::string::npos) return "not finite or no density";
  return "other error";
}

/// Runs to the end of the scene and judges.
/// @param speed  of the ball [m/s]
/// @param gas    whether a gas takes part, whose free expansion is faster
template <int Dim>
Verdict judge(Sph<Dim>& sim, double speed, bool gas) {
  const Particles<Dim>& p = sim.particles;
  const double end = sim.scene.time_end, unit = 0.5 * speed * speed;
  const double widest = largest_growth * sim.scene.numerics.nodes_per_h * sim.scene.spacing;
  Verdict v;
  v.particles = p.size();
  std::vector<char> negative(p.size(), 0);
  double first_step = 0, fastest = 0, least = std::numeric_limits<double>::infinity();
  auto look = [&] {
    for (std::size_t i = 0; i < p.size(); ++i) {
      fastest = std::max(fastest, p.vector(Field::velocity, i).squaredNorm());
      const double e = p.column(Field::specific_energy)[i];
      least = std::min(least, e);
      if (e < 0) negative[static_cast<std::size_t>(p.label(Label::id)[i])] = 1;
    }
    if (v.steps % steps_between_densities != 0 && sim.clock.time < end) return;
    const std::vector<double> ratios = density_ratios(p, sim.scene.numerics.nodes_per_h);
    for (std::size_t i = 0; i < p.size(); ++i) {
      v.thinnest = std::min(v.thinnest, ratios[i]);
      const Material& material = sim.materials[static_cast<std::size_t>(p.label(Label::material)[i])];
      const bool spray = p.column(Field::smoothing_length)[i] > widest && !material.gas();
      double& densest = spray ? v.densest_spray : v.densest;
      densest = std::max(densest, ratios[i]);
    }
  };
  try {
    while (sim.clock.time < end * (1 - 1e-12) && v.steps < most_steps) {
      const Vote vote = step(sim, sim.scene, end - sim.clock.time);
      if (v.steps++ == 0) first_step = vote.dt;
      v.short_steps += vote.dt < 1e-3 * first_step;
      look();
    }
    if (v.steps == most_steps) v.kind = "too many steps";
  } catch (const SimulationError& error) {
    v.message = error.what();
    v.kind = kind_of(v.message);
  }
  v.reached = sim.clock.time / end;
  v.energy_error = (totals(p).energy() - sim.initial.energy()) / sim.initial.kinetic;
  v.least_energy = std::min(0.0, least / unit);
  v.negative = static_cast<std::size_t>(std::ranges::count(negative, 1));
  v.fastest = std::sqrt(fastest) / speed;
  if (v.kind != "survived") return v;
  if (!(std::abs(v.energy_error) <= largest_energy_error))
    v.kind = "energy not conserved";
  else if (!(v.least_energy >= least_specific_energy))
    v.kind = "negative energy";
  else if (!(v.fastest <= (gas ? largest_speed_gas : largest_speed)))
    v.kind = "too fast";
  else if (!(v.thinnest >= 1 / largest_ratio))
    v.kind = "too thin";
  else if (!(v.densest <= largest_ratio))
    v.kind = "too dense";
  return v;
}

}  // namespace ejecta::survival
