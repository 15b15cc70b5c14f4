#pragma once
/// Movies from the images a run has left: one per view, and a montage of all of them.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ejecta {

struct Movie {
  std::string view;
  std::filesystem::path file;  ///< in the run folder
  std::size_t frames = 0;
};

struct MovieReport {
  std::vector<Movie> movies;          ///< those made
  std::vector<std::string> problems;  ///< one sentence each: a missing image, no ffmpeg, ...
};

inline constexpr const char* title_card = "title.png";  ///< in the run folder

/// title.png of the run folder, which the montage begins with. Throws OutputError if it cannot be written.
void write_title_card(const std::filesystem::path& run_folder, const std::string& title,
                      const std::vector<std::string>& lines);

/// Reads images/data.csv (columns `view` and `FILE`, the path of the image relative to images/, in order of time) and
/// encodes H.264 in yuv420p with even sizes by ffmpeg: movie_<view>.mp4, and, where there is a title card, montage.mp4,
/// which shows all views at once. Pictures that somebody asked for, or of a place where a run was cut short that has
/// gone on since, are left out, and of several schedules (insitu.frames, insitu.every) all but the densest.
/// `frames_per_second` 0: 24, and fewer where the movie would last less than four seconds. Movies of earlier calls are
/// replaced. Never throws for what the folder lacks.
MovieReport make_movies(const std::filesystem::path& run_folder, int frames_per_second = 0);

}  // namespace ejecta
