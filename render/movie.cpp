#include "render/movie.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>

#include "base/errors.hpp"
#include "render/canvas.hpp"
#include "render/csv_table.hpp"
#include "render/process.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

struct Picture {
  double time;  ///< s
  fs::path file;
};
struct View {
  std::string name;
  std::vector<Picture> pictures;
};

/// Why pictures are left out of movies. One that somebody asked for, or of a place where a run was cut short that has
/// gone on since, belongs to no schedule; of several schedules of a view only the densest is shown, or time would
/// stumble.
class OddFrames {
 public:
  explicit OddFrames(const CsvTable& table) : view_(table.find("view")), reason_(table.find("reason")) {
    if (reason_ == CsvTable::npos) return;
    std::map<std::string, std::map<std::string, int>> schedules;  // of each view
    for (const auto& row : table.rows)
      if (is_schedule(row[reason_])) ++schedules[row[view_]][row[reason_]];
    for (const auto& [view, count] : schedules)
      densest_[view] = std::ranges::max_element(count, {}, [](const auto& s) { return s.second; })->first;
  }
  bool hold(const std::vector<std::string>& row) const {
    if (reason_ == CsvTable::npos) return false;  // tables of earlier versions have no reason
    const std::string& reason = row[reason_];
    return reason == "asked for" || reason == "end" || (is_schedule(reason) && reason != densest_.at(row[view_]));
  }

 private:
  static bool is_schedule(const std::string& reason) { return reason == "frame" || reason.starts_with("every "); }
  std::size_t view_, reason_;
  std::map<std::string, std::string> densest_;  ///< schedule of a view
};

/// The views in order of first appearance; images that are not there become problems.
std::vector<View> read_views(const fs::path& folder, std::vector<std::string>& problems) {
  const CsvTable table = read_csv(folder / "data.csv");
  const std::size_t view_column = table.find("view"), file_column = table.find("FILE"), time = table.find("time");
  if (view_column == CsvTable::npos || file_column == CsvTable::npos)
    throw InputError((folder / "data.csv").string() + ": expected the columns view and FILE");
  const auto cell = [](const std::vector<std::string>& row, std::size_t column) {
    return column == CsvTable::npos ? std::string() : row[column];
  };
  const OddFrames odd(table);
  std::vector<View> views;
  for (const std::vector<std::string>& row : table.rows) {
    const fs::path image = fs::absolute(folder / row[file_column]);
    if (image.extension() != ".png" && image.extension() != ".jpg") continue;  // data that a pipeline has written
    const bool at_an_end =
        cell(row, time) == cell(table.rows.front(), time) || cell(row, time) == cell(table.rows.back(), time);
    if (!at_an_end && odd.hold(row)) continue;
    if (!fs::exists(image)) {
      problems.push_back(fmt::format("{}: image is missing, left out of the movie", image.string()));
      continue;
    }
    auto view = std::find_if(views.begin(), views.end(), [&](const View& v) { return v.name == row[view_column]; });
    if (view == views.end()) view = views.insert(views.end(), {row[view_column], {}});
    view->pictures.push_back({std::strtod(cell(row, time).c_str(), nullptr), image});
  }
  return views;
}

/// List for ffmpeg's concat demuxer.
void write_list(const fs::path& file, const std::vector<Picture>& pictures, int rate) {
  std::ofstream out(file);
  out << "ffconcat version 1.0\n";
  for (const Picture& picture : pictures) {
    std::string quoted;
    for (const char c : picture.file.string()) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    out << "file '" << quoted << "'\nduration " << fmt::format("{:.9f}", 1.0 / rate) << '\n';
  }
}

/// For each picture of `leader` the one of `view` of the same time, or the last one before.
std::vector<Picture> in_step(const View& view, const View& leader) {
  std::vector<Picture> pictures;
  std::size_t k = 0;
  for (const Picture& picture : leader.pictures) {
    while (k + 1 < view.pictures.size() && view.pictures[k + 1].time <= picture.time) ++k;
    pictures.push_back(view.pictures[k]);
  }
  return pictures;
}

/// One movie by ffmpeg, in the run folder. Replaces an earlier one only if it succeeds. Returns what went wrong.
std::string encode(const fs::path& run_folder, const std::string& name, int rate, std::vector<std::string> inputs,
                   const std::string& filter) {
  const std::string part = name + ".part.mp4";
  std::vector<std::string> command{"ffmpeg", "-y", "-v", "error"};
  command.insert(command.end(), inputs.begin(), inputs.end());
  for (const char* word : {"-an", "-filter_complex"}) command.emplace_back(word);
  command.push_back(filter);
  for (const std::string& word : {std::string("-r"), std::to_string(rate)}) command.push_back(word);
  for (const char* word :
       {"-c:v", "libx264", "-preset", "fast", "-crf", "19", "-pix_fmt", "yuv420p", "-movflags", "+faststart"})
    command.emplace_back(word);
  command.push_back(part);
  const std::string problem = run_program(command, run_folder);
  std::error_code ignored;
  if (problem.empty())
    fs::rename(run_folder / part, run_folder / (name + ".mp4"));
  else
    fs::remove(run_folder / part, ignored);
  return problem;
}

