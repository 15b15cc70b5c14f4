#include "render/movie.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "png.hpp"
#include "render/canvas.hpp"
#include "render/process.hpp"

namespace ejecta {
namespace {

namespace fs = std::filesystem;

/// Number of frames that decode, and the pixel format, as "7,yuv420p".
std::string decoded(const fs::path& movie) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
      "stream=pix_fmt,width,height,nb_read_frames -of csv=p=0 \"" +
      movie.string() + '"';
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  char text[256] = {};
  return fgets(text, sizeof text, pipe.get()) ? std::string(text) : std::string();
}

TEST(Movie, HasAFrameForEveryImageOfAView) {
  const fs::path run = fs::path(testing::TempDir()) / "ejecta movie's run";  // awkward names must work
  fs::remove_all(run);
  fs::create_directories(run / "images");
  std::ofstream data(run / "images/data.csv");
  data << "time,view,FILE\n";
  for (int k = 0; k < 13; ++k) {
    Canvas canvas(101, 75, {0.9, 0.9, 0.95});  // odd sizes
    canvas.fill({5.0 + 6 * k, 20, 20, 30}, {0.8, 0.2, 0.1});
    const std::string name = "slice_" + std::to_string(k) + ".png";
    write_png(run / "images" / name, canvas.raster());
    data << k << ",slice," << name << '\n';
    if (k < 1) data << k << ",single," << name << '\n';
  }
  data << "13,slice,lost.png\n";
  data.close();
  const MovieReport report = make_movies(run);
  ASSERT_EQ(report.movies.size(), 2u) << (report.problems.empty() ? "" : report.problems.back());
  EXPECT_EQ(report.movies[0].file.filename(), "movie_slice.mp4");
  EXPECT_EQ(report.movies[0].frames, 13u);
  EXPECT_EQ(decoded(report.movies[0].file), "102,76,yuv420p,13\n");
  EXPECT_EQ(decoded(report.movies[1].file), "102,76,yuv420p,1\n");
  ASSERT_EQ(report.problems.size(), 1u);
  EXPECT_NE(report.problems[0].find("lost.png"), std::string::npos);
}

/// A run of two views with a picture a step, drawn for these reasons.
fs::path run_of(const std::string& name, const std::vector<std::string>& reasons) {
  const fs::path run = fs::path(testing::TempDir()) / name;
  fs::remove_all(run);
  fs::create_directories(run / "images");
  std::ofstream data(run / "images/data.csv");
  data << "time,step,view,reason,FILE\n";
  for (std::size_t k = 0; k < reasons.size(); ++k)
    for (const std::string view : {"slice", "cutaway"}) {
      const std::string file = view + '_' + std::to_string(k) + ".png";
      write_png(run / "images" / file, Raster(64, 36, static_cast<std::uint32_t>(k * 0x0F0F0F)));
      data << k << ',' << k << ',' << view << ',' << reasons[k] << ',' << file << '\n';
    }
  return run;
}

TEST(Movie, FramesThatBelongToNoScheduleAreLeftOut) {
  const auto frames = [](const std::vector<std::string>& reasons) {
    return make_movies(run_of("ejecta_odd_frames", reasons)).movies.at(0).frames;
  };
  EXPECT_EQ(frames({"frame", "frame", "asked for", "frame", "end", "frame", "frame"}), 5u);
  EXPECT_EQ(frames({"frame", "frame", "end"}), 3u);  // that of a run which has not gone on
  EXPECT_EQ(frames({"frame", "every 2 steps", "every 2 steps", "frame", "every 2 steps", "frame"}), 5u);
  EXPECT_EQ(frames({"frame", "output.times", "first contact", "frame"}), 4u);
}

TEST(Movie, AMontageShowsAllViewsAfterTheTitle) {
  const fs::path run = run_of("ejecta_montage", {"frame", "frame", "frame", "frame"});
  EXPECT_EQ(make_movies(run).movies.size(), 2u);  // no title, no montage
  write_title_card(run, "A scene with a \"title\": 100 %", {"scene x", "commit y"});
  const MovieReport report = make_movies(run);
  ASSERT_EQ(report.movies.size(), 3u) << (report.problems.empty() ? "" : report.problems.back());
  EXPECT_EQ(report.movies[2].file.filename(), "montage.mp4");
  // At four frames a second two seconds of title, four frames, and one second of the last.
  EXPECT_EQ(decoded(report.movies[2].file), "1920,540,yuv420p,16\n");
}

TEST(Movie, ViewsOfSeveralSchedulesKeepTheirFramesAndTheMontageItsTime) {
  const fs::path run = run_of("ejecta_paces", std::vector<std::string>(8, "every 1 steps"));
  std::ofstream data(run / "images/data.csv", std::ios::app);
  for (const int k : {0, 1, 3, 5}) {  // another view, of its own pace, between the steps of the others
    const std::string file = "surface_" + std::to_string(k) + ".png";
    write_png(run / "images" / file, Raster(64, 36, k == 5 ? 0xFFFFFFu : 0u));
    data << k << ',' << k << ",surface,frame," << file << '\n';
  }
  data.close();
  write_title_card(run, "Title", {});
  const MovieReport report = make_movies(run);
  ASSERT_EQ(report.movies.size(), 4u) << (report.problems.empty() ? "" : report.problems.back());
  EXPECT_EQ(report.movies[2].frames, 4u);
  const fs::path last = run / "last.png";
  ASSERT_EQ(
      run_program({"ffmpeg", "-y", "-v", "error", "-sseof", "-1", "-i", "montage.mp4", "-update", "1", last.string()},
                  run),
      "");
  ASSERT_TRUE(fs::exists(last));
  const Png picture = read_png(last);
  // Below the first of the two views above: white since step 5, black before.
  EXPECT_GT(picture.rgb[static_cast<std::size_t>(3 * picture.height / 4 * picture.width + picture.width / 4)] & 255u,
            200u);
}

TEST(Movie, AFolderWithoutImagesIsAProblemNotACrash) {
  const MovieReport report = make_movies(fs::path(testing::TempDir()) / "no_such_run");
  EXPECT_TRUE(report.movies.empty());
  ASSERT_EQ(report.problems.size(), 1u);
  EXPECT_NE(report.problems[0].find("data.csv"), std::string::npos);
}

TEST(Process, SaysWhyAProgramFailed) {
  EXPECT_EQ(run_program({"true"}, "/"), "");
  EXPECT_EQ(run_program({"no_such_program_at_all"}, "/"), "no_such_program_at_all is not installed");
  EXPECT_EQ(run_program({"sh", "-c", "echo one; echo two >&2; exit 7"}, "/"), "sh failed with status 7: two");
}

}  // namespace
}  // namespace ejecta
