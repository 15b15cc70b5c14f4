#include "insitu/image_index.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "insitu/picture.hpp"

namespace ejecta {
namespace {

void touch(const std::string& path, const std::string& text = "png IEND\xae\x42\x60\x82") {
  std::ofstream(path) << text;
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(ImageIndex, AddsOneRowForEachNewImage) {
  const std::string folder = fresh_folder("index");
  ImageIndex index(folder);
  touch(folder + "/slice_000003.png");
  touch(folder + "/RenderView1_3.png");
  std::filesystem::create_directories(folder + "/sub");
  touch(folder + "/sub/points_000003.vtp");
  EXPECT_EQ(index.add_new_files(3, 1.5e-6, "frame").size(), 3u);
  EXPECT_TRUE(index.add_new_files(4, 2e-6, "frame").empty());
  EXPECT_EQ(contents(folder + "/data.csv"),
            "time,step,view,reason,FILE\n"
            "1.5e-06,3,RenderView1,frame,RenderView1_3.png\n"
            "1.5e-06,3,slice,frame,slice_000003.png\n"
            "1.5e-06,3,sub_points,frame,sub/points_000003.vtp\n");
}

TEST(ImageIndex, KeepsOneRowForAnImageDrawnAgainAfterARestart) {
  const std::string folder = fresh_folder("restart");
  {
    ImageIndex index(folder);
    touch(folder + "/slice_000000.png");
    index.add_new_files(0, 0, "start, of all");
    touch(folder + "/slice_000010.png");
    index.add_new_files(10, 1, "frame");
  }
  ImageIndex again(folder);
  const std::filesystem::path redrawn = folder + "/slice_000010.png";
  std::filesystem::last_write_time(redrawn, std::filesystem::last_write_time(redrawn) + std::chrono::seconds(1));
  EXPECT_EQ(again.add_new_files(10, 1.25, "end"), std::vector<std::string>{redrawn.string()});
  EXPECT_EQ(contents(folder + "/data.csv"),
            "time,step,view,reason,FILE\n"
            "0,0,slice,\"start, of all\",slice_000000.png\n"
            "1.25,10,slice,end,slice_000010.png\n");
}

TEST(ImageIndex, TellsTheViewFromTheNameOfAFile) {
  for (const auto& [file, view] : {std::pair{"slice_000120.png", "slice"},
                                   {"RenderView1_120.jpg", "RenderView1"},
                                   {"RenderView1_000120_p1_t2.png", "RenderView1_p1_t2"},
                                   {"points_000120/points_000120_0.vtp", "points_points_0"},
                                   {"plot_0.000025.csv", "plot"},
                                   {"table.csv", "table"},
                                   {"7.png", "7"}})
    EXPECT_EQ(view_of(file, 120), view) << file;
  EXPECT_EQ(view_of("RenderView1_000p=000.00t=000.00.png", 0), "RenderView1p=000.00t=000.00");  // as ParaView names it
  EXPECT_EQ(view_of("RenderView1_1.png", 1), "RenderView1");
}

}  // namespace
}  // namespace ejecta
