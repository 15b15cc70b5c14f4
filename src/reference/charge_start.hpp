#pragma once
/// The first moments of a blast, before its charge is wide enough for the cells or particles of a run: nothing has met
/// the wave yet, so that they are solved in one dimension and laid on them.
#include <optional>
#include <vector>

#include "material/matter_at.hpp"

namespace ejecta {

/// The state at charge.start [s]; without that key, when the shock has come 16 spacings, but no later than the first of
/// output.times and a tenth of the run. Nothing if it begins with the charge itself: that is asked for (charge.start =
/// 0), the charge is as wide as that, something stands or moves so near that there is no room, or the charge is of
/// another matter than the gas. Throws InputError where charge.start asks for what cannot be.
std::optional<RadialState> charge_start(const Scene& scene, const std::vector<Material>& materials);

/// The same scene, whose charge reaches as far as its matter has come by then.
Scene with_charge_of(const RadialState& start, Scene scene);

}  // namespace ejecta
