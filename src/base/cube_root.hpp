#pragma once
/// Cube roots for hot loops: no call, no division.
#include <bit>
#include <cstdint>

namespace ejecta {

/// Cube root of a >= 0 to a few units in the last place; 0 of 0 and of subnormal numbers.
inline double cube_root(double a) {
  // A third of the exponent taken off a constant gives 1/cbrt(a) to 3.5 per cent. A step multiplies by the series of
  // (1 - e)^(-1/3), e = 1 - a y^3, and brings an error e to 0.43 e^4.
  constexpr std::uint64_t of_one = 0x553ee80000000000ull;
  double y = std::bit_cast<double>(of_one - std::bit_cast<std::uint64_t>(a) / 3);
  for (int k = 0; k < 2; ++k) {
    const double e = 1 - a * y * (y * y);
    y += y * e * (1.0 / 3 + e * (2.0 / 9 + e * (14.0 / 81)));
  }
  return a * (y * y);
}

}  // namespace ejecta
