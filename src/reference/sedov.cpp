#include "reference/sedov.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cassert>
#include <cmath>

namespace ejecta {

namespace {

/// Logarithm of the density, velocity, pressure, as in Sedov::State, and the energy between here and the shock over
/// that of `all_directions` and density times speed squared times R^nu.
using Variables = std::array<double, 4>;

/// Euler's equations for rho = rho0 G(x), u = D U(x), p = rho0 D^2 P(x), with x = r/R, D = dR/dt and R D'/D = -nu D/2:
///   (U - x) G'/G + U' = -(nu - 1) U / x,  (U - x) U' + P'/G = nu U / 2,  (U - x)(P'/P - gamma G'/G) = nu.
struct Equations {
  int nu;
  double gamma;

  void operator()(const Variables& v, Variables& slope, double x) const {
    const double density = std::exp(v[0]), u = v[1], p = v[2], n = nu;
    const double w = u - x, c2 = gamma * p / density, spread = (n - 1) * u / x;
    // P'/G from the third with G'/G from the first, put into the second.
    const double du = (0.5 * n * u * w - n * p / density + c2 * spread) / (w * w - c2);
    slope[0] = -(spread + du) / w;
    slope[1] = du;
    slope[2] = density * (0.5 * n * u - w * du);
    slope[3] = -(0.5 * density * u * u + p / (gamma - 1)) * std::pow(x, n - 1);
  }
};

/// From the shock inwards to x = `to`.
Variables integrate(int nu, double gamma, double to) {
  using namespace boost::numeric::odeint;
  // Strong shock: Rankine & Hugoniot.
  Variables v{std::log((gamma + 1) / (gamma - 1)), 2 / (gamma + 1), 2 / (gamma + 1), 0};
  if (to < 1)
    integrate_adaptive(make_controlled<runge_kutta_dopri5<Variables>>(1e-12, 1e-12), Equations{nu, gamma}, v, 1.0, to,
                       -1e-3 * (1 - to));
  return v;
}

}  // namespace

Sedov::Sedov(Geometry geometry, double gamma) : nu_(1 + static_cast<int>(geometry)), gamma_(gamma) {
  assert(gamma > 1 && exists(geometry, gamma));
  // The density falls as x^(nu/(gamma-1)): not so far that nothing is left of it.
  core_ = std::max(1e-3, std::exp(-60 * (gamma - 1) / nu_));
  const Variables v = integrate(nu_, gamma, core_);
  at_core_ = {std::exp(v[0]), v[1], v[2]};
  const double energy = v[3] + v[2] / (gamma - 1) * std::pow(core_, nu_) / nu_;
  const double exponent = 2.0 / (nu_ + 2);  // R ~ t^exponent
  const double directions = geometry == Geometry::planar ? 2 : all_directions(geometry);
  alpha_ = directions * energy * exponent * exponent;
}

double Sedov::radius(double energy, double density, double time) const {
  return std::pow(energy * time * time / (alpha_ * density), 1.0 / (nu_ + 2));
}

double Sedov::speed(double energy, double density, double time) const {
  return 2.0 / (nu_ + 2) * radius(energy, density, time) / time;
}

Sedov::State Sedov::state(double at) const {
  if (at < core_) {
    const double x = at / core_;
    return {at_core_.density * std::pow(x, nu_ / (gamma_ - 1)), at_core_.velocity * x, at_core_.pressure};
  }
  const Variables v = integrate(nu_, gamma_, at);
  return {std::exp(v[0]), v[1], v[2]};
}

}  // namespace ejecta
