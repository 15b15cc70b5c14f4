#include "render/image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "png.hpp"
#include "render/display_unit.hpp"

namespace ejecta {
namespace {

TEST(ColourMap, EndsMeetThePublishedColours) {
  const auto near = [](Colour c, double r, double g, double b) {
    return std::abs(c.red - r) < 3e-3 && std::abs(c.green - g) < 3e-3 && std::abs(c.blue - b) < 3e-3;
  };
  EXPECT_TRUE(near(map_colour(ColourMap::viridis, 0), 0.267, 0.005, 0.329));
  EXPECT_TRUE(near(map_colour(ColourMap::viridis, 7), 0.993, 0.906, 0.144));  // clamped
  EXPECT_TRUE(near(map_colour(ColourMap::inferno, 0.5), 0.736, 0.216, 0.330));
  EXPECT_TRUE(near(map_colour(ColourMap::cool_warm, 0.5), 0.865, 0.865, 0.865));
}

bool same(Colour a, Colour b) { return a.red == b.red && a.green == b.green && a.blue == b.blue; }

TEST(ColourScale, KeepsTheMiddleOfADivergingMapAtZero) {
  const ColourScale scale = colour_scale(ColourMap::cool_warm, -1e6, 2e7);
  EXPECT_TRUE(same(scale.at(0), map_colour(ColourMap::cool_warm, 0.5)));
  EXPECT_TRUE(same(scale.at(-1e6), map_colour(ColourMap::cool_warm, 0)));
  EXPECT_TRUE(same(scale.at(3e7), map_colour(ColourMap::cool_warm, 1)));
  EXPECT_TRUE(same(scale.at(5e6), map_colour(ColourMap::cool_warm, 0.625)));
  EXPECT_TRUE(std::is_sorted(scale.values.begin(), scale.values.end()));
}

TEST(ColourScale, OfWhatNeverFallsBelowZeroIsSequential) {
  EXPECT_TRUE(same(colour_scale(ColourMap::cool_warm, 0, 4).at(3), map_colour(ColourMap::inferno, 0.75)));
  EXPECT_TRUE(same(colour_scale(ColourMap::viridis, -4, 4).at(0), map_colour(ColourMap::viridis, 0.5)));
}

TEST(ColourMap, FragmentsInARowAreToldApart) {
  for (std::int32_t n = 0; n < 40; ++n) {
    const Colour a = fragment_colour(n), b = fragment_colour(n + 1);
    EXPECT_GT(std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue), 0.3) << n;
  }
}

TEST(DisplayUnit, PicksAPrefixThatReadsWell) {
  EXPECT_EQ(display_unit(2e8, "Pa").label, "MPa");
  EXPECT_EQ(display_unit(1e9, "Pa").label, "GPa");
  EXPECT_EQ(display_unit(0.03, "m").label, "mm");
  EXPECT_EQ(display_unit(2580, "m/s").label, "km/s");
  EXPECT_EQ(display_unit(2700, "kg/m^3").label, "kg/m³");
  EXPECT_EQ(display_unit(1, "1").label, "");
  EXPECT_EQ(display_unit(0, "Pa").si, 1);
  EXPECT_EQ(time_text(1.234e-5, 6e-5), "12.3 µs");
  EXPECT_EQ(time_text(0, 6e-5), "0.0 µs");
}

TEST(DisplayUnit, TicksAreRoundAndInside) {
  const std::vector<double> ticks = round_ticks(-0.13, 0.27, 4);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_NEAR(ticks[0], -0.1, 1e-12);
  EXPECT_NEAR(ticks[3], 0.2, 1e-12);
  EXPECT_EQ(round_ticks(5, 5, 4), std::vector<double>{5});
}

class ImageTest : public testing::Test {
 protected:
  std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string("ejecta_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".png");
};

TEST_F(ImageTest, PaintsTheFieldTheRightWayUpAndLeavesVoidEmpty) {
  const auto [width, height] = panel_pixels(700, 500, 1);
  const PixelGrid grid = centred_grid(width, height, {0, 0}, 0.1);
  std::vector<double> field(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), std::nan(""));
  for (int j = height / 2; j < height; ++j)  // only the upper half holds matter, hot on the left
    for (int i = 0; i < width; ++i) field[static_cast<std::size_t>(j * width + i)] = i < width / 2 ? 1e9 : 0;
  const std::vector<Panel> panels{{"pressure", "Pa", field, 0, 1e9, ColourMap::viridis, false}};
  write_panels(file, 700, 500, grid, panels, {"A test", 1e-6, 2e-6});
  const Png png = read_png(file);
  ASSERT_EQ(png.width, 700);
  ASSERT_EQ(png.height, 500);
  EXPECT_GT(png.colours(), 200u);  // colour bar and smooth text
  const auto at = [&](double u, double v) {
    return png.rgb[static_cast<std::size_t>(500 * v) * 700 + static_cast<std::size_t>(700 * u)];
  };
  EXPECT_EQ(at(0.3, 0.3), 0xFDE725u);
  EXPECT_EQ(at(0.7, 0.3), 0x440154u);
  EXPECT_GT(at(0.3, 0.7), 0xF00000u);  // void: the light background
}

TEST_F(ImageTest, SameFrameSameBytesAndUnwritableIsAnOutputError) {
  const PixelGrid grid = centred_grid(40, 40, {0, 0}, 1);
  const std::vector<double> field(1600, 10.0);
  const std::vector<Panel> panels{{"density", "kg/m^3", field, 1, 100, ColourMap::inferno, true},
                                  {"damage", "1", field, 0, 20, ColourMap::cool_warm, false}};
  write_panels(file, 640, 400, grid, panels, {"", 0, 1});
  const Png first = read_png(file);
  write_panels(file, 640, 400, grid, panels, {"", 0, 1});
  EXPECT_EQ(first.rgb, read_png(file).rgb);
  EXPECT_THROW(write_panels("/no_such_folder/a.png", 640, 400, grid, panels, {"", 0, 1}), OutputError);
}

}  // namespace
}  // namespace ejecta
