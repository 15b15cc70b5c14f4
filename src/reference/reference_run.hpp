#pragma once
/// A one-dimensional problem followed to its end, and what is told of it.
#include <optional>
#include <span>
#include <vector>

#include "material/exact_riemann.hpp"
#include "reference/radial_problem.hpp"

namespace ejecta {

/// All cells at one time, SI.
struct RadialProfile {
  double time;
  std::vector<double> position, density, velocity, pressure, specific_energy;
};

/// Of a blast at one time, SI; not a number where there is no shock.
struct ShockRecord {
  double time, radius, peak_pressure;  ///< of the shock
  double peak_density;                 ///< the largest anywhere
  double peak_density_radius;          ///< where that is
};

struct ReferenceRun {
  double spacing = 0;                   ///< m
  std::vector<RadialProfile> profiles;  ///< at the times asked for
  std::vector<ShockRecord> shocks;      ///< of a blast: at those and at every 1/200 of the last one
  RadialFlow::Errors errors{};
  std::int64_t steps = 0, cell_steps = 0;
  double wall_time = 0;  ///< s

  /// Place in `shocks` of a time that was asked for.
  std::size_t shock_at(double time) const;
  /// Speed of the shock [m/s] there: slope of the parabola in log R over log t through that record and two a tenth of
  /// its time away. Not a number where there are none.
  double shock_speed(std::size_t record) const;
};

/// `times` [s] ascending, > 0.
ReferenceRun run_reference(const RadialProblem& problem, double spacing, std::span<const double> times);

/// Density behind a shock of this speed [m/s] in an ideal gas at rest (Rankine & Hugoniot) [kg/m^3]; that in front of
/// it if the speed is not above that of sound.
double density_behind_shock(double gamma, double density, double pressure, double speed);

/// Two uniform bodies of an ideal gas that meet at a plane.
struct RiemannProblem {
  double interface;  ///< x [m]
  GasState left, right;
  ExactRiemann exact;
};
/// Nothing if the problem is another one.
std::optional<RiemannProblem> riemann_problem(const RadialProblem& problem);

/// Mean of the absolute difference over the line (L1 over its length), SI.
struct MeanDifference {
  double density, velocity, pressure;
};
/// To the exact solution, averaged over the cells. Nothing if a wave has reached an end of the line by then.
std::optional<MeanDifference> difference(const RadialProfile& profile, double spacing, const RiemannProblem& problem);
/// Between a profile and one in cells half as wide, both over the whole line.
MeanDifference difference(const RadialProfile& coarse, const RadialProfile& fine);

}  // namespace ejecta
