#include "app/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "app/resources.hpp"
#include "app/run_lock.hpp"
#include "base/errors.hpp"
#include "observe/schedule.hpp"
#include "output/checkpoint.hpp"
#include "output/monitor.hpp"
#include "render/csv_table.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// What a run writes, folder by folder; "#" stands for a number (of a step), "*" for any text.
struct Written {
  std::string folder;  ///< empty: the run folder itself
  std::vector<std::string> names;
};
const std::array written{
    Written{"monitor", {"index.html", "status.json", "status.js"}},
    Written{"checkpoints", {"checkpoint_#.h5", "checkpoint_#.h5.aside", "failed_#.h5"}},
    Written{"snapshots", {"snapshot_#.h5"}},
    Written{"lineouts", {"lineout_#.csv"}},
    Written{"images", {"data.csv", "*_#.png", ".room"}},
    Written{"figures",
            {"compaction.*", "crush_curve.csv", "fragment_distribution.*", "fragment_histogram.*", "largest_fragment.*",
             "energy.*", "profile.*"}},
    Written{"",
            {"resolved.toml", "run.log", "insitu.log", "history.csv", "timers.csv", "fragments.csv", "shock.csv",
             "profile.csv", "fragment_distribution.csv", "fragments_measured.csv", "fragment_theory.csv",
             "largest_fragment.csv", "summary.json", "movie_*.mp4", "montage.mp4", "title.png"}}};
/// Appended to the name of a table that a restart with other columns has put aside.
const std::array<std::string, 2> aside{".aside", ".aside#"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] == '*') return matches(pattern.substr(1), name) || (!name.empty() && matches(pattern, name.substr(1)));
  if (pattern[0] == '#')
    return !name.empty() && is_digit(name[0]) &&
           (matches(pattern.substr(1), name.substr(1)) || matches(pattern, name.substr(1)));
  return !name.empty() && name[0] == pattern[0] && matches(pattern.substr(1), name.substr(1));
}

bool is_written(const Written& place, std::string name) {
  if (name.ends_with(".part")) name.resize(name.size() - 5);  // left behind where a run was killed
  return std::ranges::any_of(place.names, [&](const std::string& pattern) {
    return matches(pattern, name) ||
           (pattern.ends_with(".csv") &&
            std::ranges::any_of(aside, [&](const std::string& end) { return matches(pattern + end, name); }));
  });
}

/// True if `folder` is the other one or lies around it.
bool holds(const fs::path& folder, const fs::path& other) {
  const fs::path outer = fs::weakly_canonical(folder), inner = fs::weakly_canonical(other);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// What pipelines have written under names of their own: images/data.csv lists it.
std::vector<fs::path> extracts_of(const fs::path& images) {
  std::vector<fs::path> files;
  if (!fs::is_regular_file(images / "data.csv")) return files;
  const CsvTable table = read_csv(images / "data.csv");
  const std::size_t name = table.find("FILE");
  if (name == CsvTable::npos) return files;
  for (const std::vector<std::string>& row : table.rows)
    if (holds(images, images / row[name])) files.push_back(images / row[name]);
  return files;
}

/// Tables and figures of the probes that the run had: a user may have files of such names too.
std::vector<fs::path> files_of_probes(const fs::path& folder) try {
  std::vector<fs::path> files;
  if (!fs::is_regular_file(folder / "resolved.toml")) return files;
  const Document scene = read_document((folder / "resolved.toml").string());
  for (std::size_t k = 0; k < scene.count("probes"); ++k) {
    const auto item = scene.items.find(element_path("probes", k) + ".name");
    const auto* name = item == scene.items.end() ? nullptr : std::get_if<std::string>(&item->second.literal.value);
    if (!name || name->find('/') != std::string::npos) continue;
    for (const char* pattern :
         {"probe_{}.csv", "probe_{}.csv.aside", "probe_{}_measured.csv", "figures/probe_{}.png", "figures/probe_{}.gp"})
      files.push_back(folder / fmt::format(fmt::runtime(pattern), *name));
  }
  return files;
} catch (const InputError&) {  // somebody has edited it: those files stay
  return {};
}

bool holds_a_run(const fs::path& folder) {
  return fs::is_regular_file(folder / "resolved.toml") &&
         (fs::is_regular_file(folder / "run.log") || fs::is_regular_file(folder / "monitor/status.json") ||
          fs::is_directory(folder / "checkpoints"));
}

/// What a folder is that no run may replace.
std::optional<std::string> why_precious(const RunOptions& options, const fs::path& folder) {
  const char* home = std::getenv("HOME");
  const fs::path scene = fs::absolute(options.scene_file);  // perhaps a link to a file elsewhere
  if (holds(folder, scene.parent_path()) || holds(folder, fs::weakly_canonical(scene).parent_path()))
    return "that of the scene file";
  if (holds(folder, fs::current_path())) return "the working directory";
  if (home && *home && holds(folder, home)) return "the home directory";
  return std::nullopt;
}

/// The nearest existing parent must let us in.
void check_writable(const fs::path& folder) {
  fs::path parent = fs::absolute(folder);
  while (!fs::exists(parent)) parent = parent.parent_path();
  if (!is_writable(parent)) throw InputError(parent.string() + ": expected a folder to write to, got no permission");
}

const Written written_by_reference{"", {"profile.csv", "shock.csv"}};

}  // namespace