/// A list of pictures as an input of ffmpeg, as long as it lives.
class ListFile {
 public:
  ListFile(const fs::path& folder, const std::string& name, const std::vector<Picture>& pictures, int rate)
      : path_(folder / (name + ".txt")) {
    write_list(path_, pictures, rate);
  }
  ~ListFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  ListFile(const ListFile&) = delete;
  ListFile& operator=(const ListFile&) = delete;
  std::vector<std::string> input() const { return {"-f", "concat", "-safe", "0", "-i", path_.filename().string()}; }

 private:
  fs::path path_;
};

/// All views in one picture, two in a row, after the title card.
std::string encode_montage(const fs::path& run_folder, const std::vector<View>& views, int rate) {
  constexpr int width = 1920, height = 1080, title_seconds = 2, end_seconds = 1;
  const View& leader = *std::ranges::max_element(views, {}, [](const View& v) { return v.pictures.size(); });
  const int columns = views.size() > 1 ? 2 : 1;
  const int rows = (static_cast<int>(views.size()) + columns - 1) / columns;
  const int tile_width = width / columns, tile_height = height / columns;
  std::vector<std::string> inputs{
      "-loop", "1", "-framerate", std::to_string(rate), "-t", std::to_string(title_seconds), "-i", title_card};
  const auto fit = [](int w, int h) {
    return fmt::format(
        "scale={0}:{1}:force_original_aspect_ratio=decrease,pad={0}:{1}:(ow-iw)/2:(oh-ih)/2:color=white,setsar=1", w,
        h);
  };
  std::string filter = fmt::format("[0]{}[title];", fit(width, tile_height * rows)), stacked, places;
  std::vector<std::unique_ptr<ListFile>> lists;
  for (std::size_t k = 0; k < views.size(); ++k) {
    lists.push_back(
        std::make_unique<ListFile>(run_folder, fmt::format("montage_{}", k), in_step(views[k], leader), rate));
    for (const std::string& word : lists.back()->input()) inputs.push_back(word);
    filter +=
        fmt::format("[{}]settb=1/{},setpts=N,fps={},{}[v{}];", k + 1, rate, rate, fit(tile_width, tile_height), k);
    stacked += fmt::format("[v{}]", k);
    const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
    places += fmt::format("{}{}_{}", k ? "|" : "", column * tile_width, row * tile_height);
  }
  filter += views.size() > 1
                ? fmt::format("{}xstack=inputs={}:layout={}:fill=white[all];", stacked, views.size(), places)
                : std::string("[v0]null[all];");
  filter += fmt::format("[all]tpad=stop_mode=clone:stop_duration={}[whole];[title][whole]concat=n=2:v=1", end_seconds);
  return encode(run_folder, "montage", rate, inputs, filter);
}

}  // namespace

void write_title_card(const fs::path& run_folder, const std::string& title, const std::vector<std::string>& lines) {
  constexpr int width = 1920, height = 1080;
  constexpr Colour paper{0.93, 0.94, 0.955}, ink{0.13, 0.15, 0.18}, faint{0.42, 0.45, 0.50};
  Canvas canvas(width, height, paper);
  const double size = std::min(64.0, 64.0 * 0.86 * width / std::max(1.0, canvas.width_of(title, 70)));
  canvas.text(0.5 * width, 0.46 * height, title, size, ink, Align::centre, true);
  double y = 0.46 * height + 40;
  for (const std::string& line : lines) canvas.text(0.5 * width, y += 44, line, 30, faint, Align::centre);
  write_png(run_folder / title_card, canvas.raster());
}

MovieReport make_movies(const fs::path& run_folder, int frames_per_second) {
  MovieReport report;
  std::vector<View> views;
  try {
    views = read_views(run_folder / "images", report.problems);
  } catch (const InputError& error) {
    report.problems.push_back(error.what());
    return report;
  }
  const auto rate_of = [&](std::size_t frames) {
    const int four_seconds = static_cast<int>(std::lround(static_cast<double>(frames) / 4));
    return frames_per_second > 0 ? frames_per_second : std::clamp(four_seconds, 4, 24);
  };
  const auto note = [&](const std::string& view, const std::string& name, std::size_t frames,
                        const std::string& problem) {
    if (problem.empty())
      report.movies.push_back({view, run_folder / (name + ".mp4"), frames});
    else
      report.problems.push_back(fmt::format("{}.mp4: {}", name, problem));
  };
  for (const View& view : views) {
    const int rate = rate_of(view.pictures.size());
    const std::string name = "movie_" + view.name;
    const ListFile list(run_folder, name, view.pictures, rate);
    note(view.name, name, view.pictures.size(),
         encode(run_folder, name, rate, list.input(),
                fmt::format("settb=1/{0},setpts=N,pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", rate)));
  }
  if (!views.empty() && fs::exists(run_folder / title_card)) {
    const std::size_t frames =
        std::ranges::max(views, {}, [](const View& v) { return v.pictures.size(); }).pictures.size();
    note("montage", "montage", frames, encode_montage(run_folder, views, rate_of(frames)));
  }
  return report;
}

}  // namespace ejecta
