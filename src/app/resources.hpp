#pragma once
/// What a scene costs and what a run has used.
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/timers.hpp"
#include "model/package_kind.hpp"

namespace ejecta {

bool is_writable(const std::filesystem::path& folder);

/// Expected costs of what takes part in a scene, before any of it is made.
std::vector<Estimate> estimates(const Scene& scene, const std::vector<Material>& materials);
/// Throws InputError if the scene needs more memory than the machine has free.
void check_memory(const Scene& scene, const std::vector<Material>& materials);

/// Wall times as a table: seconds, share, calls.
std::string timer_table(std::span<const StageTimers::Entry> times);

}  // namespace ejecta
