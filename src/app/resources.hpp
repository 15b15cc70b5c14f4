#pragma once
/// What a scene costs and what a run has used.
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/timers.hpp"
#include "material/material.hpp"
#include "scene/scene.hpp"

namespace ejecta {

bool is_writable(const std::filesystem::path& folder);

/// Expected costs of a scene, before any particle is made.
struct Estimate {
  double particles = 0, bytes_per_particle = 0, steps = 0, seconds = 0;
};
Estimate estimate(const Scene& scene, const std::vector<Material>& materials);
/// Throws InputError if the scene needs more memory than the machine has free.
void check_memory(const Scene& scene, const std::vector<Material>& materials);

/// Wall times as a table: seconds, share, calls.
std::string timer_table(std::span<const StageTimers::Entry> times);

}  // namespace ejecta
