#pragma once
/// What a scene costs and what a run has used.
#include <cstdint>
#include <filesystem>
#include <string>

#include "sph/sph.hpp"

namespace ejecta {

bool is_writable(const std::filesystem::path& folder);
/// Bytes of all files in a folder; 0 if there is none.
std::int64_t folder_bytes(const std::filesystem::path& folder);

/// Expected costs of a scene, before any particle is made.
struct Estimate {
  double particles = 0, bytes_per_particle = 0, steps = 0, seconds = 0;
};
Estimate estimate(const Scene& scene, const std::vector<Material>& materials);
/// Throws InputError if the scene needs more memory than the machine has free.
void check_memory(const Scene& scene, const std::vector<Material>& materials);

/// Memory of columns, lists and records [bytes].
template <int Dim>
std::size_t memory_bytes(const Sph<Dim>& sim);
/// Mean number of neighbours within the support, from the effective n_h of each particle.
template <int Dim>
double mean_neighbours(const Sph<Dim>& sim);

/// The stage timers as a table: seconds, share, calls.
std::string timer_table(const StageTimers& timers);

}  // namespace ejecta
