#pragma once
#include <optional>
#include <string>

#include "material/damage.hpp"
#include "material/elastic.hpp"
#include "material/eos.hpp"
#include "material/porosity.hpp"
#include "material/strength.hpp"

namespace ejecta {

/// Everything known of one material. What is absent costs nothing: stages and columns exist only for what is set.
struct Material {
  std::string name;
  Eos eos;
  std::optional<Elastic> elastic;    ///< absent: a fluid
  std::optional<Strength> strength;  ///< absent in a solid: elastic without limit
  double melt_energy = unset;        ///< J/kg; not set: never softens
  std::optional<GradyKipp> damage;
  std::optional<Porosity> porosity;

  /// Density of the unstressed, uncrushed body [kg/m^3].
  double bulk_density() const { return reference_density(eos) / (porosity ? porosity->initial_distension() : 1.0); }
  /// Whether it has no density of its own and fills all room that it is given.
  bool gas() const { return is_gas(eos); }
  /// What a burn asks of it; nothing if it is no explosive.
  std::optional<Explosive> explosive() const { return explosive_of(eos); }
  /// Whether it carries deviatoric stress.
  bool solid() const { return elastic.has_value(); }
  bool tensor_damage() const { return damage && damage->tensor; }
  /// Whether cracks cut the deviatoric stress between two particles, by direction. Not where broken matter has a
  /// friction law: its deviator is bounded by the yield stress at the largest eigenvalue of damage, and no pair is cut.
  bool cuts_pairs() const {
    return tensor_damage() && strength_is([](const auto& s) { return s.intact_fraction(1) != 1; });
  }
  /// Whether plastic strain breaks it.
  bool breaks_in_shear() const {
    return solid() && strength_is([]<class Model>(const Model& s) {
             if constexpr (may_break_in_shear<Model>)
               return s.breaks_in_shear();
             else
               return false;
           });
  }
  /// Whether it stays elastic up to large strains, as rubber does: without end, or beyond a strain of a twentieth.
  /// Particles that stretch so far must hold on to the neighbours of the start (schemes/pair_pass.hpp).
  bool stretches() const {
    if (!elastic || damage || porosity) return false;
    const double limit = 0.05 * elastic->young();
    return !strength || strength_is([&](const auto& s) { return s.yield(StrengthState{}) > limit; });
  }
  /// Whether the shear modulus depends on the state; else it is the constant of `elastic`.
  bool variable_shear() const {
    return strength_is([]<class Model>(const Model&) { return varies_shear<Model>; });
  }
  /// Whether the yield stress asks for the temperature; a variable shear modulus brings it along.
  bool yield_needs_temperature() const {
    return solid() && strength_is([]<class Model>(const Model&) { return hardens<Model> && !varies_shear<Model>; });
  }

 private:
  template <class Property>
  bool strength_is(const Property& property) const {
    return strength && std::visit(property, *strength);
  }
};

}  // namespace ejecta
