#pragma once
/// What all plots by gnuplot have in common.
#include <filesystem>
#include <string>

namespace ejecta {

/// Text within double quotes of gnuplot, its markup switched off where used.
std::string quoted(const std::string& text);

/// The beginning of every script: picture figures/<name>.png, title, styles, and factor(m) and prefix(m), which give
/// the SI prefix that suits m.
std::string plot_preamble(const std::string& name, const std::string& title, const std::string& subject);

/// Time in column 1, shown with a prefix that suits the last row.
inline constexpr const char* time_axis = R"(stats '{0}' using 1 nooutput
t = factor(STATS_max)
set xlabel sprintf('time [%ss]', prefix(STATS_max))
set xrange [0:(STATS_max > 0 ? STATS_max / t : 1)]
)";

/// Leaves figures/<name>.gp in the folder, where its data are, and lets gnuplot draw it. Returns what went wrong in one
/// sentence, or nothing.
std::string draw_plot(const std::filesystem::path& folder, const std::string& name, const std::string& script);

}  // namespace ejecta
