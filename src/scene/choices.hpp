#pragma once
/// The choices of a scene that also steer code which need not know the rest of it. They stand apart from scene.hpp so
/// that a new key of a scene does not compile every pair pass anew.
#include <array>
#include <cmath>
#include <limits>

namespace ejecta {

/// What nobody has given and has no default: a number is `unset`, which is_set() tells; a whole number is an empty
/// std::optional; a word, a list of words and a formula are empty. So it is in the settings of scenes and materials and
/// in what is made of them. Comparisons with `unset` are false. 0 and infinity are values, but for the few keys of a
/// file in which a 0 has always stood for "none": their description says so (Setting::zero_is_unset), and nothing
/// behind it sees that 0.
inline constexpr double unset = std::numeric_limits<double>::signaling_NaN();
inline bool is_set(double value) { return !std::isnan(value); }
using Triple = std::array<double, 3>;  ///< x, y, z; z is ignored in plane strain

enum class Kernel { cubic_spline, quintic_spline, wendland_c2, wendland_c4, gaussian };
enum class Precision { double_precision, mixed };
enum class DistensionSolver { safe_newton, bisection, newton };
enum class PairRiemann { approximate, exact };
enum class PairLimiter { monotonised_central, inutsuka, none };
enum class PairFaces { renormalised, kernel };

}  // namespace ejecta
