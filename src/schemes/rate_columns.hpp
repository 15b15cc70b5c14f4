#pragma once
#include "schemes/columns.hpp"

namespace ejecta {

/// All that the loops over pairs see of the particles beside their records: the columns that they write, and what they
/// need to make rates of their sums.
template <int Dim>
struct RateColumns {
  explicit RateColumns(Particles<Dim>& p)
      : mass(p, Field::mass),
        velocity(p, Field::velocity),
        acceleration(p, Field::acceleration),
        specific_energy_rate(p, Field::specific_energy_rate),
        zeroth_moment(p, Field::zeroth_moment),
        largest_mu(p, Field::largest_mu),
        velocity_gradient(p, Field::velocity_gradient),
        uncut_gradient(p, Field::uncut_gradient),
        density_gradient(p, Field::density_gradient),
        pressure_gradient(p, Field::pressure_gradient),
        face_correction(p, Field::face_correction),
        stretch(p, Field::stretch),
        compression_rate(p, Field::compression_rate),
        density(p, Field::density),
        filling(p, Field::filling) {}

  Columns<Dim, const double> mass, velocity;
  Columns<Dim, double> acceleration, specific_energy_rate, zeroth_moment, largest_mu, velocity_gradient, uncut_gradient,
      density_gradient, pressure_gradient, face_correction, stretch, compression_rate, density, filling;
};

}  // namespace ejecta
