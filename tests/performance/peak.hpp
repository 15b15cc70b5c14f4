#pragma once
/// What the machine can do, measured in the same run as what is compared with it.
#include <chrono>

#include "base/simd.hpp"

namespace ejecta {

/// Floating-point operations per second of one core: a loop of fused multiply-adds on registers, the best of a few
/// tries.
template <class V>
double measured_peak() {
  constexpr int chains = 12, rounds = 200000, lanes = sizeof(V) / sizeof(V{}[0]);  // enough chains to hide the latency
  double best = 0;
  for (int trial = 0; trial < 5; ++trial) {
    V sum[chains] = {};
    const V factor = V{} + static_cast<decltype(+V{}[0])>(0.999), term = V{} + static_cast<decltype(+V{}[0])>(0.001);
    const auto start = std::chrono::steady_clock::now();
    for (int round = 0; round < rounds; ++round)
      for (V& s : sum) s = s * factor + term;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    V total{};
    for (const V& s : sum) total += s;
    asm volatile("" : : "m"(total));
    best = std::max(best, 2.0 * lanes * chains * rounds / taken.count());
  }
  return best;
}

/// The peak of vectors of T (8 doubles or 16 floats), measured once.
template <class T>
double peak_operations() {
  static const double peak = measured_peak<simd::Vector<T, simd::lanes<T>>>();
  return peak;
}

}  // namespace ejecta
