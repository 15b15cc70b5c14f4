#include "hybrid/hybrid_settings.hpp"

#include "scene/describer.hpp"

namespace ejecta {

void HybridSettings::describe(Describer& d) {
  d.integer("ratio", ratio, at_least(2),
            "spacing of the grid over resolution.spacing, that of the particles: 2, 4, 8, ...");
  d.number("jump", jump, "1", positive,
           "a front is between two cells that close in on each other, with pressures that differ by this share of the "
           "lower one");
  d.number("least_share", least_share, "1", between(0, 1),
           "and by at least this share of the highest pressure anywhere");
  d.integer("ahead", ahead, at_least(1), "cells that particles fill around a front, towards the lower pressure");
  d.integer("behind", behind, at_least(0), "and towards the higher one");
  d.integer("around", around, at_least(1), "cells around solid bodies that particles fill");
  d.integer("hysteresis", hysteresis, at_least(0), "cells further out that keep the particles that they have");
  d.choice(
      "transfer", transfer,
      "fluxes: what particles find corrects the fluxes of the grid, and nothing is lost; interpolate: it replaces what "
      "cells hold, as in Myers et al. (2024), and mass, momentum and energy drift");
}

HybridSettings hybrid_settings(const Scene& scene) {
  const auto found = scene.sections.find("hybrid");
  return found == scene.sections.end() ? HybridSettings{} : dynamic_cast<const HybridSettings&>(*found->second);
}

}  // namespace ejecta
