#pragma once
/// What a run sets out with, and what follows from it for tables and pictures: which body is struck, and how large
/// things will become.
#include <vector>

#include "base/types.hpp"
#include "material/material.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"

namespace ejecta {

struct BodyAtOutset {
  double mass = 0;                   ///< kg (kg/m in plane strain)
  Vec<3> velocity = Vec<3>::Zero();  ///< of the centre of mass [m/s]
  bool may_be_target = true;         ///< neither driven nor a gas
};

struct Outset {
  std::vector<BodyAtOutset> bodies;
  double speed = 0;     ///< largest of a particle [m/s]
  double density = 0;   ///< to be expected [kg/m^3]: the largest, of condensed matter a fifth more
  double pressure = 0;  ///< to be expected [Pa]
};

/// Takes the particles as they are once all stages have run at t = 0, whatever gave them their state. Pressures to be
/// expected are the largest of
///  - pressure and deviatoric stress there are;
///  - in a gas rho u^2, the ram pressure;
///  - in other matter a tenth of rho u max(u, c), the pressure behind a shock or an elastic wave of velocity u: what is
///    left of it some way from where it begins.
/// u is the largest speed relative to the centre of mass of everything; across walls and planes of symmetry, which stand
/// still, relative to them.
template <int Dim>
Outset outset(const Particles<Dim>& particles, const Scene& scene, const std::vector<Material>& materials);

/// The body that fragments are counted of: scene.fragments.target, else the heaviest body at rest, else the body
/// slowest about the centre of mass of all of them (of two bodies the heavier one). Driven bodies and gases are left
/// out unless there is nothing else.
std::size_t target_body(const Scene& scene, const std::vector<BodyAtOutset>& bodies);

/// For FragmentInput: pieces of different bodies are different fragments; a gas has none.
std::vector<std::int32_t> pieces_of_bodies(const Scene& scene, const std::vector<Material>& materials,
                                           const std::vector<int>& body_material);

}  // namespace ejecta
