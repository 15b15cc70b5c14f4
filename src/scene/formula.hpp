#pragma once
/// Formulas in scene files: initial fields that are no constants.
#include <memory>
#include <string>

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

}  // namespace ejecta
