#pragma once
#include <cstdint>

namespace ejecta {

struct Clock {
  double time = 0;  ///< s
  double dt = 0;    ///< last step [s]
  std::int64_t step = 0;
  double before = 0;  ///< time before the last step [s]: rounded, it is not time - dt
};

}  // namespace ejecta
