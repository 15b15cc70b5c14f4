#pragma once
/// Random numbers without a state: any number of any stream can be asked for in any order and by any thread.
#include <cstdint>

namespace ejecta {

/// Finaliser of SplitMix64 (Steele, Lea & Flood 2014, OOPSLA): every input bit affects every output bit.
inline std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Uniform number in (0, 1), the `draw`-th of the stream (seed, key).
inline double uniform_random(std::uint64_t seed, std::uint64_t key, std::uint64_t draw) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t bits = mix_bits(mix_bits(mix_bits(seed + golden) ^ key) + golden * (draw + 1));
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

}  // namespace ejecta
