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
        heating(p, Field::heating),
        neighbour_sum(p, Field::neighbour_sum),
        approach_speed(p, Field::approach_speed),
        velocity_gradient(p, Field::velocity_gradient),
        coupled_gradient(p, Field::coupled_gradient),
        stretch(p, Field::stretch),
        density(p, Field::density) {}

  Columns<Dim, const double> mass, velocity;
  Columns<Dim, double> acceleration, heating, neighbour_sum, approach_speed, velocity_gradient, coupled_gradient,
      stretch, density;
};

}  // namespace ejecta
