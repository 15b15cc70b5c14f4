#pragma once
/// Two frames of the stretched rod through the shipped pipelines that show tensors.
#include <gtest/gtest.h>

#include "insitu/catalyst_bridge.hpp"
#include "insitu/picture.hpp"
#include "insitu/stretched_rod.hpp"

namespace ejecta {

template <int Dim>
void expect_pictures_of_tensors(int along) {
  const std::string folder = fresh_folder("rod_" + std::to_string(Dim));
  const std::string shipped = std::filesystem::path(default_pipelines(scene_with(false))[0]).parent_path().string();
  const std::vector<std::string> scripts{shipped + "/ellipses.py", shipped + "/damage.py"};
  check_pipeline_scripts(plain_pipelines(scripts));
  CatalystBridge bridge(plain_pipelines(scripts), rod_settings(folder, Dim));
  for (const std::string& channel : rod_settings(folder, Dim).channels)
    EXPECT_EQ(bridge.reads(channel.c_str()), channel == "ellipsoids");
  std::vector<std::string> images;
  for (const double crack : {0.0, 1.0}) {
    const Particles<Dim> rod = stretched_rod<Dim>(along, crack);
    const Ellipsoids layer = find_ellipsoids(rod, 0, rod_nodes_per_h);
    const int step = static_cast<int>(10 * crack);
    const FrameReport report =
        bridge.execute(step, 2e-6 * step, std::vector{layer.channel("ellipsoids")}, every_frame(bridge));
    EXPECT_TRUE(report.failures.empty()) << report.failures.front().text;
    images.insert(images.end(), report.files.begin(), report.files.end());
  }
  ASSERT_EQ(images.size(), 4u);  // damage and ellipses, whole and cracked
  for (const std::string& image : images) {
    SCOPED_TRACE(image);
    const Picture picture(image);
    EXPECT_EQ(picture.width, 800);
    EXPECT_EQ(picture.height, 600);
    EXPECT_GT(picture.coloured_share(), 0.1);
    EXPECT_TRUE(picture.band_and_margins_are_clean());
  }
  // What is damaged has other colours than what is whole, in both views.
  EXPECT_GT(Picture(images[2]).colours(), Picture(images[0]).colours() + 20);
  EXPECT_GT(Picture(images[3]).colours(), Picture(images[1]).colours() + 20);
}

}  // namespace ejecta
