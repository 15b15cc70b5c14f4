#include "observe/colour_ranges.hpp"

#include <algorithm>
#include <cmath>

namespace ejecta {

std::map<std::string, ColourRange> colour_ranges(const Scene& scene, const std::vector<Material>& materials,
                                                 const Outset& outset) {
  double distension = 1;
  for (const Material& m : materials)
    if (m.porosity) distension = std::max(distension, m.porosity->initial_distension());
  const double stiffest = outset.pressure, densest = outset.density;
  const double fastest = outset.speed > 0 ? outset.speed : std::sqrt(stiffest / densest);
  std::map<std::string, ColourRange> ranges{{"pressure", {std::min(0.0, -0.05 * stiffest), stiffest}},
                                            {"pressure_peak", {0, stiffest}},
                                            {"density", {0, densest}},
                                            {"velocity", {0, fastest}},
                                            {"distension", {1, std::max(1.01, distension)}},
                                            {"aspect", {1, std::clamp(scene.numerics.largest_aspect, 1.5, 4.0)}},
                                            {"damage", {0, 1}}};
  for (const auto& [name, range] : scene.insitu.ranges) ranges[name] = range;
  return ranges;
}

}  // namespace ejecta
