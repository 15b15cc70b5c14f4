#pragma once
/// What the bodies of a scene say of a point at the start, for solvers that fill space instead of placing particles.
#include <optional>
#include <vector>

#include "material/material.hpp"
#include "scene/formula.hpp"

namespace ejecta {

template <int Dim>
struct Matter {
  std::size_t body;  ///< place in scene.bodies
  double density;    ///< kg/m^3
  Vec<Dim> velocity;       ///< m/s
  double specific_energy;  ///< J/kg

  /// Whether the two are the same state, bit for bit, of whatever body.
  bool same_state(const Matter& other) const {
    return density == other.density && velocity == other.velocity && specific_energy == other.specific_energy;
  }
};

/// Asks the bodies in their order: the first that holds the point has it, and [gas] all that is left. Not for use by two
/// threads at once, because of the formulas.
template <int Dim>
class MatterAt {
 public:
  /// `spacing` [m]: dx of the formulas. Both must outlive it.
  MatterAt(const Scene& scene, const std::vector<Material>& materials, double spacing);

  /// Nothing if no body is there. Throws InputError where a formula gives what cannot be.
  std::optional<Matter<Dim>> operator()(const Vec<Dim>& x) const;
  /// Of one body, wherever it is.
  Matter<Dim> of_body(std::size_t body, const Vec<Dim>& x) const;
  /// Whether some body's state varies within it.
  bool varies() const;

 private:
  struct Formulas {
    std::optional<Formula> density, pressure, specific_energy;
    std::vector<Formula> velocity;
    bool any() const { return density || pressure || specific_energy || !velocity.empty(); }
  };
  const Scene& scene_;
  double spacing_;
  std::vector<const Material*> material_;  ///< of each body
  std::vector<Formulas> formulas_;
};

}  // namespace ejecta
