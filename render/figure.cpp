#include "render/figure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <optional>

#include "base/errors.hpp"
#include "base/si_prefixes.hpp"
#include "render/csv_table.hpp"
#include "render/display_unit.hpp"
#include "render/process.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// Text within double quotes of gnuplot, its markup switched off where used.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return '"' + safe + '"';
}

/// What `text` makes of the prefix that suits m, as an expression of gnuplot.
template <class Text>
std::string by_size(Text text) {
  std::string choice = text(si_prefixes.back());
  for (std::size_t k = si_prefixes.size() - 1; k-- > 0;)
    choice = fmt::format("m >= {:e} ? {} : {}", si_prefixes[k].factor(), text(si_prefixes[k]), choice);
  return choice;
}

std::string preamble(const std::string& name, const std::string& title, const std::string& subject) {
  return fmt::format(R"(set encoding utf8
set terminal pngcairo size 1120,760 font 'DejaVu Sans,13' enhanced background rgb 'white'
set output 'figures/{}.png'
set datafile separator ','
set datafile columnheaders
set title {} noenhanced font ',15' offset 0,0.3
set border 3 lc rgb '#444444'
set tics nomirror out scale 0.6
set grid lc rgb '#e4e4e8' lt 1
set key reverse Left spacing 1.3 samplen 2 noenhanced
set style line 1 lc rgb '#2c728e' lw 2.2 pt 7 ps 0.35
set style line 2 lc rgb '#e45a31' lw 2.2 pt 7 ps 0.35
set style line 3 lc rgb '#5ec962' lw 2.2 pt 7 ps 0.35
set style line 4 lc rgb '#8a226a' lw 2.2 pt 7 ps 0.35
factor(m) = {}
prefix(m) = {}
)",
                     name, quoted(title.empty() ? subject : title + ": " + subject),
                     by_size([](const SiPrefix& p) { return fmt::format("{:e}", p.factor()); }),
                     by_size([](const SiPrefix& p) { return fmt::format("'{}'", p.symbol); }));
}

/// Time in column 1, shown with a prefix that suits the last row.
constexpr const char* time_axis = R"(stats '{0}' using 1 nooutput
t = factor(STATS_max)
set xlabel sprintf('time [%ss]', prefix(STATS_max))
set xrange [0:(STATS_max > 0 ? STATS_max / t : 1)]
)";

/// Particles over the crush curve, as in section 7.1 of the note on the P-alpha model. Pressures below the left edge of
/// the logarithmic axis (released or in tension) are drawn on it.
std::optional<std::string> compaction(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "figures/compaction.csv") || !fs::exists(run / "figures/crush_curve.csv")) return {};
  return preamble("compaction", settings.title, "pore compaction") +
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

std::optional<std::string> fragment_distribution(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "fragment_distribution.csv") || read_csv(run / "fragment_distribution.csv").rows.empty())
    return {};
  const bool measured = fs::exists(run / "fragments_measured.csv");
  std::string script = preamble("fragment_distribution", settings.title, "cumulative fragment mass distribution");
  script += "set xlabel " +
            quoted("mass m of " + settings.fragment_target + " in a fragment / mass of " + settings.fragment_target) +
            " noenhanced\n";
  if (measured) script += "stats 'fragment_distribution.csv' using ($1 / $2) nooutput\nwhole = STATS_mean\n";
  script += R"(set logscale xy
set format x '10^{%L}'
set format y '10^{%L}'
set ylabel 'number of fragments ≥ m'
stats 'fragment_distribution.csv' using 2 nooutput
low = 10**floor(log10(STATS_min) - 0.3)
high = 10**ceil(log10(STATS_max))
)";
  if (std::isfinite(settings.resolution_limit))
    script += fmt::format(R"(stats 'fragment_distribution.csv' using ($2 / $1) nooutput
limit = {:.9g} * STATS_mean
low = limit < low ? 10**floor(log10(limit) - 0.3) : low
set arrow from limit, graph 0 to limit, graph 1 nohead dt 3 lw 1.5 lc rgb '#777777'
set label 'resolution limit' at limit, graph 0.03 rotate by 90 offset 0.9,0 textcolor rgb '#777777' font ',11'
)",
                          settings.resolution_limit);
  return script + R"(set xrange [low:high]
set yrange [0.8:10<*]
)" + (measured ? "set key top right\n" : "set key off\n") +
         R"(plot 'fragment_distribution.csv' using 2:3 with steps ls 1 title 'computed', '' using 2:3 with points ls 1 ps 0.9 notitle)" +
         (measured
              ? R"(, 'fragments_measured.csv' using ($1 / whole):2 with steps ls 2 title 'caught', '' using ($1 / whole):2 with points ls 2 ps 0.9 notitle)"
              : "") +
         "\n";
}

/// Mass in fragments by their mass, half a decade a bar.
std::optional<std::string> fragment_histogram(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "fragments.csv")) return {};
  const CsvTable table = read_csv(run / "fragments.csv");
  const std::size_t share = table.find("mass fraction");
  if (share == CsvTable::npos || table.rows.size() < 2) return {};  // the last row is dust
  const std::string& dust = table.rows.back()[share];
  const bool measured =
      fs::exists(run / "fragments_measured.csv") && !read_csv(run / "fragment_distribution.csv").rows.empty();
  std::string script = preamble("fragment_histogram", settings.title, "mass in fragments by their mass");
  script += "set xlabel " +
            quoted("mass of " + settings.fragment_target + " in a fragment / mass of " + settings.fragment_target) +
            " noenhanced\nset ylabel " + quoted("share of the mass of " + settings.fragment_target + " [%]") +
            " noenhanced\n";
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
  return preamble("largest_fragment", settings.title, "largest fragment of " + settings.fragment_target) +
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

std::optional<std::string> energy(const fs::path& run, const FigureSettings& settings) {
  if (!fs::exists(run / "history.csv")) return {};
  const CsvTable table = read_csv(run / "history.csv");
  const std::size_t kinetic = table.find("kinetic energy"), internal = table.find("internal energy"),
                    total = table.find("total energy"), error = table.find("energy error");
  for (const std::size_t column : {kinetic, internal, total, error})
    if (column == CsvTable::npos || table.rows.empty()) return {};
  return preamble("energy", settings.title, "energy") + fmt::format(fmt::runtime(time_axis), "history.csv") +
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
  std::string script = preamble("probe_" + probe.name, settings.title, "probe " + probe.name) +
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
                          {"energy", [&] { return energy(run_folder, settings); }}};
  for (const ProbeFigure& p : settings.probes)
    plots.push_back({"probe_" + p.name, [&] { return probe(run_folder, settings, p); }});
  std::vector<Figure> figures;
  for (const Plot& plot : plots) {
    Figure figure{run_folder / "figures" / (plot.name + ".png"), ""};
    try {
      const Script script = plot.script();
      if (!script) continue;
      std::error_code failed;
      fs::create_directories(run_folder / "figures", failed);
      const std::string script_name = "figures/" + plot.name + ".gp";
      std::ofstream(run_folder / script_name) << *script;
      figure.problem = run_program({"gnuplot", script_name}, run_folder);
    } catch (const InputError& error) {
      figure.problem = error.what();
    }
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace ejecta