void check_run_folder(const RunOptions& options, const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder for the run, got a file");
  if (const auto other = run_in(folder))
    throw InputError(folder.string() + ": expected a folder that no run is using, got that of " + *other);
  const bool filled = fs::exists(folder) && std::ranges::any_of(fs::directory_iterator(folder), [](const auto& entry) {
                        return entry.path().filename() != "run.lock";  // of a run that was killed before it began
                      });
  if (options.restart) {
    if (!options.from.empty()) {
      if (!fs::is_regular_file(options.from))
        throw InputError("--from: expected a checkpoint, found no file " + options.from);
    } else if (!latest_checkpoint(folder / "checkpoints"))
      throw InputError(folder.string() + ": expected a checkpoint to restart from, found none");
  } else if (options.overwrite) {
    if (const auto reason = why_precious(options, folder))
      throw InputError(folder.string() + ": --overwrite: expected a folder of its own for the run, got " + *reason +
                       " or one around it");
    if (filled && !holds_a_run(folder))
      throw InputError(
          folder.string() +
          ": --overwrite: expected an empty folder or an earlier run, got a folder with other files in it");
  } else if (filled) {
    throw InputError(folder.string() +
                     ": expected a new folder, got one with files in it; use --out DIR for another, "
                     "--restart to go on from its last checkpoint, or --overwrite to replace an earlier run");
  }
  check_writable(folder);
}

void clear_run_folder(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  for (const fs::path& file : files_of_probes(folder)) fs::remove(file);
  for (const Written& place : written) {
    const fs::path inside = folder / place.folder;
    if (!fs::is_directory(inside)) continue;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(inside))
      if (!fs::is_directory(entry.symlink_status()) && is_written(place, entry.path().filename().string()))
        files.push_back(entry.path());
    if (place.folder == "images")
      for (const fs::path& file : extracts_of(inside)) files.push_back(file);
    for (const fs::path& file : files) fs::remove(file);
    std::vector<fs::path> emptied;  // that extracts have lain in
    for (const fs::path& file : files)
      if (file.parent_path() != inside) emptied.push_back(file.parent_path());
    for (const fs::path& folder_of_extracts : emptied)
      if (fs::exists(folder_of_extracts) && fs::is_empty(folder_of_extracts)) fs::remove(folder_of_extracts);
    if (!place.folder.empty() && fs::is_empty(inside) && !fs::is_symlink(inside)) fs::remove(inside);
  }
}

int remove_later_files(const fs::path& folder, const Clock& clock, const Scene& scene) {
  const bool lineout_now = OutputTimes(scene.output.times).hold(clock.time);
  std::vector<fs::path> files;
  for (const MonitorView& view : read_views(folder))
    for (const MonitorFrame& frame : view.frames)
      if (frame.step > clock.step || (frame.step == clock.step && frame.reason == end_of_run))
        files.push_back(folder / frame.file);
  std::error_code none;
  for (const auto& [place, begin, now] :
       {std::tuple{"snapshots", "snapshot_", true}, {"lineouts", "lineout_", lineout_now}})
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / place, none)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(begin)) continue;
      const std::int64_t step = std::atoll(name.c_str() + std::string_view(begin).size());
      if (step > clock.step || (step == clock.step && !now)) files.push_back(entry.path());
    }
  int removed = 0;
  for (const fs::path& file : files) removed += fs::remove(file, none) ? 1 : 0;
  return removed;
}

void check_reference_folder(const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder for the reference, got a file");
  if (fs::exists(folder))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (!entry.is_regular_file() || !is_written(written_by_reference, entry.path().filename().string()))
        throw InputError(folder.string() + ": expected a new folder or an earlier reference, got a folder with " +
                         entry.path().filename().string() + " in it; use --out DIR for another");
  check_writable(folder);
}

void clear_reference_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw OutputError(folder, failure.message());
  for (const std::string& name : written_by_reference.names) fs::remove(folder / name);
}

}  // namespace ejecta
