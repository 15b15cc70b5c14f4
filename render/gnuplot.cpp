#include "render/gnuplot.hpp"

#include <fmt/format.h>

#include <fstream>

#include "base/si_prefixes.hpp"
#include "render/process.hpp"

namespace ejecta {

namespace {

/// What `text` makes of the prefix that suits m, as an expression of gnuplot.
template <class Text>
std::string by_size(Text text) {
  std::string choice = text(si_prefixes.back());
  for (std::size_t k = si_prefixes.size() - 1; k-- > 0;)
    choice = fmt::format("m >= {:e} ? {} : {}", si_prefixes[k].factor(), text(si_prefixes[k]), choice);
  return choice;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return '"' + safe + '"';
}

std::string plot_preamble(const std::string& name, const std::string& title, const std::string& subject) {
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

std::string draw_plot(const std::filesystem::path& folder, const std::string& name, const std::string& script) {
  std::error_code failed;
  std::filesystem::create_directories(folder / "figures", failed);
  const std::string file = "figures/" + name + ".gp";
  std::ofstream(folder / file) << script;
  return run_program({"gnuplot", file}, folder);
}

}  // namespace ejecta
