#pragma once
/// summary.json of a run that is over.
#include <filesystem>

#include "observe/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/summary.hpp"

namespace ejecta {

template <int Dim>
Summary summarise(const Simulation& sim, const Sph<Dim>& sph, const FrameResults& frames,
                  const FragmentContext& context, const std::filesystem::path& folder, int exit_code);

}  // namespace ejecta
