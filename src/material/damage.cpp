#include "material/damage.hpp"

#include <numbers>

namespace ejecta {

namespace {
/// Finaliser of SplitMix64 (Steele, Lea & Flood 2014, OOPSLA): every input bit affects every output bit.
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Uniform number in (0, 1), the `draw`-th of the stream (seed, key). No state: any stream can be asked in any order.
double uniform(std::uint64_t seed, std::uint64_t key, std::uint64_t draw) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t bits = mix(mix(mix(seed + golden) ^ key) + golden * (draw + 1));
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

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
  const double n = std::max(1.0, poisson(mean, uniform(seed, key, 0)));
  // (eps/eps_max)^m of the flaws are n uniform numbers: the least of them, then the largest of the others above it.
  const double least = -std::expm1(std::log(uniform(seed, key, 1)) / n);
  const double largest = n > 1 ? least + (1 - least) * std::pow(uniform(seed, key, 2), 1 / (n - 1)) : least;
  const double log_eps_max = (std::log(mean) - std::log(model.weibull_k) - std::log(volume)) / model.weibull_m;
  const double log_ratio = (std::log(largest) - std::log(least)) / model.weibull_m;
  return {std::exp(log_eps_max + std::log(least) / model.weibull_m), n > 1 ? std::log(n) / log_ratio : 0.0, n};
}

}  // namespace ejecta
