#include "grid/tile_sweep.hpp"

#include "base/errors.hpp"
#include "grid/sweep_cells.hpp"
#include "grid/sweep_fluxes.hpp"

namespace ejecta {

namespace grid_detail {

template <int Dim, class Gas, SlopeLimiter limiter>
std::unique_ptr<TileSweep<Dim>> with_solver(const Gas& gas, const GridSettings& settings) {
  if (settings.riemann == RiemannSolver::hllc)
    return std::make_unique<Sweep<Dim, Gas, limiter, RiemannSolver::hllc>>(gas, settings);
  if constexpr (Gas::carries_energy)
    throw InputError("grid.riemann: expected hllc, got exact, which is known for ideal gases alone");
  else
    return std::make_unique<Sweep<Dim, Gas, limiter, RiemannSolver::exact>>(gas, settings);
}

template <int Dim, class Gas>
std::unique_ptr<TileSweep<Dim>> with_gas(const Gas& gas, const GridSettings& settings) {
  if (settings.limiter == SlopeLimiter::none) return with_solver<Dim, Gas, SlopeLimiter::none>(gas, settings);
  if (settings.limiter == SlopeLimiter::minmod) return with_solver<Dim, Gas, SlopeLimiter::minmod>(gas, settings);
  return with_solver<Dim, Gas, SlopeLimiter::monotonised_central>(gas, settings);
}

}  // namespace grid_detail

template <int Dim>
std::unique_ptr<TileSweep<Dim>> make_tile_sweep(const Eos& eos, const GridSettings& settings) {
  using namespace grid_detail;
  return std::visit(
      [&](const auto& e) {
        if constexpr (requires { IdealLanes(e); })
          return with_gas<Dim>(IdealLanes(e), settings);
        else
          return with_gas<Dim>(GeneralLanes(eos), settings);
      },
      eos);
}

template <int Dim>
CellState<Dim> cell_state(const Eos& eos, const Conserved<Dim>& cells, std::size_t i) {
  CellState<Dim> s{};
  s.density = cells[0][i];
  for (int a = 0; a < Dim; ++a) s.velocity[a] = cells[static_cast<std::size_t>(1 + a)][i] / s.density;
  s.specific_energy = cells[Dim + 1][i] / s.density - 0.5 * s.velocity.squaredNorm();
  std::visit(
      [&](const auto& e) {
        const EosPoint point = e.evaluate(s.density, s.specific_energy);
        s.pressure = point.pressure;
        s.sound_speed = sound_speed(point, s.density, e.sound_speed_floor());
      },
      eos);
  return s;
}

template std::unique_ptr<TileSweep<2>> make_tile_sweep<2>(const Eos&, const GridSettings&);
template std::unique_ptr<TileSweep<3>> make_tile_sweep<3>(const Eos&, const GridSettings&);
template CellState<2> cell_state<2>(const Eos&, const Conserved<2>&, std::size_t);
template CellState<3> cell_state<3>(const Eos&, const Conserved<3>&, std::size_t);

}  // namespace ejecta
