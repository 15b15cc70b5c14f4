#pragma once
/// Scripts of the plots of fragment masses; see figure.hpp.
#include <filesystem>
#include <optional>
#include <string>

#include "render/figure.hpp"

namespace ejecta {

/// How many fragments there are of at least a mass: those of fragment_distribution.csv, or of several runs, the band of
/// fragment_runs.csv; beside them what was caught (fragments_measured.csv) and what theories expect
/// (fragment_theory.csv). Nothing without the first.
std::optional<std::string> fragment_distribution(const std::filesystem::path& run, const FigureSettings& settings);
std::optional<std::string> fragment_runs(const std::filesystem::path& folder, const FigureSettings& settings);

/// Mass in fragments by their mass, half a decade a bar (fragments.csv, fragments_measured.csv).
std::optional<std::string> fragment_histogram(const std::filesystem::path& run, const FigureSettings& settings);

/// The largest fragment, the dust and the number of fragments against time (largest_fragment.csv).
std::optional<std::string> largest_fragment(const std::filesystem::path& run, const FigureSettings& settings);

}  // namespace ejecta
