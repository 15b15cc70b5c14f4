#pragma once
/// Solid bodies in the gas of a hybrid: particles with strength and damage, in steps of their own.
///
/// The gas sees each of their particles as one of its own, its image, that moves with the body and has the state of the
/// gas nearby, with the velocity across the surface turned round: between them is a wall that moves, and the Riemann
/// problem there has its solution at the wall [the ghosts of a reflecting face; walls of particles: Adami, Hu & Adams
/// 2012, J. Comput. Phys. 231, 7057]. Images do not feel each other. Gas in front of a wall is ten times as dense as it
/// was, so that its particles would find their way between those of the solid: what is within the surface (where the
/// solid fills half of a kernel) is put back to it, and stopped. What the gas does to an image, the body gets, and the
/// grid loses: impulse for impulse, and energy to round-off.
#include <memory>
#include <vector>

#include "hybrid/particles_by_cell.hpp"
#include "sph/placement.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// What a step has brought a solid particle: impulse [kg m/s] and energy [J], per metre of depth in plane strain.
template <int Dim>
struct GasLoad {
  Vec<Dim> impulse = Vec<Dim>::Zero();
  double energy = 0;
};

/// Whether a body of the scene is carried by particles alone: whatever is no gas.
bool is_solid(const Body& body, const std::vector<Material>& materials);

/// The scene of a grid or of the gas: solid bodies are filled with gas at rest, which fills what matter leaves.
Scene with_gas_for_solids(Scene scene, const std::vector<Material>& materials);

template <int Dim>
class Solids {
 public:
  /// The bodies of the scene that are no gas. Throws InputError if it asks for what cannot be.
  Solids(const Scene& scene, const std::vector<Material>& materials);

  Sph<Dim>& particles() { return *sph_; }
  const Sph<Dim>& particles() const { return *sph_; }
  /// Places of the particles, by id.
  std::vector<std::uint32_t> by_id() const;
  /// The images as the gas is to have them, in the order of their ids, which are those of the solid particles.
  std::vector<Placement<Dim>> images(double gas_density) const;

  /// Images move with their bodies in the step to come; notes what acts on them at its beginning.
  void begin(Sph<Dim>& gas, double dt);
  /// They take the state of the gas around them, or `rest` where there is none.
  void mirror(Sph<Dim>& gas, const ParticlesByCell<Dim>& by_cell, const Box<Dim>& box,
              const CellState<Dim>& rest) const;
  /// Instead of what they heat the images remember the power that they take [W/kg].
  void keep_power(Sph<Dim>& gas) const;
  /// Carries the bodies through the step, with what has acted on their images where takes(x) says so. Calls
  /// took(x, load) of each.
  template <class Takes, class Took>
  void end(Sph<Dim>& gas, const ParticlesByCell<Dim>& by_cell, const Box<Dim>& box, double dt, Takes&& takes,
           Took&& took) {
    add_loads(gas, dt);
    hold_out(gas, by_cell, box);
    const Particles<Dim>& p = sph_->particles;
    for (std::size_t i = 0; i < p.size(); ++i) {
      GasLoad<Dim>& load = loads_[static_cast<std::size_t>(p.label(Label::id)[i])];
      const Vec<Dim> x = p.vector(Field::position, i);
      if (takes(x))
        took(x, load);
      else
        load = {};
    }
    carry(dt);
  }

 private:
  void add_loads(const Sph<Dim>& gas, double dt);
  void hold_out(Sph<Dim>& gas, const ParticlesByCell<Dim>& by_cell, const Box<Dim>& box);
  void carry(double dt);
  void kick(std::size_t i, const GasLoad<Dim>& load, double share, double dt);

  std::unique_ptr<Sph<Dim>> sph_;
  std::vector<double> spacing_;          ///< of the particles of a body at the start, by id [m]
  std::vector<GasLoad<Dim>> loads_;      ///< by id
  std::vector<Vec<Dim>> wall_velocity_;  ///< of the images in the present step, by id
};

/// Whether a particle of the gas is an image.
template <int Dim>
bool is_image(const Particles<Dim>& gas, std::size_t i) {
  return gas.has(Field::wall) && gas.column(Field::wall)[i] != 0;
}

}  // namespace ejecta
