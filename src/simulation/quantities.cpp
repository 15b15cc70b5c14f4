#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "simulation/simulation.hpp"

namespace ejecta {

Quantities quantities(const Simulation& sim) {
  // Plane strain counts per metre of depth.
  const bool flat = sim.scene.dimension == 2;
  const std::string energy = flat ? "J/m" : "J", momentum = flat ? "kg/s" : "kg m/s",
                    angular = flat ? "kg m/s" : "kg m^2/s", mass = flat ? "kg/m" : "kg";
  const Totals now = conserved(sim);
  const ConservationErrors errors = conservation_errors(initial(sim), now, external(sim));
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  Quantities list{{"time", "s", sim.clock.time, "simulated"},
                  {"step", "1", sim.clock.step, "number of steps so far"},
                  {"dt", "s", sim.clock.dt, "last step"},
                  {"limited by", "", std::string(sim.vote.reason), "whose vote won"},
                  {"kinetic energy", energy, now.kinetic, "of everything", true},
                  {"internal energy", energy, now.internal, "of everything", true},
                  {"total energy", energy, now.energy(), "kinetic and internal"}};
  auto loaded = [](const auto& package) { return package->is_loaded(); };
  if (std::ranges::any_of(sim.packages, loaded))
    list.push_back({"external work", energy, external(sim).work, "on driven bodies"});
  list.push_back({"energy error", "1", errors.energy,
                  "(total - initial total - external work) / the largest of initial total, initial kinetic, work",
                  true});
  for (int a = 0; a < sim.scene.dimension; ++a)
    list.push_back(
        {fmt::format("momentum {}", axes[static_cast<std::size_t>(a)]), momentum, now.momentum[a], "of everything"});
  if (kept(sim).angular_momentum) {
    for (int a = flat ? 2 : 0; a < 3; ++a)
      list.push_back({fmt::format("angular momentum {}", axes[static_cast<std::size_t>(a)]), angular,
                      now.angular_momentum[a], "about the origin"});
    list.push_back({"angular momentum error", "1", errors.angular_momentum,
                    "change less external torque over sum |x - x_c| |m v|", true});
  }
  list.push_back({"mass", mass, now.mass, "of everything"});
  for (const auto& package : sim.packages) {
    const Quantities own = package->quantities();
    list.insert(list.end(), own.begin(), own.end());
  }
  return list;
}

}  // namespace ejecta
