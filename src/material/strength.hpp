#pragma once
/// How much deviatoric stress a material bears. One convention for all models: yield() is a limit on the von Mises
/// equivalent stress sqrt(3 J2). The friction laws are published as limits on the shear stress sqrt(J2) and keep their
/// published parameters; they are converted here by sqrt(3), once. Pressures are those of the solid (alpha P in a
/// porous material), compression positive. All values are cold, multiply by melt_factor(), but those of the metals,
/// which know their temperature.
///
/// intact_fraction(D) scales the deviator where forces are computed: 1 - D for models that know nothing of damaged
/// material (Benz & Asphaug 1994, Icarus 107, 98), 1 for those whose damaged branch is itself a friction law.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "material/deviator.hpp"
#include "material/hardening.hpp"
#include "material/johnson_cook.hpp"
#include "material/steinberg_guinan.hpp"
#include "material/strength_state.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Constant yield stress (von Mises).
struct VonMises {
  double yield_stress = unset;  ///< limit of sqrt(3 J2) [Pa]

  double yield(const StrengthState&) const { return yield_stress; }
  double intact_fraction(double damage) const { return 1 - damage; }
};

/// Cone through the outer (compressive) edges of the Mohr-Coulomb pyramid (Drucker & Prager 1952):
/// sqrt(J2) = [6 c cos(phi) + 6 P sin(phi)] / [sqrt(3) (3 - sin(phi))], >= 0. Damage removes the cohesion, not the
/// friction.
struct DruckerPrager {
  double cohesion = unset;        ///< c [Pa]
  double friction_angle = unset;  ///< phi [rad]

  double yield(const StrengthState& s) const {
    const double sine = std::sin(friction_angle);
    return std::max(0.0, 6 * (cohesion * (1 - s.damage) * std::cos(friction_angle) + s.pressure * sine) / (3 - sine));
  }
  double intact_fraction(double) const { return 1; }
};

/// Lundborg (1968): sqrt(J2) = c + mu P / (1 + mu P/(Y_max - c)); the cohesion alone in tension. Intact rock only.
struct Lundborg {
  double cohesion = unset;  ///< c [Pa]
  double friction = unset;  ///< coefficient of internal friction mu
  double limit = unset;     ///< Y_max, the shear strength at infinite pressure, > c [Pa]

  double yield(const StrengthState& s) const {
    const double load = friction * std::max(s.pressure, 0.0);
    return std::numbers::sqrt3 * (cohesion + load / (1 + load / (limit - cohesion)));
  }
  double intact_fraction(double damage) const { return 1 - damage; }
};

/// Collins, Melosh & Ivanov (2004, Meteorit. Planet. Sci. 39, 217): Y = (1 - D) Y_i + D Y_d with Lundborg's Y_i for
/// intact rock and dry friction Y_d = c_d + mu_d P for broken rock, 0 <= Y_d <= Y_i.
struct Collins {
  Lundborg intact;
  double damaged_cohesion = unset;  ///< c_d [Pa]
  double damaged_friction = unset;  ///< mu_d; in tension the broken rock's strength falls as c_d + P
  double brittle_ductile = unset, brittle_plastic = unset;  ///< transitions [Pa]; not set: shear breaks nothing

  bool breaks_in_shear() const { return is_set(brittle_ductile); }
  /// Plastic strain that breaks it: 0.01 at zero pressure, 0.05 at the brittle-ductile and 0.1 at the brittle-plastic
  /// transition, straight lines in between; beyond that rock flows and hardly breaks, 1. [The same paper, recalled.]
  double failure_strain(double pressure) const {
    if (pressure >= brittle_plastic) return 1;
    if (pressure >= brittle_ductile)
      return 0.05 + 0.05 * (pressure - brittle_ductile) / (brittle_plastic - brittle_ductile);
    return 0.01 + 0.04 * std::max(pressure, 0.0) / brittle_ductile;
  }
  double yield(const StrengthState& s) const {
    const double whole = intact.yield(s);
    const double friction = s.pressure > 0 ? damaged_friction : 1;
    const double broken = std::numbers::sqrt3 * (damaged_cohesion + friction * s.pressure);
    return (1 - s.damage) * whole + s.damage * std::clamp(broken, 0.0, whole);
  }
  double intact_fraction(double) const { return 1; }
};

using Strength = std::variant<VonMises, DruckerPrager, Lundborg, Collins, SteinbergGuinan, JohnsonCook>;

/// Whether the yield stress of a model grows with the plastic flow itself; then flow() finds the two together. Such
/// laws are those of metals and soften by the temperature of the equation of state in place of melt_factor():
/// needs_temperature() and needs_melting() say whether they cannot do without.
template <class Model>
inline constexpr bool hardens = requires {
  Model::hardening_law;
};

/// Whether the shear modulus depends on the state: shear_factor(P, eta, warmth) times that of `Elastic`.
template <class Model>
inline constexpr bool varies_shear = requires(const Model& model, double x) {
  model.shear_factor(x, x, Warmth{});
};

/// Whether plastic strain may break a material, at failure_strain(P); breaks_in_shear() says whether this one.
template <class Model>
inline constexpr bool may_break_in_shear = requires(const Model& model, double x) {
  model.failure_strain(x);
};

/// Fraction of the cold strength left at specific energy e: max(0, 1 - e/e_melt) (Benz & Asphaug 1999, Icarus 142, 5).
/// Where no melt energy is set the material never softens.
inline double melt_factor(double e, double melt_energy) {
  return is_set(melt_energy) ? std::clamp(1 - e / melt_energy, 0.0, 1.0) : 1;
}

struct RadialReturn {
  double scale;           ///< what the deviator is multiplied by, 0 to 1
  double plastic_strain;  ///< increment of equivalent plastic strain, >= 0
};

/// Brings a trial deviator [Pa] back to the yield surface sqrt(3 J2) = yield along its own direction (Wilkins 1964):
/// scale = yield/sqrt(3 J2), d(eps_p) = (sqrt(3 J2) - yield)/(3 G). The plastic work is yield d(eps_p) per volume.
template <int Dim>
RadialReturn radial_return(const Deviator<Dim>& trial, double yield, double shear_modulus) {
  const double equivalent = equivalent_stress<Dim>(trial);
  if (equivalent <= yield) return {1, 0};
  return {yield / equivalent, (equivalent - yield) / (3 * shear_modulus)};
}

/// The same with a yield stress that grows with the flow, during a step of dt [s] from this state on.
template <int Dim, class Model>
requires hardens<Model> RadialReturn radial_return(const Deviator<Dim>& trial, const Model& model,
                                                   const StrengthState& state, double shear_modulus, double dt) {
  const double equivalent = equivalent_stress<Dim>(trial);
  const PlasticFlow f = flow(model, state, equivalent, shear_modulus, dt);
  return equivalent <= f.yield ? RadialReturn{1, 0} : RadialReturn{f.yield / equivalent, f.plastic_strain};
}

}  // namespace ejecta
