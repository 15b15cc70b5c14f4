#include "render/figure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>

#include "base/errors.hpp"
#include "render/csv_table.hpp"
#include "render/display_unit.hpp"
#include "render/fragment_figures.hpp"
#include "render/gnuplot.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// Particles over the crush curve, as in section 7.1 of the note on the P-alpha model. Pressures below the left edge of
/// the logarithmic axis (released or in tension) are drawn on it.
std::optional<std::string> compaction(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "figures/compaction.csv") || !fs::exists(run / "figures/crush_curve.csv")) return {};
  return plot_preamble("compaction", settings.title, "pore compaction") +
         R"(stats 'figures/crush_curve.csv' using ($1 > 0 ? $1 : NaN) nooutput
left = STATS_min / 1e6 / 10
set logscale x
set xrange [left:*]
stats 'figures/crush_curve.csv' using 2 nooutput
set yrange [1 - 0.05 * (STATS_max - 1):1 + 1.08 * (STATS_max - 1)]
set format x '10^{%L}'
set xlabel sprintf('pressure [MPa]   (below %g MPa: on the left edge)', left)
set ylabel 'distension α'
mpa(p) = p / 1e6 > left ? p / 1e6 : left
set key top right
plot 'figures/compaction.csv' using ($3 == 0 ? mpa($1) : NaN):2 with points ls 1 ps 0.3 notitle, \
     '' using ($3 != 0 ? mpa($1) : NaN):2 with points ls 4 ps 0.3 notitle, \
     'figures/crush_curve.csv' using ($1 / 1e6):2 with lines lc rgb 'white' lw 5 notitle, \
     '' using ($1 / 1e6):2 with lines lc rgb '#d62728' lw 2 title 'crush curve', \
     keyentry with points ls 4 ps 1 title 'particles, loading', \
     keyentry with points ls 1 ps 1 title 'particles, released or untouched'
)";
}

std::optional<std::string> energy(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "history.csv")) return {};
  const CsvTable table = read_csv(run / "history.csv");
  const std::size_t kinetic = table.find("kinetic energy"), internal = table.find("internal energy"),
                    total = table.find("total energy"), error = table.find("energy error");
  for (const std::size_t column : {kinetic, internal, total, error})
    if (column == CsvTable::npos || table.rows.empty()) return {};
  return plot_preamble("energy", settings.title, "energy") + fmt::format(fmt::runtime(time_axis), "history.csv") +
         fmt::format(R"(stats 'history.csv' using {2} nooutput
largest = abs(STATS_max) > abs(STATS_min) ? abs(STATS_max) : abs(STATS_min)
e = factor(largest)
unit = prefix(largest)
set multiplot layout 2,1
set lmargin 11
set rmargin 4
unset xlabel
set size 1,0.66
set origin 0,0.34
set ylabel sprintf('energy [%s{4}]', unit)
set key bmargin center horizontal
plot 'history.csv' using ($1 / t):(${0} / e) with lines ls 2 title 'kinetic', '' using ($1 / t):(${1} / e) with lines ls 1 title 'internal', \
     '' using ($1 / t):(${2} / e) with lines lc rgb '#222222' lw 1.5 dt 2 title 'total'
unset title
set key off
set size 1,0.34
set origin 0,0
set xlabel sprintf('time [%ss]', prefix(t))
set ylabel 'relative error'
set format y '%g'
plot 'history.csv' using ($1 / t):{3} with lines ls 4
unset multiplot
)",
                     kinetic + 1, internal + 1, total + 1, error + 1, table.unit(total));
}

/// Density, velocity and pressure at the end, a panel each, along the line that the run is told by.
std::optional<std::string> profile(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "profile.csv")) return {};
  const CsvTable table = read_csv(run / "profile.csv");
  if (table.rows.size() < 2) return {};
  const auto name = [&](std::size_t k) { return table.columns[k].substr(0, table.columns[k].find(" [")); };
  std::string script = plot_preamble("profile", settings.title, "profile at the end") +
                       fmt::format(R"(stats 'profile.csv' using (abs($1)) nooutput
l = factor(STATS_max)
set multiplot layout {},1
set lmargin 12
set rmargin 4
set key off
)",
                                   table.columns.size() - 1);
  for (std::size_t k = 1; k < table.columns.size(); ++k) {
    const std::string unit = table.unit(k);
    const bool scaled = !unit.starts_with("k");  // it has a prefix already
    if (k > 1) script += "unset title\n";
    script += k + 1 < table.columns.size()
                  ? "set format x ''\nunset xlabel\n"
                  : fmt::format("set format x '%g'\nset xlabel sprintf('{} [%sm]', prefix(l))\n", name(0));
    script += fmt::format(R"(stats 'profile.csv' using (abs(${0})) nooutput
u = {1} && STATS_max > 0 ? factor(STATS_max) : 1
set ylabel {1} ? sprintf('{2} [%s{3}]', prefix(u)) : '{2} [{3}]'
plot 'profile.csv' using ($1 / l):(${0} / u) with lines ls 1
)",
                          k + 1, scaled ? 1 : 0, name(k), unit);
  }
  return script + "unset multiplot\n";
}

