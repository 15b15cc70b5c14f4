#include "render/movie.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "render/csv_table.hpp"
#include "render/process.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

struct View {
  std::string name;
  std::vector<fs::path> images;
};

/// The views in order of first appearance; images that are not there become problems.
std::vector<View> read_views(const fs::path& folder, std::vector<std::string>& problems) {
  const CsvTable table = read_csv(folder / "data.csv");
  const std::size_t view_column = table.find("view"), file_column = table.find("FILE");
  if (view_column == CsvTable::npos || file_column == CsvTable::npos)
    throw InputError((folder / "data.csv").string() + ": expected the columns view and FILE");
  std::vector<View> views;
  for (const std::vector<std::string>& row : table.rows) {
    const fs::path image = fs::absolute(folder / row[file_column]);
    if (image.extension() != ".png" && image.extension() != ".jpg") continue;  // data that a pipeline has written
    if (!fs::exists(image)) {
      problems.push_back(fmt::format("{}: image is missing, left out of the movie", image.string()));
      continue;
    }
    auto view = std::find_if(views.begin(), views.end(), [&](const View& v) { return v.name == row[view_column]; });
    if (view == views.end()) view = views.insert(views.end(), {row[view_column], {}});
    view->images.push_back(image);
  }
  return views;
}

/// List for ffmpeg's concat demuxer.
void write_list(const fs::path& file, const std::vector<fs::path>& images, int rate) {
  std::ofstream out(file);
  out << "ffconcat version 1.0\n";
  for (const fs::path& image : images) {
    std::string quoted;
    for (const char c : image.string()) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    out << "file '" << quoted << "'\nduration " << fmt::format("{:.9f}", 1.0 / rate) << '\n';
  }
}

}  // namespace

MovieReport make_movies(const fs::path& run_folder, int frames_per_second) {
  MovieReport report;
  std::vector<View> views;
  try {
    views = read_views(run_folder / "images", report.problems);
  } catch (const InputError& error) {
    report.problems.push_back(error.what());
    return report;
  }
  for (const View& view : views) {
    const double frames = static_cast<double>(view.images.size());
    const int rate =
        frames_per_second > 0 ? frames_per_second : std::clamp(static_cast<int>(std::lround(frames / 8)), 4, 30);
    const fs::path name = "movie_" + view.name + ".mp4", part = "movie_" + view.name + ".part.mp4";
    const fs::path list = run_folder / ("movie_" + view.name + ".txt");
    write_list(list, view.images, rate);
    const std::string problem =
        run_program({"ffmpeg",
                     "-y",
                     "-v",
                     "error",
                     "-f",
                     "concat",
                     "-safe",
                     "0",
                     "-i",
                     list.filename().string(),
                     "-an",
                     "-vf",
                     fmt::format("settb=1/{0},setpts=N,pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", rate),
                     "-r",
                     std::to_string(rate),
                     "-c:v",
                     "libx264",
                     "-preset",
                     "medium",
                     "-crf",
                     "20",
                     "-pix_fmt",
                     "yuv420p",
                     "-movflags",
                     "+faststart",
                     part.string()},
                    run_folder);
    std::error_code ignored;
    fs::remove(list, ignored);
    if (problem.empty()) {
      fs::rename(run_folder / part, run_folder / name);
      report.movies.push_back({view.name, run_folder / name, view.images.size()});
    } else {
      fs::remove(run_folder / part, ignored);
      report.problems.push_back(fmt::format("{}: {}", name.string(), problem));
    }
  }
  return report;
}

}  // namespace ejecta
