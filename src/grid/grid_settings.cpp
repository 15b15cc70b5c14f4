#include "grid/grid_settings.hpp"

#include "scene/describer.hpp"

namespace ejecta {

void GridSettings::describe(Describer& d) {
  d.choice("riemann", riemann, "what passes through faces; exact: of ideal gases, ten times slower");
  d.choice("limiter", limiter, "of the slopes within cells; none: first order");
  d.flag("flattening", flattening, "slopes fade inside strong shocks: less ripple behind them, and wider fronts");
  d.flag("smearing", smearing,
         "along strong shocks fluxes smear; else shocks that run along an axis fall apart into rows");
  d.number("courant", courant, "1", {.min = 0, .max = 1, .open_min = true},
           "time step in crossings of a cell by a signal; else 0.8 in 2D, 0.45 in 3D");
}

GridSettings grid_settings(const Scene& scene) {
  const auto section = scene.sections.find("grid");
  return section == scene.sections.end() ? GridSettings{} : dynamic_cast<const GridSettings&>(*section->second);
}

}  // namespace ejecta
