#pragma once
#include "scene/choices.hpp"

namespace ejecta {

/// What sums over the cubic lattice give with `nodes_per_h` particles in h, V the volume of each.
struct LatticeSums {
  double density;   ///< sum_j V W(x_j), 1 of an ideal kernel
  double gradient;  ///< sum_j V x_j dW/dx, of -1 the magnitude
};
LatticeSums lattice_sums(Kernel kernel, int dim, double nodes_per_h);

}  // namespace ejecta
