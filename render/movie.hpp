#pragma once
/// Movies from the images a run has left: one per view, as many frames as there are images.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ejecta {

struct Movie {
  std::string view;
  std::filesystem::path file;  ///< movie_<view>.mp4 in the run folder
  std::size_t frames = 0;
};

struct MovieReport {
  std::vector<Movie> movies;          ///< those made
  std::vector<std::string> problems;  ///< one sentence each: a missing image, no ffmpeg, ...
};

/// Reads images/data.csv (columns `view` and `FILE`, the path of the image relative to images/, in order of time) and
/// encodes H.264 in yuv420p with even sizes by ffmpeg. `frames_per_second` 0 chooses a rate at which the movie lasts
/// about eight seconds. Movies of earlier calls are replaced. Never throws for what the folder lacks.
MovieReport make_movies(const std::filesystem::path& run_folder, int frames_per_second = 0);

}  // namespace ejecta
