#pragma once
#include <limits>
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
  std::optional<Elastic> elastic;                                ///< absent: a fluid
  std::optional<Strength> strength;                              ///< absent in a solid: elastic without limit
  double melt_energy = std::numeric_limits<double>::infinity();  ///< J/kg
  std::optional<GradyKipp> damage;
  std::optional<Porosity> porosity;

  /// Density of the unstressed, uncrushed body [kg/m^3].
  double bulk_density() const { return reference_density(eos) / (porosity ? porosity->initial_distension() : 1.0); }
  /// Whether it carries deviatoric stress.
  bool solid() const { return elastic.has_value(); }
  bool tensor_damage() const { return damage && damage->tensor; }
  /// Whether cracks cut the deviatoric stress between two particles, by direction. Not where broken matter has a
  /// friction law: its deviator is bounded by the yield stress at the largest eigenvalue of damage, and no pair is cut.
  bool cuts_pairs() const {
    return tensor_damage() && strength &&
           std::visit([](const auto& s) { return s.intact_fraction(1) != 1; }, *strength);
  }
  /// Whether plastic strain breaks it.
  bool breaks_in_shear() const {
    const Collins* rock = strength ? std::get_if<Collins>(&*strength) : nullptr;
    return rock && solid() && rock->breaks_in_shear();
  }
  /// Whether it stays elastic up to large strains, as rubber does: without end, or beyond a strain of a twentieth.
  /// Particles that stretch so far must hold on to the neighbours of the start (schemes/pair_pass.hpp).
  bool stretches() const {
    if (!elastic || damage || porosity) return false;
    const double limit = 0.05 * elastic->young();
    return !strength || std::visit(
                            [&](const auto& s) {
                              if constexpr (requires { s.yield(StrengthState{}); })
                                return s.yield(StrengthState{}) > limit;
                              else
                                return false;  // metals
                            },
                            *strength);
  }
  /// The model of a shear modulus that depends on the state; null if it is the constant of `elastic`.
  const SteinbergGuinan* variable_shear() const {
    return strength ? std::get_if<SteinbergGuinan>(&*strength) : nullptr;
  }
};

}  // namespace ejecta
