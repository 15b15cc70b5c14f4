#include "material/damage.hpp"

#include <limits>
#include <numbers>

#include "base/random.hpp"

namespace ejecta {

namespace {
/// Poisson-distributed count of the given mean (some tens at most) by inversion of its cumulative distribution.
double poisson(double mean, double u) {
  double count = 0, probability = std::exp(-mean), cumulative = probability;
  while (u > cumulative && probability > 0) {
    ++count;
    probability *= mean / count;
    cumulative += probability;
  }
  return count;
}
}  // namespace

Flaws draw_flaws(const GradyKipp& model, double volume, double particles, std::uint64_t seed, std::uint64_t key) {
  const double mean = std::log(particles) + std::numbers::egamma;
  const double n = std::max(1.0, poisson(mean, uniform_random(seed, key, 0)));
  // (eps/eps_max)^m of the flaws are n uniform numbers: the least of them, then the largest of the others above it.
  const double least = -std::expm1(std::log(uniform_random(seed, key, 1)) / n);
  const double largest = n > 1 ? least + (1 - least) * std::pow(uniform_random(seed, key, 2), 1 / (n - 1)) : least;
  const double log_eps_max = (std::log(mean) - std::log(model.weibull_k) - std::log(volume)) / model.weibull_m;
  const double log_ratio = (std::log(largest) - std::log(least)) / model.weibull_m;
  return {std::exp(log_eps_max + std::log(least) / model.weibull_m), n > 1 ? std::log(n) / log_ratio : 0.0, n};
}

double draw_weakest_flaw(const GradyKipp& model, double volume, std::uint64_t seed, std::uint64_t key) {
  const double number = -std::log(uniform_random(seed, key, 0));
  return std::exp((std::log(number) - std::log(model.weibull_k) - std::log(volume)) / model.weibull_m);
}

OpenCracks dealt_cracks(const Flaws& flaws) {
  const double strongest = flaws.exponent > 0 ? flaws.strain * std::pow(flaws.count, 1 / flaws.exponent) : flaws.strain;
  return {flaws.strain, flaws.strain, strongest, flaws.exponent, 3, flaws.count};
}

OpenCracks weibull_cracks(const GradyKipp& model, int dim, double volume, double weakest) {
  const double m = model.weibull_m;
  const double share = dim == 2 ? (m + 2) / (2 * (m + 1)) : 2 * (m + 3) * (m + 3) / (9 * (m + 1) * (m + 2));
  const double one = std::exp(-(std::log(share) + std::log(model.weibull_k) + std::log(volume)) / m);
  return {weakest, one, std::numeric_limits<double>::infinity(), m / dim, dim};
}

}  // namespace ejecta
