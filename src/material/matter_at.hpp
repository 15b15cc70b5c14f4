#pragma once
/// What the bodies of a scene say of a point at the start, for solvers that fill space instead of placing particles.
#include <array>
#include <optional>
#include <vector>

#include "material/material.hpp"
#include "scene/formula.hpp"

namespace ejecta {

/// Matter around a point that depends on the distance from it alone: a blast before it has met anything.
struct RadialState {
  Triple center;           ///< m
  double time = 0;         ///< s
  double spacing = 0;      ///< width of its cells, the first at the centre [m]
  double charge_radius = 0;  ///< how far the matter of the charge reaches [m]
  std::vector<double> density, velocity, specific_energy;  ///< of cells [kg/m^3, m/s outwards, J/kg]

  double radius() const { return spacing * static_cast<double>(density.size()); }  ///< m
};

template <int Dim>
struct Matter {
  std::size_t body;  ///< place in scene.bodies
  double density;    ///< kg/m^3
  Vec<Dim> velocity;       ///< m/s
  double specific_energy;  ///< J/kg

  /// Mass, momentum and energy per volume [kg/m^3, kg/(m^2 s), J/m^3].
  std::array<double, Dim + 2> conserved() const {
    std::array<double, Dim + 2> u{};
    u[0] = density;
    for (int a = 0; a < Dim; ++a) u[static_cast<std::size_t>(1 + a)] = density * velocity[a];
    u[Dim + 1] = density * (specific_energy + 0.5 * velocity.squaredNorm());
    return u;
  }
  /// Whether the two are the same state, bit for bit, of whatever body.
  bool same_state(const Matter& other) const {
    return density == other.density && velocity == other.velocity && specific_energy == other.specific_energy;
  }
};

/// Calls see(x) at n points along each edge of a cube (a square) around `centre`.
template <int Dim, class See>
void for_points(const Vec<Dim>& centre, double edge, int n, See&& see) {
  const int all = Dim == 2 ? n * n : n * n * n;
  for (int k = 0; k < all; ++k) {
    Vec<Dim> x = centre;
    for (int a = 0, rest = k; a < Dim; ++a, rest /= n) x[a] += ((rest % n + 0.5) / n - 0.5) * edge;
    see(x);
  }
}

/// Points along an edge that weigh the states that meet in a cell.
template <int Dim>
constexpr int cell_samples = Dim == 2 ? 32 : 12;

/// Asks the bodies in their order: the first that holds the point has it, and [gas] all that is left. Not for use by two
/// threads at once, because of the formulas.
template <int Dim>
class MatterAt {
 public:
  /// `spacing` [m]: dx of the formulas. `around` takes the place of what the scene says, where it reaches. All must
  /// outlive it.
  MatterAt(const Scene& scene, const std::vector<Material>& materials, double spacing,
           const RadialState* around = nullptr);

  /// Nothing if no body is there. Throws InputError where a formula gives what cannot be.
  std::optional<Matter<Dim>> operator()(const Vec<Dim>& x) const;
  /// Mass, momentum and energy per volume in a cube (a square) of this edge [m] around x, as n points along each edge say
  /// [kg/m^3, kg/(m^2 s), J/m^3]. Nothing if one of them is in no body.
  std::optional<std::array<double, Dim + 2>> mean(const Vec<Dim>& x, double edge, int n) const;
  /// Of one body, wherever it is.
  Matter<Dim> of_body(std::size_t body, const Vec<Dim>& x) const;
  /// Whether some body's state varies within it.
  bool varies() const;
  /// Whether `around` reaches to less than `distance` [m] from x.
  bool is_around(const Vec<Dim>& x, double distance) const;

 private:
  void set_around(Matter<Dim>& matter, const Vec<Dim>& x) const;
  struct Formulas {
    std::optional<Formula> density, pressure, specific_energy;
    std::vector<Formula> velocity;
    bool any() const { return density || pressure || specific_energy || !velocity.empty(); }
  };
  const Scene& scene_;
  double spacing_;
  const RadialState* around_;
  std::vector<const Material*> material_;  ///< of each body
  std::vector<Formulas> formulas_;
};

}  // namespace ejecta
