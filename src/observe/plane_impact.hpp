#pragma once
/// What bodies that meet, or that run into a wall, do to each other.
#include <vector>

#include "material/material.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Of the strongest impact of a scene; zeros if nothing meets.
struct PlaneImpact {
  double pressure = 0;  ///< Pa
  double speed = 0;     ///< of a free surface once the shock has come there, or of the body behind it [m/s]
};

/// Of any two bodies on their way to each other at a velocity V, and of a body on its way to a wall, a plane of
/// symmetry or a driven body, with the impedances Z = rho Us of shocks [Zel'dovich & Raizer 2002, chapter XI]:
///
///     P = V Z1 Z2/(Z1 + Z2),     u = V Z2/(Z1 + Z2),     a free surface moves at 2 u.
///
/// Us = c + 3/4 V, that of a particle velocity of V/2 and a slope of 3/2; c is zero in pores, which let no shock pass
/// before they are crushed. Where one body is narrower across its way than the other, waves from its sides take what
/// it has done down: both numbers by the ratio of the widths. Gases are left out.
PlaneImpact strongest_impact(const Scene& scene, const std::vector<Material>& materials);

}  // namespace ejecta
