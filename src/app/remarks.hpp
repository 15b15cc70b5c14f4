#pragma once
#include <filesystem>
#include <vector>

#include "model/package.hpp"

namespace ejecta {

struct Job;
struct Scene;
struct Simulation;

/// What a scene asks for and does not get, or not well, to be said before the run: times after its end, more threads
/// than cores, matter beyond faces, a charge of a few cells. `sim` is as it has been set up or restored.
std::vector<Remark> remarks_on(const Job& job, const Simulation& sim);

/// Says how far each probe of a run is from what was measured.
void say_misfits(const Scene& scene, const std::filesystem::path& folder);

}  // namespace ejecta
