#pragma once
/// The only place that knows about threads. Loops give each thread its own particles; reductions sum fixed blocks in
/// a fixed order, so every result is the same bit for bit whatever the number of threads.
#include <omp.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>

namespace ejecta {

inline void set_threads(int threads) { omp_set_num_threads(threads); }
inline int max_threads() { return omp_get_max_threads(); }
inline int available_cores() { return omp_get_num_procs(); }
inline int thread_index() { return omp_get_thread_num(); }

/// Calls body(begin, end) on consecutive blocks of [0, n) of the given grain, dynamically scheduled.
/// The first exception (by block order of arrival) is rethrown after the loop.
template <class Body>
void parallel_blocks(std::size_t n, std::size_t grain, Body&& body) {
  const std::ptrdiff_t blocks = static_cast<std::ptrdiff_t>((n + grain - 1) / grain);
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) if (blocks > 1)
  for (std::ptrdiff_t b = 0; b < blocks; ++b) {
    const std::size_t begin = static_cast<std::size_t>(b) * grain;
    try {
      body(begin, std::min(n, begin + grain));
    } catch (...) {
#pragma omp critical(ejecta_failure)
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// Calls body(i) for every i in [begin, end).
template <class Body>
void parallel_for(std::size_t begin, std::size_t end, Body&& body) {
  if (begin >= end) return;
  constexpr std::size_t grain = 1024;
  parallel_blocks(end - begin, grain, [&](std::size_t b, std::size_t e) {
    for (std::size_t i = begin + b; i < begin + e; ++i) body(i);
  });
}

/// Reductions cut [0, n) into this many blocks whatever the number of threads, and combine them in order.
inline constexpr std::size_t reduction_blocks = 64;

/// Sum of value(i) over [0, n), independent of the thread count. T needs T{} as zero and +=.
template <class T, class Value>
T parallel_sum(std::size_t n, Value&& value) {
  std::array<T, reduction_blocks> partial{};
  parallel_blocks(reduction_blocks, 1, [&](std::size_t block, std::size_t) {
    T sum{};
    for (std::size_t i = block * n / reduction_blocks; i < (block + 1) * n / reduction_blocks; ++i) sum += value(i);
    partial[block] = sum;
  });
  T total{};
  for (const T& p : partial) total += p;
  return total;
}

/// The smallest value below `initial` and the lowest index that attains it (index n if there is none).
struct IndexedMin {
  double value;
  std::size_t index;
};
template <class Value>
IndexedMin parallel_min(std::size_t n, double initial, Value&& value) {
  std::array<IndexedMin, reduction_blocks> partial;
  parallel_blocks(reduction_blocks, 1, [&](std::size_t block, std::size_t) {
    IndexedMin least{initial, n};
    for (std::size_t i = block * n / reduction_blocks; i < (block + 1) * n / reduction_blocks; ++i)
      if (const double v = value(i); v < least.value) least = {v, i};
    partial[block] = least;
  });
  IndexedMin least{initial, n};
  for (const IndexedMin& p : partial)
    if (p.value < least.value) least = p;
  return least;
}

}  // namespace ejecta
