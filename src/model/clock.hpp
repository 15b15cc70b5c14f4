#pragma once
#include <cstdint>

namespace ejecta {

struct Clock {
  double time = 0;  ///< s
  double dt = 0;    ///< last step [s]
  std::int64_t step = 0;
};

}  // namespace ejecta
