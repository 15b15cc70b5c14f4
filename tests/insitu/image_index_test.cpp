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
  touch(folder + "/notes.txt");
  EXPECT_EQ(index.add_new_images(3, 1.5e-6).size(), 2u);
  EXPECT_TRUE(index.add_new_images(4, 2e-6).empty());
  EXPECT_EQ(contents(folder + "/data.csv"),
            "time,step,view,FILE\n"
            "1.5e-06,3,RenderView1,RenderView1_3.png\n"
            "1.5e-06,3,slice,slice_000003.png\n");
}

TEST(ImageIndex, KeepsOneRowForAnImageDrawnAgainAfterARestart) {
  const std::string folder = fresh_folder("restart");
  {
    ImageIndex index(folder);
    touch(folder + "/slice_000000.png");
    index.add_new_images(0, 0);
    touch(folder + "/slice_000010.png");
    index.add_new_images(10, 1);
  }
  ImageIndex again(folder);
  const std::filesystem::path redrawn = folder + "/slice_000010.png";
  std::filesystem::last_write_time(redrawn, std::filesystem::last_write_time(redrawn) + std::chrono::seconds(1));
  EXPECT_EQ(again.add_new_images(10, 1.25), std::vector<std::string>{redrawn.string()});
  EXPECT_EQ(contents(folder + "/data.csv"),
            "time,step,view,FILE\n"
            "0,0,slice,slice_000000.png\n"
            "1.25,10,slice,slice_000010.png\n");
}

}  // namespace
}  // namespace ejecta
