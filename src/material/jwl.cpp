#include "material/jwl.hpp"

#include <boost/math/tools/minima.hpp>
#include <limits>

namespace ejecta {

ChapmanJouguet Jwl::chapman_jouguet() const {
  // Energy on the Hugoniot is E = E0 + P (1 - V)/2, which makes the equation of state linear in P.
  const auto pressure = [&](double V) {
    const double cold = A * (1 - omega / (R1 * V)) * std::exp(-R1 * V) + B * (1 - omega / (R2 * V)) * std::exp(-R2 * V);
    return (cold + omega * E0 / V) / (1 - omega * (1 - V) / (2 * V));
  };
  // Momentum: P = rho0 D^2 (1 - V).
  const auto square = [&](double V) { return pressure(V) / (rho0 * (1 - V)); };
  // The least is at 0.73 to 0.76 for the explosives in use; constants without one end at a bound, and miss their D.
  constexpr double densest = 0.4, thinnest = 0.99;
  const auto [V, least] =
      boost::math::tools::brent_find_minima(square, densest, thinnest, std::numeric_limits<double>::digits / 2);
  const double speed = std::sqrt(least);
  return {speed, pressure(V), V, speed * (1 - V)};
}

}  // namespace ejecta
