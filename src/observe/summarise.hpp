#pragma once
/// summary.json of a run that is over.
#include <filesystem>

#include "observe/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/summary.hpp"

namespace ejecta {

Summary summarise(const Simulation& sim, const Frames& frames, const FragmentContext& context,
                  const std::filesystem::path& folder, int exit_code);

}  // namespace ejecta
