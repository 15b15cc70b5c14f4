#include "render/fragment_figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "render/csv_table.hpp"
#include "render/gnuplot.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

bool has_rows(const fs::path& file) { return fs::exists(file) && !read_csv(file).rows.empty(); }

std::string mass_axis(const FigureSettings& settings, const std::string& beginning) {
  return "set xlabel " +
         quoted(fmt::format("{} of {} in a fragment / mass of {}", beginning, settings.fragment_target,
                            settings.fragment_target)) +
         " noenhanced\n";
}

/// Axes for how many fragments there are of at least a mass, of which column 2 of a file has the shares.
std::string axes_of_distribution(const std::string& file, const FigureSettings& settings) {
  std::string script = mass_axis(settings, "mass m") + fmt::format(R"(stats '{0}' using ($1 / $2) nooutput
whole = STATS_mean
set logscale xy
set format x '10^{{%L}}'
set format y '10^{{%L}}'
set ylabel 'number of fragments ≥ m'
stats '{0}' using 2 nooutput
low = 10**floor(log10(STATS_min) - 0.3)
high = 10**ceil(log10(STATS_max))
)",
                                                                   file);
  if (std::isfinite(settings.resolution_limit))
    script += fmt::format(R"(limit = {:.9g} / whole
low = limit < low ? 10**floor(log10(limit) - 0.3) : low
set arrow from limit, graph 0 to limit, graph 1 nohead dt 3 lw 1.5 lc rgb '#777777'
set label 'resolution limit' at limit, graph 0.03 rotate by 90 offset 0.9,0 textcolor rgb '#777777' font ',11'
)",
                          settings.resolution_limit);
  return script + "set xrange [low:high]\nset yrange [0.8:10<*]\nset key top right\n";
}

/// A curve under another one, as a plot command takes it. Below what the axis shows nothing has a logarithm.
std::string band(const std::string& file, std::size_t lower, const char* colour, const std::string& title) {
  return fmt::format(
      "'{}' using 2:(${} > 0.1 ? ${} : 0.1):(${} > 0.1 ? ${} : 0.1) with filledcurves lc rgb '{}' fs transparent "
      "solid 0.22 noborder title {}",
      file, lower, lower, lower + 1, lower + 1, colour, quoted(title));
}

/// Bands of the theories, each two columns of fragment_theory.csv: "Mott, fewest" and "Mott, most".
std::string bands_of_theories(const fs::path& folder) {
  std::string script;
  if (!has_rows(folder / "fragment_theory.csv")) return script;
  const CsvTable table = read_csv(folder / "fragment_theory.csv");
  constexpr const char* colours[] = {"#8a226a", "#5ec962"};
  for (std::size_t k = 2; k + 1 < table.columns.size(); k += 2)
    script += band("fragment_theory.csv", k + 1, colours[(k / 2 - 1) % 2],
                   table.columns[k].substr(0, table.columns[k].find(','))) +
              ", ";
  return script;
}

/// A curve of steps with its points.
std::string steps(const std::string& file, const std::string& columns, int style, const char* title) {
  return fmt::format("'{0}' using {1} with steps ls {2} title '{3}', '' using {1} with points ls {2} ps 0.9 notitle",
                     file, columns, style, title);
}

/// What was caught, in units of the whole.
std::string caught(const fs::path& folder) {
  return fs::exists(folder / "fragments_measured.csv")
             ? ", " + steps("fragments_measured.csv", "($1 / whole):2", 2, "caught")
             : "";
}

}  // namespace

std::optional<std::string> fragment_distribution(const fs::path& run, const FigureSettings& settings) {
  const std::string file = "fragment_distribution.csv";
  if (!has_rows(run / file)) return {};
  return plot_preamble("fragment_distribution", settings.title, "cumulative fragment mass distribution") +
         axes_of_distribution(file, settings) + "plot " + bands_of_theories(run) + steps(file, "2:3", 1, "computed") +
         caught(run) + "\n";
}

