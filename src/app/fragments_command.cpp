#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "base/errors.hpp"
#include "output/csv.hpp"
#include "render/csv_table.hpp"
#include "render/fragment_figures.hpp"
#include "render/gnuplot.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// Pieces of the target of one run.
struct RunPieces {
  std::string folder, unit;    ///< unit of shares: "mass of tube"
  std::vector<double> shares;  ///< of the target's mass, heaviest first
  double dust = 0;             ///< share
  double whole = 0;            ///< mass of the target
  std::string mass_unit;

  std::size_t at_least(double share) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(shares, share, std::greater<>()) - shares.begin());
  }
};

double number(const std::string& cell) {
  double value = 0;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

RunPieces read_pieces(const fs::path& folder) {
  const fs::path file = folder / "fragments.csv", distribution = folder / "fragment_distribution.csv";
  if (!fs::exists(file) || !fs::exists(distribution))
    throw InputError(
        fmt::format("{}: expected the folder of a run with fragments.enabled = true that has ended", folder.string()));
  const CsvTable table = read_csv(file), cumulative = read_csv(distribution);
  const std::size_t share = table.find("mass fraction");
  if (share == CsvTable::npos || table.rows.empty() || cumulative.rows.empty())
    throw InputError(fmt::format("{}: expected at least one fragment, got none", file.string()));
  RunPieces pieces{folder.string(),
                   table.unit(share),
                   {},
                   number(table.rows.back()[share]),
                   number(cumulative.rows[0][0]) / number(cumulative.rows[0][1]),
                   cumulative.unit(0)};
  for (std::size_t k = 0; k + 1 < table.rows.size(); ++k)  // the last row is dust
    if (const double value = number(table.rows[k][share]); value > 0) pieces.shares.push_back(value);
  std::ranges::sort(pieces.shares, std::greater<>());
  return pieces;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : std::midpoint(values[half - 1], values[half]);
}

/// Fewest, median and most pieces of at least a mass, from the lightest piece to the heaviest.
void write_band(const fs::path& file, const std::vector<RunPieces>& runs) {
  double lightest = 1, heaviest = 0;
  for (const RunPieces& run : runs) {
    lightest = std::min(lightest, run.shares.back());
    heaviest = std::max(heaviest, run.shares.front());
  }
  constexpr int samples = 400;
  std::vector<std::vector<CsvCell>> rows;
  for (int k = 0; k <= samples; ++k) {
    const double share =
        k < samples ? lightest * std::pow(heaviest / lightest, static_cast<double>(k) / samples) : heaviest;
    std::vector<double> counts;
    for (const RunPieces& run : runs) counts.push_back(static_cast<double>(run.at_least(share)));
    rows.push_back({share * runs[0].whole, share, std::ranges::min(counts), std::ranges::max(counts), median(counts)});
  }
  write_csv(file,
            std::vector<CsvColumn>{{"mass", runs[0].mass_unit},
                                   {"mass fraction", runs[0].unit},
                                   {"fewest fragments at least as heavy", "1"},
                                   {"most fragments at least as heavy", "1"},
                                   {"median of fragments at least as heavy", "1"}},
            rows);
}

}  // namespace

int fragments_command(const std::vector<std::string>& folders, const std::string& out) {
  std::vector<RunPieces> runs;
  std::vector<std::string> problems;
  for (const std::string& folder : folders) try {
      runs.push_back(read_pieces(folder));
      if (runs.back().unit != runs.front().unit)
        problems.push_back(fmt::format("{}: expected shares of the {} as in {}, got those of the {}", folder,
                                       runs.front().unit, runs.front().folder, runs.back().unit));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  if (!problems.empty()) throw InputError(problems);

  fmt::print("{:<32} {:>6} {:>11} {:>10} {:>8}\n", "run", "pieces", "largest [%]", "median [%]", "dust [%]");
  for (const RunPieces& run : runs)
    fmt::print("{:<32} {:>6} {:>11.2f} {:>10.2f} {:>8.1f}\n", run.folder, run.shares.size(), 100 * run.shares.front(),
               100 * median(run.shares), 100 * run.dust);

  const fs::path folder = out;
  fs::create_directories(folder);
  write_band(folder / "fragment_runs.csv", runs);
  for (const char* beside : {"fragment_theory.csv", "fragments_measured.csv"})
    for (const RunPieces& run : runs)
      if (const fs::path file = fs::path(run.folder) / beside; fs::exists(file)) {
        fs::copy_file(file, folder / beside, fs::copy_options::overwrite_existing);
        break;
      }
  FigureSettings settings;
  settings.title = fmt::format("{} runs", runs.size());
  settings.fragment_target = runs[0].unit.starts_with("mass of ") ? runs[0].unit.substr(8) : runs[0].unit;
  if (const auto script = fragment_runs(folder, settings))
    if (const std::string problem = draw_plot(folder, "fragment_runs", *script); !problem.empty()) {
      fmt::print(stderr, "ejecta: fragment_runs.png: {}\n", problem);
      return exit_code::failed;
    }
  fmt::print("{} has the band of these runs\n", (folder / "figures/fragment_runs.png").string());
  return exit_code::done;
}

}  // namespace ejecta
