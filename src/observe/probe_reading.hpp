#pragma once
/// What a probe sees of the solvers at this moment.
#include <string>
#include <vector>

#include "base/types.hpp"
#include "output/csv.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// Where a probe rides: on a particle, which keeps its id.
struct Mount {
  std::int32_t id;
  double distance;  ///< from the probe [m]
};
/// The particle that is nearest to the probe now, of its body where it names one; for a surface the one nearest to the
/// axis of its beam, of those that the beam meets first. Nothing without such particles.
std::optional<Mount> mount(const Simulation& sim, const Probe& probe);

struct ProbeReading {
  std::vector<double> values;        ///< SI, by column; NaN where there is nothing to read
  Mat<3> gradient = Mat<3>::Zero();  ///< of the velocity [1/s]
};

/// Values of a probe, by name and SI unit, the same ones during a run:
///  - velocimeter: velocity towards the beginning of the beam and distance to the surface from there. The surface is
///    what of the beam's particles is nearest, to a spacing; its velocity is their mean by mass;
///  - others: density, pressure, velocity, specific energy, of solids Cauchy stress (tension positive) as the forces
///  see
///    it, damage and plastic strain; of what rides its place. In matter made of particles they are those of a linear
///    fit to the nearest body, weighted by a kernel (moving least squares, exact where fields are linear); on a grid
///    those of the cell.
std::vector<CsvColumn> reading_columns(const Simulation& sim, const Probe& probe);

/// `id`: of the particle that the probe rides on, if it does.
ProbeReading read_probe(const Simulation& sim, const Probe& probe, std::int32_t id);

}  // namespace ejecta
