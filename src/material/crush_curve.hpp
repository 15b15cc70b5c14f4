#pragma once
#include <algorithm>
#include <cmath>

namespace ejecta {

struct CrushPoint {
  double alpha;  ///< distension
  double slope;  ///< d(alpha)/dP <= 0 [1/Pa]
};

/// Distension that a pressure crushes a porous material to: alpha0 up to P_e, 1 from P_s on, and in between
///   alpha = 1 + first ((P_t - P)/(P_t - P_e))^n1 [only below P_t] + second ((P_s - P)/(P_s - P_e))^n2.
/// Both published forms are made by the functions below. Decreasing and convex between P_e and P_s; the slope jumps at
/// P_e.
struct CrushCurve {
  double initial_distension;   ///< alpha0 = 1 + first + second
  double elastic_pressure;     ///< P_e [Pa]
  double transition_pressure;  ///< P_t [Pa]
  double solid_pressure;       ///< P_s [Pa]
  double first, second;        ///< amplitudes of the two power laws
  int n1, n2;                  ///< their exponents, >= 1

  /// alpha = 1 + (alpha0 - 1) ((P_s - P)/(P_s - P_e))^2 (Carroll & Holt 1972, J. Appl. Phys. 43, 1626).
  static CrushCurve quadratic(double alpha0, double elastic_pressure, double solid_pressure) {
    return {alpha0, elastic_pressure, elastic_pressure, solid_pressure, 0, alpha0 - 1, 1, 2};
  }
  /// Jutzi, Benz & Michel (2008, Icarus 198, 242): amplitudes alpha_e - alpha_t and alpha_t - 1, both multiplied by
  /// (alpha0 - 1)/(alpha_e - 1). The curve fitted with alpha_e at P_e thus starts at the alpha0 of the body at hand.
  static CrushCurve two_power(double alpha0, double alpha_e, double alpha_t, double elastic_pressure,
                              double transition_pressure, double solid_pressure, int n1, int n2) {
    const double rescale = (alpha0 - 1) / (alpha_e - 1);
    const double first = rescale * (alpha_e - alpha_t), second = rescale * (alpha_t - 1);
    return {alpha0, elastic_pressure, transition_pressure, solid_pressure, first, second, n1, n2};
  }

  double alpha(double pressure) const { return evaluate(pressure).alpha; }
  double dalpha_dP(double pressure) const { return evaluate(pressure).slope; }

  CrushPoint evaluate(double pressure) const {
    if (pressure <= elastic_pressure) return {initial_distension, 0};
    if (pressure >= solid_pressure) return {1, 0};
    return crushing(pressure);
  }

  /// Distension where the straight line P = pressure + slope (alpha' - alpha), slope >= 0, meets the curve.
  /// With the line as tangent of the equation of state this is a Newton step that keeps the curve and its kinks exact.
  ///
  /// G(p) = slope (alpha - curve(p)) + p - pressure grows and is concave, so Newton on p climbs to its zero from the
  /// left and a first step from the right lands left of it: no safeguard is needed. Stops when a step is below 1e-3 of
  /// the pressure range, its error being quadratic in that: the straight line is seldom better.
  double meet(double alpha, double pressure, double slope) const {
    if (slope * (alpha - 1) + solid_pressure - pressure <= 0) return 1;
    if (slope * (alpha - initial_distension) + elastic_pressure - pressure >= 0) return initial_distension;
    const double enough = 1e-3 * (solid_pressure - elastic_pressure);
    const bool inside = pressure > elastic_pressure && pressure < solid_pressure;
    double p = inside ? pressure : elastic_pressure;
    CrushPoint c = inside ? crushing(pressure) : foot();
    for (int iteration = 0;; ++iteration) {
      const double step = -(slope * (alpha - c.alpha) + p - pressure) / (1 - slope * c.slope);
      if (std::abs(step) < enough || iteration == 30) return c.alpha + c.slope * step;
      if (p + step > elastic_pressure) {
        p += step;
        c = crushing(p);
      } else {
        p = elastic_pressure;
        c = foot();
      }
    }
  }

 private:
  static double power(double x, int n) {
    double result = 1;
    for (; n > 0; n >>= 1, x *= x)
      if (n & 1) result *= x;
    return result;
  }
  static void add(CrushPoint& point, double amplitude, double end, double start, double pressure, int n) {
    const double scale = 1 / (end - start), x = (end - pressure) * scale, lower = amplitude * power(x, n - 1);
    point.alpha += lower * x;
    point.slope -= n * lower * scale;
  }
  /// Where crushing begins, P = P_e: no powers needed.
  CrushPoint foot() const {
    double slope = -n2 * second / (solid_pressure - elastic_pressure);
    if (first != 0) slope -= n1 * first / (transition_pressure - elastic_pressure);
    return {initial_distension, slope};
  }
  /// The power laws themselves, for P_e <= P < P_s.
  CrushPoint crushing(double pressure) const {
    CrushPoint point{1, 0};
    if (pressure < transition_pressure) add(point, first, transition_pressure, elastic_pressure, pressure, n1);
    add(point, second, solid_pressure, elastic_pressure, pressure, n2);
    return point;
  }
};

}  // namespace ejecta
