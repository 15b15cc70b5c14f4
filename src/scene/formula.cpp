#include "scene/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/errors.hpp"

namespace ejecta {

struct Formula::Variables {
  double x = 0, y = 0, z = 0, r = 0, dx = 0;
};

namespace {
double hypotenuse(double a, double b) { return std::hypot(a, b); }

/// muParser takes a single = for an assignment, where people mean a comparison.
bool assigns(std::string text) {
  for (const char* comparison : {"==", "<=", ">=", "!="})
    for (std::size_t at; (at = text.find(comparison)) != std::string::npos;) text.erase(at, 2);
  return text.find('=') != std::string::npos;
}
}  // namespace

Formula::Formula(const std::string& text)
    : variables_(std::make_unique<Variables>()), parser_(std::make_unique<mu::Parser>()) {
  if (assigns(text)) throw InputError(fmt::format("expected a formula, got \"{}\": to compare write ==", text));
  try {
    parser_->DefineVar("x", &variables_->x);
    parser_->DefineVar("y", &variables_->y);
    parser_->DefineVar("z", &variables_->z);
    parser_->DefineVar("r", &variables_->r);
    parser_->DefineVar("dx", &variables_->dx);
    parser_->DefineFun("hypot", hypotenuse);
    parser_->DefineConst("pi", std::numbers::pi);
    parser_->SetExpr(text);
    parser_->Eval();  // compiles; the value at the origin does not matter
  } catch (const mu::ParserError& error) {
    throw InputError(fmt::format("expected a formula of x, y, z, r, dx and pi, got \"{}\": {}", text, error.GetMsg()));
  }
  if (parser_->GetNumResults() != 1)
    throw InputError(fmt::format("expected one formula, got {} in \"{}\"", parser_->GetNumResults(), text));
}

Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

void refuse_value(const Body& body, const std::string& key, const std::string& expected, double value,
                  const FormulaPoint& point) {
  throw InputError(fmt::format("{}: bodies.{}.profile.{}: expected {}, got {} at ({:.6g}, {:.6g}, {:.6g}) m",
                               body.origin, body.name, key, expected, value, point.x[0], point.x[1], point.x[2]));
}

double Formula::operator()(const FormulaPoint& point) const {
  *variables_ = {point.x[0], point.x[1], point.x[2], point.r, point.spacing};
  try {
    return parser_->Eval();
  } catch (const mu::ParserError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace ejecta
