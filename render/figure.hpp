#pragma once
/// Plots at the end of a run, by gnuplot from the CSV files the run has left. Script and picture end up side by side in
/// figures/; `gnuplot figures/<name>.gp` in the run folder draws a picture again.
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace ejecta {

struct ProbeFigure {
  std::string name;           ///< of the probe
  double measured_delay = 0;  ///< s; added to the times of probe_<name>_measured.csv, if there is one
};

struct FigureSettings {
  std::string title;            ///< over every plot
  std::string fragment_target;  ///< body that fragment masses refer to
  std::vector<ProbeFigure> probes;
  double resolution_limit = std::numeric_limits<double>::quiet_NaN();  ///< smallest mass counted as a fragment [kg]
};

/// Outcome of one plot: `problem` is empty if it was drawn, else one sentence.
struct Figure {
  std::filesystem::path file;
  std::string problem;
};

/// Draws what there is data for: figures/compaction.png (from figures/compaction.csv and figures/crush_curve.csv),
/// those of fragments (fragment_figures.hpp), energy.png (from history.csv), probe_<name>.png (from probe_<name>.csv:
/// velocity, pressure and strain, as far as they are there, and what was measured of them). Plots without data are left
/// out; without gnuplot each says so.
std::vector<Figure> make_figures(const std::filesystem::path& run_folder, const FigureSettings& settings);

}  // namespace ejecta
