#pragma once
/// Gas dynamics in one dimension, in planes, cylinders or spheres, by finite volumes of second order. It is the
/// solution that runs in two and three dimensions are held against: cells cost so little in one dimension that they can
/// be made as small as it takes.
#include <cstdint>
#include <span>
#include <vector>

#include "material/eos.hpp"

namespace ejecta {

/// What the coordinate is: x, the distance from an axis, or that from a point.
enum class Geometry { planar, cylindrical, spherical };

/// Volume and area of all directions over r^nu dr and r^nu (nu = 0, 1, 2): 1 m^2, 2 pi m, 4 pi.
double all_directions(Geometry geometry);
/// The integral of r^nu dr, that is the volume over `all_directions` [m, m^2, m^3].
double shell_volume(Geometry geometry, double inner, double outer);

/// What is beyond an end of the cells. mirror: a wall, an axis or a centre; open: more of what is in the last cell;
/// periodic: the other end; quiet: the same matter at rest without end, into which the cells grow before a wave.
enum class RadialEdge { mirror, open, periodic, quiet };

/// What a cell holds, over its volume.
struct RadialCell {
  double density;   ///< kg/m^3
  double momentum;  ///< kg/(m^2 s)
  double energy;    ///< internal and kinetic [J/m^3]
};

struct RadialGrid {
  Geometry geometry = Geometry::planar;
  double start = 0;    ///< where the first cell begins [m]; >= 0 but in planes
  double spacing = 1;  ///< width of every cell [m]
  RadialEdge lower = RadialEdge::mirror, upper = RadialEdge::quiet;
};

/// Euler's equations with any equation of state. Slopes of density, velocity and pressure (specific energy, where the
/// gas is not ideal) are limited by the monotonised central limiter [van Leer 1977], fluxes are those of HLLC [Toro
/// 2009, sect. 10.4] with Einfeldt's wave speeds [1988; Toro 2009, sect. 10.5], steps those of Heun at 0.45 crossings
/// of a cell. The pressure on the sides of a cell is taken off the fluxes, so that gas at rest stays at rest bit for
/// bit. Mass and energy change by what passes the ends and by round-off only.
class RadialFlow {
 public:
  /// `cells` from the lower end on, four at least. A quiet end goes on with the last of them, which must be at rest.
  RadialFlow(const Eos& eos, const RadialGrid& grid, const std::vector<RadialCell>& cells);

  /// Goes on to this time [s], no earlier than the present one. Throws SimulationError where density, energy or
  /// sound speed make no sense any more.
  void advance_to(double time);

  double time() const { return time_; }  ///< s
  std::int64_t steps() const { return steps_; }
  std::int64_t cell_steps() const { return cell_steps_; }  ///< sum of the cells of all steps

  /// One value a cell, from the lower end on. Of a quiet end: up to a few cells beyond what has moved.
  std::span<const double> position() const { return of_cells(center_); }           ///< of the middle of the cell [m]
  std::span<const double> density() const { return of_cells(density_); }           ///< kg/m^3
  std::span<const double> velocity() const { return of_cells(velocity_); }         ///< m/s
  std::span<const double> pressure() const { return of_cells(pressure_); }         ///< Pa
  std::span<const double> specific_energy() const { return of_cells(internal_); }  ///< J/kg

  /// What has come or gone but by the ends, relative to all that there is.
  struct Errors {
    double mass, energy;
  };
  Errors errors() const;

 private:
  struct Totals {
    double mass = 0, energy = 0;  ///< over `all_directions`
  };
  /// Fluxes through the faces of the cells, of mass, momentum and energy.
  struct Fluxes {
    std::vector<double> mass, momentum, energy;
  };

  std::span<const double> of_cells(const std::vector<double>& column) const { return {column.data() + ghosts, cells_}; }
  void resize(std::size_t cells);
  void grow();
  void find_states();
  template <class EosT>
  void find_states(const EosT& eos);
  void fill_ghosts(std::vector<double>& column, double sign) const;
  template <class EosT>
  void find_fluxes(const EosT& eos);
  void close_ends();
  /// Adds what the fluxes bring in dt [s] to density, momentum and energy.
  void add_fluxes(double dt);
  double longest_step() const;  ///< s
  void check() const;           ///< throws SimulationError
  void step(double dt);
  Totals sum() const;

  static constexpr std::size_t ghosts = 2;  ///< cells beyond either end, in all columns of cells

  Eos eos_;
  RadialGrid grid_;
  RadialCell quiet_;
  std::size_t cells_ = 0;
  double time_ = 0, last_step_ = 0;
  std::int64_t steps_ = 0, cell_steps_ = 0;
  Totals initial_, inflow_;
  std::vector<double> center_, volume_, area_;                   ///< of cells; of faces, all over `all_directions`
  std::vector<double> density_, momentum_, energy_;              ///< per volume
  std::vector<double> old_density_, old_momentum_, old_energy_;  ///< at the start of the step
  std::vector<double> velocity_, internal_, pressure_, sound_;
  std::vector<double> density_change_, velocity_change_, third_change_;  ///< half slopes times the spacing
  Fluxes flux_;
};

}  // namespace ejecta
