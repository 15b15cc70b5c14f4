#pragma once
/// Runs something with one, two and three threads and puts the number of threads back afterwards.
#include "base/parallel.hpp"

namespace ejecta {

template <class Body>
void for_thread_counts(Body&& body) {
  const int before = max_threads();
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    body(threads);
  }
  set_threads(before);
}

}  // namespace ejecta
