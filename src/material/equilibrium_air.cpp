#include "material/equilibrium_air.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "material/air_chemistry.hpp"

namespace ejecta {

namespace {

/// Nodes at equal steps of a logarithm.
struct Axis {
  double first, step;
  int nodes;

  static Axis decades(double first, double last, int per_decade) {
    return {std::log(first), std::numbers::ln10 / per_decade,
            static_cast<int>(std::lround(std::log10(last / first) * per_decade)) + 1};
  }
};

/// Weights of four nodes, and of their slope per step, at a place t = 0 to 1 between the inner two.
struct Cubic {
  std::array<double, 4> value, slope;

  explicit Cubic(double t) {
    const double t2 = t * t, t3 = t2 * t;
    value = {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2};
    slope = {(-3 * t2 + 4 * t - 1) / 2, (9 * t2 - 10 * t) / 2, (-9 * t2 + 8 * t + 1) / 2, (3 * t2 - 2 * t) / 2};
  }
};

/// g and its slopes by ln rho and ln e.
struct Interpolated {
  double g, by_log_density, by_log_energy;
};

class Table {
 public:
  static const Table& get() {
    static const Table table;  // once a run, and in none without this air
    return table;
  }

  Interpolated at(double log_density, double log_energy) const {
    const Place x(density_, log_density), y(energy_, log_energy);
    Interpolated p{0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) {
      const double* row = &g_[(x.node + i) * width_ + y.node];
      double value = 0, slope = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        value += y.cubic.value[j] * row[j];
        slope += y.cubic.slope[j] * row[j];
      }
      p.g += x.cubic.value[i] * value;
      p.by_log_density += x.cubic.slope[i] * value;
      p.by_log_energy += x.cubic.value[i] * slope;
    }
    p.by_log_density /= density_.step;
    p.by_log_energy /= energy_.step;
    return p;
  }

  double least_log_energy() const { return energy_.first; }

 private:
  /// Where a value lies: the first of four nodes, counted with the one before the axis. Beyond its ends: at the end.
  struct Place {
    std::size_t node;
    Cubic cubic;

    Place(const Axis& axis, double x) : Place((x - axis.first) / axis.step, axis.nodes - 1) {}

   private:
    // Of what is no number std::max makes 0; that it was none is seen in the pressure.
    Place(double steps, int last) : Place(last, std::max(0.0, std::min(steps, static_cast<double>(last)))) {}
    Place(int last, double steps)
        : node(static_cast<std::size_t>(std::min(static_cast<int>(steps), last - 1))),
          cubic(steps - static_cast<double>(node)) {}
  };

  Table()
      : width_(static_cast<std::size_t>(energy_.nodes + 2)), g_(static_cast<std::size_t>(density_.nodes + 2) * width_) {
    // Beyond each end one node like the one before it: no slope at the end.
    const auto mirrored = [](int k, int nodes) { return k < 0 ? -k : k < nodes ? k : 2 * (nodes - 1) - k; };
    std::vector<double> rows(static_cast<std::size_t>(density_.nodes * energy_.nodes));
    for (int i = 0; i < density_.nodes; ++i) fill_row(i, &rows[static_cast<std::size_t>(i * energy_.nodes)]);
    for (int i = -1; i <= density_.nodes; ++i)
      for (int j = -1; j <= energy_.nodes; ++j)
        g_[static_cast<std::size_t>(i + 1) * width_ + static_cast<std::size_t>(j + 1)] =
            rows[static_cast<std::size_t>(mirrored(i, density_.nodes) * energy_.nodes + mirrored(j, energy_.nodes))];
  }

  /// g at one density, upwards in energy: the temperature grows with it.
  void fill_row(int i, double* row) const {
    const double rho = std::exp(density_.first + i * density_.step);
    double log_temperature = std::log(10.0);
    for (int j = 0; j < energy_.nodes; ++j) {
      const double e = std::exp(energy_.first + j * energy_.step);
      const auto excess = [&](double log_t) {
        return std::log(air_in_equilibrium(rho, std::exp(log_t)).specific_energy / e);
      };
      double high = log_temperature + 0.1;
      while (excess(high) < 0) high += 0.5;
      std::uintmax_t steps = 100;
      const auto root = boost::math::tools::toms748_solve(excess, log_temperature, high,
                                                          boost::math::tools::eps_tolerance<double>(30), steps);
      log_temperature = root.first;
      const AirState state = air_in_equilibrium(rho, std::exp((root.first + root.second) / 2));
      row[j] = state.pressure / (rho * state.specific_energy);
    }
  }

  const Axis density_ = Axis::decades(1e-6, 1e4, 3), energy_ = Axis::decades(1e5, 1e13, 48);
  std::size_t width_;
  std::vector<double> g_;
};

}  // namespace

EosPoint EquilibriumAir::evaluate(double rho, double e) const {
  const Table& table = Table::get();
  const double log_energy = e > 0 ? std::log(e) : table.least_log_energy();
  const Interpolated p = table.at(std::log(rho), log_energy);
  return {p.g * rho * e, (p.g + p.by_log_density) * e, (p.g + p.by_log_energy) * rho};
}

double EquilibriumAir::specific_energy(double rho, double pressure) const {
  const Table& table = Table::get();
  const double log_density = std::log(rho), cold = table.at(log_density, table.least_log_energy()).g;
  const double as_cold = pressure / (cold * rho);
  if (as_cold <= std::exp(table.least_log_energy())) return as_cold;
  // P grows with e, and g lies between 1/30 and 1.
  const auto excess = [&](double log_energy) {
    return table.at(log_density, log_energy).g * rho * std::exp(log_energy) / pressure - 1;
  };
  const double low = std::log(pressure / rho);
  std::uintmax_t steps = 100;
  const auto root = boost::math::tools::toms748_solve(excess, low, low + std::log(30.0),
                                                      boost::math::tools::eps_tolerance<double>(52), steps);
  return std::exp((root.first + root.second) / 2);
}

}  // namespace ejecta
