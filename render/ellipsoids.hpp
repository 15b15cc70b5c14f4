#pragma once
/// Smoothing and damage tensors as pictures need them: principal axes, lengths, aspect ratios.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/channel.hpp"
#include "particles/particles.hpp"

namespace ejecta {

/// Fields that follow from the tensors of every particle. From the smoothing metric: `aspect` [1], the longest over the
/// shortest axis. From the damage tensor: eigenvalues damage_1 >= damage_2 ... [1] and vectors damage_axis_1 ... [1],
/// eigenvalue times unit eigenvector (three components, z = 0 in 2D). Empty where neither tensor exists.
template <int Dim>
std::vector<OwnedField> tensor_fields(const Particles<Dim>& particles);

/// The smoothing ellipsoids of a layer of particles.
struct Ellipsoids {
  std::array<std::vector<double>, 3> position;  ///< m
  std::vector<OwnedField> fields;
  std::vector<std::int32_t> id;

  /// Valid while this lives.
  Channel channel(std::string name) const;
};

/// Particles of one layer, one node spacing thick, about the plane y = plane_y (2D: all), with the fields
///  - axis_1 ... axis_Dim [m]: semi-axes of the ellipsoid |H x| = 1, longest first; divided by `nodes_per_h` they are
///  one
///    node spacing long. Round in SPH;
///  - aspect [1]; in 2D orientation [rad], the angle of axis_1 against x in [-pi/2, pi/2];
///  - what tensor_fields gives, and every scalar field of the particles.
/// Particles whose metric is not positive definite are left out.
template <int Dim>
Ellipsoids find_ellipsoids(const Particles<Dim>& particles, double plane_y, double nodes_per_h);

}  // namespace ejecta