std::optional<std::string> fragment_runs(const fs::path& folder, const FigureSettings& settings) {
  const std::string file = "fragment_runs.csv";
  if (!has_rows(folder / file)) return {};
  return plot_preamble("fragment_runs", settings.title, "cumulative fragment mass distribution") +
         axes_of_distribution(file, settings) + "plot " + bands_of_theories(folder) +
         band(file, 3, "#2c728e", "computed, all runs") +
         fmt::format(", '{}' using 2:($5 > 0.1 ? $5 : 0.1) with lines ls 1 title 'computed, median'", file) +
         caught(folder) + "\n";
}

std::optional<std::string> fragment_histogram(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "fragments.csv") || !has_rows(run / "fragment_distribution.csv")) return {};
  const CsvTable table = read_csv(run / "fragments.csv");
  const std::size_t share = table.find("mass fraction");
  if (share == CsvTable::npos) return {};
  const std::string& dust = table.rows.back()[share];  // in the last row
  const bool measured = fs::exists(run / "fragments_measured.csv");
  std::string script = plot_preamble("fragment_histogram", settings.title, "mass in fragments by their mass");
  script += mass_axis(settings, "mass") + "set ylabel " +
            quoted("share of the mass of " + settings.fragment_target + " [%]") + " noenhanced\n";
  if (measured) script += "stats 'fragment_distribution.csv' using ($1 / $2) nooutput\nwhole = STATS_mean\n";
  // Bars are counted before the axis is logarithmic, by the number of their half decade.
  const std::string columns = fmt::format("(half_decade(${0})):(100 * ${0})", share + 1);
  script += fmt::format(R"(half_decade(m) = m > 0 ? floor(2 * log10(m)) : NaN
edge(k) = 10.0**(0.5 * k)
set table $computed
plot 'fragments.csv' every ::0::{} using {} smooth frequency
unset table
)",
                        table.rows.size() - 2, columns);
  if (measured)
    script += R"(set table $caught
plot 'fragments_measured.csv' using (half_decade($1 / whole)):(100 * $1 / whole) smooth frequency
unset table
)";
  script += fmt::format(R"(unset datafile
set label 1 sprintf('dust: %.3g %%', 100 * {0}) at graph 0.02, graph 0.95
set logscale x
set format x '10^{{%L}}'
set yrange [0:*]
set style fill solid 0.5
set key bmargin center horizontal
plot $computed using (edge($1 + 0.5)):2:(edge($1)):(edge($1 + 1)):(0):2 with boxxyerror ls 1 title 'computed')",
                        dust.empty() ? "0" : dust);
  if (measured)
    script +=
        ", $caught using (edge($1 + 0.5)):2:(edge($1 + 0.2)):(edge($1 + 0.8)):(0):2 with boxxyerror ls 2 title "
        "'caught'";
  return script + "\n";
}

std::optional<std::string> largest_fragment(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "largest_fragment.csv") || read_csv(run / "largest_fragment.csv").rows.empty()) return {};
  return plot_preamble("largest_fragment", settings.title, "largest fragment of " + settings.fragment_target) +
         fmt::format(fmt::runtime(time_axis), "largest_fragment.csv") + "set ylabel " +
         quoted("mass / mass of " + settings.fragment_target + " [%]") + R"( noenhanced
set yrange [0:*]
set y2label 'number of fragments of all bodies'
set y2range [0:*]
set y2tics nomirror
set border 11
set key bmargin center horizontal
plot 'largest_fragment.csv' using ($1 / t):($2 * 100) with steps ls 1 title 'largest fragment', \
     '' using ($1 / t):($4 * 100) with steps ls 2 title 'dust', \
     '' using ($1 / t):3 axes x1y2 with steps ls 4 dt 2 title 'fragments (right)'
)";
}

}  // namespace ejecta
