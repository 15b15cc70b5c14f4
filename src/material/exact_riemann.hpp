#pragma once
/// Riemann's problem of an ideal gas, solved exactly.
#include <optional>

namespace ejecta {

/// Gas on one side, in one dimension.
struct GasState {
  double density;   ///< kg/m^3, > 0
  double velocity;  ///< m/s
  double pressure;  ///< Pa, >= 0
};

/// What comes of two uniform gases of the same adiabatic index that meet at t = 0 [Toro 2009, ch. 4]: a shock or a
/// rarefaction to either side and a contact between them; a vacuum between them where they part faster than they can
/// expand (Toro, sect. 4.6).
class ExactRiemann {
 public:
  /// `gamma` > 1.
  ExactRiemann(const GasState& left, const GasState& right, double gamma);

  bool vacuum() const { return !star_; }
  /// Pressure [Pa] and velocity [m/s] between the waves; 0 and unknown of a vacuum.
  double star_pressure() const { return star_ ? star_->pressure : 0; }
  double star_velocity() const { return star_ ? star_->velocity : 0; }
  /// Density beside the contact, 0 of a vacuum [kg/m^3].
  double star_density_left() const { return star_ ? star_density(left_) : 0; }
  double star_density_right() const { return star_ ? star_density(right_) : 0; }
  /// The state along the line x = speed t [m/s].
  GasState at(double speed) const;

 private:
  struct Star {
    double pressure, velocity;
  };
  double star_density(const GasState& side) const;
  /// Beside the contact, seen with the wave running to the left: the state at `speed`.
  GasState behind_left_wave(const GasState& side, double contact, double speed) const;

  GasState left_, right_;
  double gamma_, sound_left_, sound_right_;
  std::optional<Star> star_;
};

}  // namespace ejecta
