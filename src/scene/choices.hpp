#pragma once
/// The choices of a scene that also steer code which need not know the rest of it. They stand apart from scene.hpp so
/// that a new key of a scene does not compile every pair pass anew.
#include <array>
#include <cmath>
#include <limits>

namespace ejecta {

inline constexpr double unset = std::numeric_limits<double>::signaling_NaN();
inline bool is_set(double value) { return !std::isnan(value); }
using Triple = std::array<double, 3>;  ///< x, y, z; z is ignored in plane strain

enum class Kernel { cubic_spline, quintic_spline, wendland_c2, wendland_c4 };
enum class Precision { double_precision, mixed };
enum class DistensionSolver { safe_newton, bisection, newton };

}  // namespace ejecta
