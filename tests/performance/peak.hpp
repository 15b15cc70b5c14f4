#pragma once
/// What one core can do at best, measured right before what is compared with it and by the same clock: processor time,
/// so that other programs on the machine disturb neither.
#include <algorithm>
#include <cstring>
#include <ctime>
#include <vector>

#include "base/simd.hpp"

namespace ejecta {

/// Processor time of this thread so far [s].
inline double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The shortest processor time of a few calls [s].
template <class Body>
double shortest_seconds(Body&& body) {
  double best = 1e300;
  for (int trial = 0; trial < 5; ++trial) {
    const double start = processor_seconds();
    body();
    best = std::min(best, processor_seconds() - start);
  }
  return best;
}

/// Floating-point operations per second: a loop of fused multiply-adds of full vectors of T on registers.
template <class T>
double peak_flops() {
  using V = simd::Vector<T, simd::lanes<T>>;
  constexpr int chains = 12, rounds = 200000;  // enough chains to hide the latency
  const V factor = V{} + T(0.999), term = V{} + T(0.001);
  const double seconds = shortest_seconds([&] {
    V sum[chains];
    for (int k = 0; k < chains; ++k) sum[k] = V{} + T(k);  // all different, so that no two of them are made one
    for (int round = 0; round < rounds; ++round)
      for (V& s : sum) s = s * factor + term;
    V total{};
    for (const V& s : sum) total += s;
    asm volatile("" : : "m"(total));
  });
  return 2.0 * simd::lanes<T> * chains * rounds / seconds;
}

/// Bytes read plus bytes written per second when memory is copied that no cache holds.
inline double peak_bandwidth() {
  constexpr std::size_t size = std::size_t{96} << 20;
  static const std::vector<char> from(size, 1);
  static std::vector<char> to(size, 2);
  const double seconds = shortest_seconds([&] {
    std::memcpy(to.data(), from.data(), size);
    asm volatile("" : : "m"(to[0]) : "memory");
  });
  return 2.0 * size / seconds;
}

}  // namespace ejecta