/// A panel for each column that people look at, all over the same time.
std::optional<std::string> probe(const fs::path& run, const FigureSettings& settings, const ProbeFigure& probe) {
  const std::string file = fmt::format("probe_{}.csv", probe.name),
                    measured = fmt::format("probe_{}_measured.csv", probe.name);
  if (!fs::exists(run / file)) return {};
  const CsvTable table = read_csv(run / file);
  const std::optional<CsvTable> points =
      fs::exists(run / measured) ? std::optional(read_csv(run / measured)) : std::nullopt;
  struct Panel {
    std::string name;
    std::size_t column;
  };
  std::vector<Panel> panels;
  for (const char* name : {"velocity", "pressure", "strain"})
    if (const std::size_t column = table.find(name); column != CsvTable::npos && !table.rows.empty())
      panels.push_back({name, column});
  if (panels.empty()) return {};
  std::string script = plot_preamble("probe_" + probe.name, settings.title, "probe " + probe.name) +
                       fmt::format(fmt::runtime(time_axis), file) +
                       fmt::format("set multiplot layout {},1\nset lmargin 12\nset rmargin 4\n", panels.size());
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::string unit = table.unit(panels[k].column);
    const std::size_t seen = points ? points->find(panels[k].name) : CsvTable::npos;
    if (k > 0) script += "unset title\n";
    script += k + 1 < panels.size() ? "set format x ''\nunset xlabel\n"
                                    : "set format x '%g'\nset xlabel sprintf('time [%ss]', prefix(t))\n";
    script += fmt::format(R"(set key {3}
stats '{0}' using (abs(${1})) nooutput
u = {4} && STATS_max > 0 ? factor(STATS_max) : 1
set ylabel {4} ? sprintf('{2} [%s{5}]', prefix(u)) : '{2}'
plot '{0}' using ($1 / t):(${1} / u) with lines ls 1 title 'computed')",
                          file, panels[k].column + 1, panels[k].name, seen == CsvTable::npos ? "off" : "bottom right",
                          unit == "1" ? 0 : 1, unit);
    if (seen != CsvTable::npos)
      script += fmt::format(
          ", '{}' using (($1 + {:.9g}) / t):(${} / u) with points lc rgb '#222222' pt 6 ps 0.7 title 'measured'",
          measured, probe.measured_delay, seen + 1);
    script += '\n';
  }
  return script + "unset multiplot\n";
}

}  // namespace

std::vector<Figure> make_figures(const fs::path& run_folder, const FigureSettings& settings) {
  using Script = std::optional<std::string>;
  struct Plot {
    std::string name;
    std::function<Script()> script;
  };
  std::vector<Plot> plots{{"compaction", [&] { return compaction(run_folder, settings); }},
                          {"fragment_distribution", [&] { return fragment_distribution(run_folder, settings); }},
                          {"fragment_histogram", [&] { return fragment_histogram(run_folder, settings); }},
                          {"largest_fragment", [&] { return largest_fragment(run_folder, settings); }},
                          {"energy", [&] { return energy(run_folder, settings); }},
                          {"profile", [&] { return profile(run_folder, settings); }}};
  for (const ProbeFigure& p : settings.probes)
    plots.push_back({"probe_" + p.name, [&] { return probe(run_folder, settings, p); }});
  std::vector<Figure> figures;
  for (const Plot& plot : plots) {
    Figure figure{run_folder / "figures" / (plot.name + ".png"), ""};
    try {
      const Script script = plot.script();
      if (!script) continue;
      figure.problem = draw_plot(run_folder, plot.name, *script);
    } catch (const InputError& error) {
      figure.problem = error.what();
    }
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace ejecta
