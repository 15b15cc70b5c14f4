#pragma once
/// Bodies as particles before there are columns: where they stand and what they weigh.
#include <vector>

#include "material/material.hpp"
#include "scene/formula.hpp"
#include "sph/shapes.hpp"

namespace ejecta {

/// One particle before columns exist.
template <int Dim>
struct Placement {
  Vec<Dim> site, x;  ///< place on the lattice, and where jitter and displacement have moved it [m]
  double volume;     ///< [m^3; m^2 in plane strain]
  double spacing;    ///< edge of a cube of that volume [m]
  double density;    ///< pores included [kg/m^3]
  int body, material;
  Mat<Dim> shape = Mat<Dim>::Identity();  ///< of its cell: the metric whose unit ball has it as extent, of determinant 1
};

/// All bodies filled, those of one material together: the lattice cut by shape and boundary box, then moved by jitter
/// and displacement. Throws InputError for a body without particles, or one that overlaps an earlier one.
template <int Dim>
std::vector<Placement<Dim>> place_bodies(const Scene& scene, const std::vector<Material>& materials,
                                         const std::vector<int>& body_material);

/// Identifies a particle by where it was made: positions quantised to 1/64 of the spacing, mixed.
template <int Dim>
std::uint64_t position_key(const Vec<Dim>& site, double spacing);

}  // namespace ejecta
