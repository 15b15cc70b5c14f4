#include "material/exact_riemann.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

namespace ejecta {

namespace {

double sound_speed(const GasState& s, double gamma) { return std::sqrt(gamma * s.pressure / s.density); }

/// What the velocity changes by across the wave between a side and pressure p (Toro 2009, eqs 4.6 and 4.7) [m/s].
double change_across(const GasState& side, double sound, double gamma, double p) {
  if (p > side.pressure) {
    const double a = 2 / ((gamma + 1) * side.density), b = (gamma - 1) / (gamma + 1) * side.pressure;
    return (p - side.pressure) * std::sqrt(a / (p + b));
  }
  if (sound == 0) return 0;
  return 2 * sound / (gamma - 1) * (std::pow(p / side.pressure, (gamma - 1) / (2 * gamma)) - 1);
}

}  // namespace

ExactRiemann::ExactRiemann(const GasState& left, const GasState& right, double gamma)
    : left_(left),
      right_(right),
      gamma_(gamma),
      sound_left_(sound_speed(left, gamma)),
      sound_right_(sound_speed(right, gamma)) {
  const double apart = right.velocity - left.velocity;
  if (apart >= 2 * (sound_left_ + sound_right_) / (gamma - 1)) return;  // Toro 2009, eq. 4.82
  const auto excess = [&](double p) {
    return change_across(left, sound_left_, gamma, p) + change_across(right, sound_right_, gamma, p) + apart;
  };
  // It rises with the pressure. Above the upper end two strong shocks alone would stop what comes together.
  double low = 0, high = 2 * std::max({left.pressure, right.pressure, 1e-300});
  while (excess(high) < 0) high *= 4;
  // Two rarefactions give the root in closed form, and are nearest to it where pressures are tiny beside one side's.
  std::uintmax_t iterations = 200;
  const auto close = [](double a, double b) { return b - a <= 4e-16 * b; };
  if (excess(high) > 0) {
    const auto bracket = boost::math::tools::toms748_solve(excess, low, high, close, iterations);
    low = bracket.first, high = bracket.second;
  }
  const double p = 0.5 * (low + high);
  const double u = 0.5 * (left.velocity + right.velocity) +
                   0.5 * (change_across(right, sound_right_, gamma, p) - change_across(left, sound_left_, gamma, p));
  star_ = Star{p, u};
}

double ExactRiemann::star_density(const GasState& side) const {
  const double p = star_->pressure, mu2 = (gamma_ - 1) / (gamma_ + 1);
  if (p > side.pressure) {
    const double ratio = p / side.pressure;
    return side.pressure > 0 ? side.density * (ratio + mu2) / (mu2 * ratio + 1) : side.density / mu2;
  }
  return side.density * std::pow(p / side.pressure, 1 / gamma_);
}

GasState ExactRiemann::behind_left_wave(const GasState& side, double contact, double speed) const {
  const double c = sound_speed(side, gamma_), fan = 2 / (gamma_ + 1);
  const auto inside_fan = [&] {
    const double sound = fan * (c + 0.5 * (gamma_ - 1) * (side.velocity - speed));
    const double density = side.density * std::pow(sound / c, 2 / (gamma_ - 1));
    return GasState{density, fan * (c + 0.5 * (gamma_ - 1) * side.velocity + speed),
                    side.pressure * std::pow(sound / c, 2 * gamma_ / (gamma_ - 1))};
  };
  if (!star_) {
    if (speed <= side.velocity - c) return side;
    const double edge = side.velocity + 2 * c / (gamma_ - 1);
    return speed < edge ? inside_fan() : GasState{0, edge, 0};
  }
  const GasState star{star_density(side), contact, star_->pressure};
  if (star_->pressure > side.pressure) {
    const double shock =
        side.velocity - std::sqrt(((gamma_ + 1) * star_->pressure + (gamma_ - 1) * side.pressure) / (2 * side.density));
    return speed <= shock ? side : star;
  }
  if (speed <= side.velocity - c) return side;
  return speed >= contact - sound_speed(star, gamma_) ? star : inside_fan();
}

GasState ExactRiemann::at(double speed) const {
  // A vacuum lies between the edges of both fans: each side answers up to its own.
  const double contact =
      star_
          ? star_->velocity
          : 0.5 * (left_.velocity + 2 * sound_left_ / (gamma_ - 1) + right_.velocity - 2 * sound_right_ / (gamma_ - 1));
  if (speed <= contact) return behind_left_wave(left_, contact, speed);
  GasState mirrored = behind_left_wave({right_.density, -right_.velocity, right_.pressure}, -contact, -speed);
  mirrored.velocity = -mirrored.velocity;
  return mirrored;
}

}  // namespace ejecta
