#pragma once
/// Formulas in scene files: initial fields that are no constants.
#include <cmath>
#include <memory>
#include <string>

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace mu {
class Parser;
}

namespace ejecta {

/// Where a formula is evaluated.
struct FormulaPoint {
  Triple x{};          ///< m
  double r = 0;        ///< distance from the centre of the body [m]
  double spacing = 0;  ///< of the body's particles [m]
};

/// A formula of x, y, z, r and dx (the spacing), in SI, such as "-x/hypot(x, y)". Operators + - * / ^ ?: and
/// comparisons; functions of muParser (sqrt, exp, ln, sin, cos, min, max, sign, ...), and hypot(a, b). Not for use by
/// two threads at once.
class Formula {
 public:
  /// Throws InputError with what was expected and got.
  explicit Formula(const std::string& text);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// Value in SI; not finite where the formula is not defined.
  double operator()(const FormulaPoint& point) const;

 private:
  struct Variables;
  std::unique_ptr<Variables> variables_;  // the parser holds their addresses
  std::unique_ptr<mu::Parser> parser_;
};

/// A point x [m] of a body whose elements are `spacing` [m] apart.
template <int Dim>
FormulaPoint formula_point(const Body& body, const Vec<Dim>& x, double spacing) {
  FormulaPoint point{.spacing = spacing};
  double r2 = 0;
  for (std::size_t a = 0; a < Dim; ++a) {
    point.x[a] = x[static_cast<Eigen::Index>(a)];
    r2 += (point.x[a] - body.center[a]) * (point.x[a] - body.center[a]);
  }
  point.r = std::sqrt(r2);
  return point;
}

/// Throws InputError: what a formula of a body's profile gave at a point.
[[noreturn]] void refuse_value(const Body& body, const std::string& key, const std::string& expected, double value,
                               const FormulaPoint& point);

}  // namespace ejecta
