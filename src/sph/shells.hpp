#pragma once
/// Round bodies laid in shells, whose fracture shows no rows of a lattice.
#include "sph/shapes.hpp"

namespace ejecta {

/// Shells of equal thickness between the faces of a disc, a cylinder or a sphere, with particles in rings. Each ring is
/// turned at random, those of a sphere's shell lie around a pole of its own. Volumes are exact shell by shell.
/// `spacing` [m]: edge of a cube of equal volume. Body::aspect: edge of a particle along its shell over that across.
/// `mirrored`: planes through the centre mirror what is beyond them: no particle comes nearer to one across an axis
/// than a quarter of the spacing.
template <int Dim>
PointCloud<Dim> lay_shells(const Body& body, double spacing, bool mirrored, std::uint64_t seed);

}  // namespace ejecta
