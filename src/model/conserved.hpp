#pragma once
/// The ledger of a run: what must not change but by loads from outside.
#include "base/types.hpp"

namespace ejecta {

struct Totals {
  double mass = 0;                           ///< kg (kg/m in plane strain)
  Vec<3> mass_moment = Vec<3>::Zero();       ///< sum m x [kg m]
  Vec<3> momentum = Vec<3>::Zero();          ///< kg m/s
  Vec<3> angular_momentum = Vec<3>::Zero();  ///< about the origin [kg m^2/s]
  double momentum_scale = 0;                 ///< sum |m v|, to measure momentum errors against [kg m/s]
  double angular_scale = 0;                  ///< sum |x - x_c| |m v|, the same for angular momentum [kg m^2/s]
  double kinetic = 0, internal = 0;          ///< J
  double energy() const { return kinetic + internal; }
  Totals& operator+=(const Totals& o);
};

/// What acts from outside, on driven bodies for instance, and what it has done so far.
struct ExternalLoad {
  Vec<3> force = Vec<3>::Zero();            ///< at present [N] (N/m in plane strain)
  double power = 0;                         ///< of that force [W]
  Vec<3> torque = Vec<3>::Zero();           ///< of that force about the origin [N m]
  Vec<3> impulse = Vec<3>::Zero();          ///< since the start [kg m/s]
  Vec<3> angular_impulse = Vec<3>::Zero();  ///< since the start, about the origin [kg m^2/s]
  double work = 0;                          ///< since the start [J]
  double mass = 0;                          ///< added since the start [kg] (kg/m in plane strain)
  ExternalLoad& operator+=(const ExternalLoad& o);
};

/// Impulse and work of a step dt [s] with the mean of the loads at its ends. The heating of the pair pass goes with the
/// forces at both ends in just these shares (sph/integrator.hpp) and a driven particle keeps its velocity v, so that
/// energy changes by exactly -m a.v dt/2 for each: total energy less work is constant to round-off. Likewise the kicks
/// at both ends turn the rest about the places where they act, and moving along v turns nothing.
void add_step(ExternalLoad& total, const ExternalLoad& before, const ExternalLoad& after, double dt);

/// Relative errors of what must not change but by external loads.
struct ConservationErrors {
  double mass, momentum, angular_momentum, energy;
};
/// Pair forces along the pair conserve angular momentum; stress, tensor smoothing and corrected gradients turn them out
/// of that line. Energy is measured against the largest of total energy and kinetic energy at the start, and external
/// work.
ConservationErrors conservation_errors(const Totals& initial, const Totals& now, const ExternalLoad& external = {});

/// What the surroundings leave alone. Momentum means nothing where faces reflect, angular momentum nothing where there
/// are faces at all: their loads are not counted.
struct Kept {
  bool momentum = true, angular_momentum = true;
};

}  // namespace ejecta
