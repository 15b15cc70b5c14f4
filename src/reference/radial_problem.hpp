#pragma once
/// The one-dimensional problem that a scene stands for.
#include <functional>
#include <optional>
#include <vector>

#include "material/material.hpp"
#include "reference/radial_flow.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Matter at a point of the line at the start.
struct LinePoint {
  std::size_t body;        ///< place in scene.bodies
  double density;          ///< kg/m^3
  double velocity;         ///< along the line [m/s]
  double specific_energy;  ///< J/kg
};

/// A charge in a gas at rest.
struct Blast {
  double radius;            ///< of the charge [m]
  double energy;            ///< of the charge [J/m^2, both sides of the plane; J/m; J]
  double ambient_density;   ///< kg/m^3
  double ambient_pressure;  ///< Pa
};

struct RadialProblem {
  Geometry geometry;
  Eos eos;
  double start, end;  ///< m; nothing has happened yet beyond the end where that is quiet
  RadialEdge lower, upper;
  std::function<LinePoint(double)> at;  ///< of x or r [m]; throws InputError where there is no matter
  bool uniform_bodies;                  ///< none has a profile
  std::size_t bodies;
  std::optional<Blast> blast;
  double default_spacing;  ///< m
};

/// With a charge: around its centre, a cylinder in 2D and a sphere in 3D, in its gas without end. Else along x through
/// the centre of the first body, from face to face of the boundary box, or as far as bodies reach where that has no
/// face. `geometry` chooses another one: then r begins at the centre of the first body and goes along +x. The scene and
/// the materials must outlive the problem. Throws InputError if the scene stands for no such problem: several
/// materials, strength or pores, motion across the line.
RadialProblem radial_problem(const Scene& scene, const std::vector<Material>& materials,
                             std::optional<Geometry> geometry = {});

/// The spacing [m] next to `wanted` of which twice a whole number fills the line; `wanted` for a blast.
double fitting_spacing(const RadialProblem& problem, double wanted);

/// At t = 0, in cells of this width [m]. A cell that two bodies share has of each what lies in it.
RadialFlow start_flow(const RadialProblem& problem, double spacing);

}  // namespace ejecta
