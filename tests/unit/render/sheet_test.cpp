#include "render/sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

TEST(ColourScale, BeyondItsLinearPartItGivesEachDecadeTheSameRoom) {
  const ColourScale scale = colour_scale(ColourMap::cool_warm, -1e9, 1e9, 1e6);
  EXPECT_DOUBLE_EQ(scale.place(0), 0.5);
  EXPECT_NEAR(scale.place(1e9) - scale.place(1e8), scale.place(1e8) - scale.place(1e7), 2e-3);
  EXPECT_DOUBLE_EQ(scale.place(-3e7), 1 - scale.place(3e7));
  EXPECT_NEAR(scale.value(scale.place(4.2e7)), 4.2e7, 1);
  // The colours follow the places, and zero keeps the middle of the map.
  EXPECT_TRUE(same(scale.at(0), map_colour(ColourMap::cool_warm, 0.5)));
  const Colour there = scale.at(1e8), expected = map_colour(ColourMap::cool_warm, scale.place(1e8));
  EXPECT_NEAR(there.red, expected.red, 0.01);
  EXPECT_NEAR(there.green, expected.green, 0.01);
  const std::vector<double> values{-1e9, 0, std::nan("")};
  EXPECT_EQ(coloured(values, scale, 0x123456), (std::vector<std::uint32_t>{0x3B4CC0, 0xDDDDDD, 0x123456}));
}

double saturation(Colour c) { return std::max({c.red, c.green, c.blue}) - std::min({c.red, c.green, c.blue}); }

TEST(RankColour, TheFirstFiveAreStrongAndDustIsFaint) {
  for (int rank = 1; rank <= 5; ++rank) EXPECT_GT(saturation(rank_colour(rank)), 0.5) << rank;
  for (int rank = 6; rank < 60; ++rank) EXPECT_LT(saturation(rank_colour(rank)), 0.45) << rank;
  EXPECT_LT(saturation(rank_colour(0)), 0.05);
  for (int rank = 1; rank < 40; ++rank) {
    const Colour a = rank_colour(rank), b = rank_colour(rank + 1);
    EXPECT_GT(std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue), 0.2) << rank;
  }
}

TEST(ColourMap, IsFoundByItsName) {
  EXPECT_EQ(colour_map_named(name_of(ColourMap::plasma)), ColourMap::plasma);
  EXPECT_THROW(colour_map_named("rainbow"), std::invalid_argument);
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
  EXPECT_EQ(short_number(11000), "11000");
  EXPECT_EQ(short_number(-12500), "-12500");
  EXPECT_EQ(short_number(0.25), "0.25");
  EXPECT_EQ(short_number(3e7), "3e+07");
}

TEST(DisplayUnit, TicksAreRoundAndInside) {
  const std::vector<double> ticks = round_ticks(-0.13, 0.27, 4);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_NEAR(ticks[0], -0.1, 1e-12);
  EXPECT_NEAR(ticks[3], 0.2, 1e-12);
  EXPECT_EQ(round_ticks(5, 5, 4), std::vector<double>{5});
}

const Window square{{-0.05, -0.05}, {0.05, 0.05}};

TEST(Layout, EveryPaneShowsTheWindowAndLiesWithinThePicture) {
  for (const auto& [width, height] : {std::pair{1920, 1080}, {960, 720}, {320, 240}})
    for (const int panes : {1, 2, 3, 4})
      for (const Window& window : {square, Window{{0, 0}, {4, 1}}, Window{{0, 0}, {0.1, 1}}}) {
        const Layout layout(width, height, panes, window, Layout::everywhere());
        SCOPED_TRACE(testing::Message() << width << ' ' << panes << ' ' << window.width());
        EXPECT_LE(layout.window.low[0], window.low[0] + layout.pixel());
        EXPECT_GE(layout.window.high[1], window.high[1] - layout.pixel());
        ASSERT_EQ(layout.panes.size(), static_cast<std::size_t>(panes));
        for (std::size_t k = 0; k < layout.panes.size(); ++k) {
          const PixelBox& b = layout.panes[k];
          EXPECT_NEAR(b.width / b.height, layout.window.width() / layout.window.height(), 1e-9);
          EXPECT_GE(b.y, 2.5 * layout.font);  // below the band
          EXPECT_LE(b.x + b.width, width);
          EXPECT_LE(b.y + b.height, height);
          if (k == 0) continue;
          EXPECT_TRUE(b.x >= layout.panes[k - 1].x + b.width || b.y >= layout.panes[k - 1].y + b.height);
        }
      }
}

TEST(Layout, PutsLongWindowsAboveEachOtherAndHighOnesBesideEachOther) {
  EXPECT_FALSE(Layout(1920, 1080, 3, {{0, 0}, {5, 1}}, Layout::everywhere()).keys_below);
  EXPECT_TRUE(Layout(1920, 1080, 3, {{0, 0}, {1, 2}}, Layout::everywhere()).keys_below);
}

TEST(Layout, OfThreePanesOfASquareUsesMostOfTheWidth) {
  const Layout layout(1920, 1080, 3, square, Layout::everywhere());
  EXPECT_GT(3 * layout.panes[0].width, 0.85 * 1920);
}

TEST(Layout, ALegendStandsBesideALongWindowToo) {
  const Window flat{{0, 0}, {10, 1}};
  EXPECT_TRUE(Layout(1920, 1080, 1, flat, Layout::everywhere()).keys_below);
  const Layout layout(1920, 1080, 1, flat, Layout::everywhere(), 15);
  EXPECT_FALSE(layout.keys_below);
  EXPECT_LE(layout.panes[0].x + layout.panes[0].width, 1920 - 15 * layout.font);
}

TEST(Layout, ShowsNothingBeyondItsLimits) {
  const Layout layout(1920, 1080, 1, square, {{0, -1}, {1, 1}});
  EXPECT_GE(layout.window.low[0], -1e-12);
  EXPECT_LT(layout.window.low[0], layout.pixel());
  EXPECT_GT(layout.window.high[0], 0.05);
}

TEST(Layout, ItsGridCoversThePaneWithSquarePixels) {
  const Layout layout(1920, 1080, 3, square, Layout::everywhere());
  const PixelGrid fine = layout.grid();
  EXPECT_EQ(fine.width, layout.panes[0].width);
  EXPECT_NEAR(fine.first[0] - 0.5 * fine.pixel, layout.window.low[0], 1e-12);
  EXPECT_NEAR(fine.first[1] - 0.5 * fine.pixel, layout.window.low[1], 1e-12);
  EXPECT_EQ(layout.grid(1.5 * layout.pixel()).width, fine.width);
  for (const double finest : {2.5, 20.0}) {
    const PixelGrid coarse = layout.grid(finest * layout.pixel());
    EXPECT_EQ(coarse.width, fine.width / 2);
    EXPECT_GE(coarse.pixel * coarse.width, layout.window.width() * (1 - 1e-12));
  }
}

class SheetTest : public testing::Test {
 protected:
  std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string("ejecta_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".png");
};

TEST_F(SheetTest, PaintsTheFieldTheRightWayUpAndLeavesVoidEmpty) {
  const Layout layout(700, 500, 1, square, Layout::everywhere());
  const PixelGrid grid = layout.grid();
  std::vector<double> field(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), std::nan(""));
  for (int j = grid.height / 2; j < grid.height; ++j)  // only the upper half holds matter, hot on the left
    for (int i = 0; i < grid.width; ++i)
      field[static_cast<std::size_t>(j * grid.width + i)] = i < grid.width / 2 ? 1e9 : 0;
  const std::vector<Panel> panels{{"pressure", "Pa", field, colour_scale(ColourMap::viridis, 0, 1e9)}};
  write_panels(file, layout, grid, panels, {"A test", "of it", 1e-6, 2e-6}, {"x", "z"});
  const Png png = read_png(file);
  ASSERT_EQ(png.width, 700);
  ASSERT_EQ(png.height, 500);
  EXPECT_GT(png.colours(), 200u);  // colour bar and smooth text
  const auto at = [&](double u, double v) {
    const PixelBox& b = layout.panes[0];
    return png.rgb[static_cast<std::size_t>(b.y + v * b.height) * 700 + static_cast<std::size_t>(b.x + u * b.width)];
  };
  EXPECT_EQ(at(0.3, 0.3), 0xFDE725u);
  EXPECT_EQ(at(0.7, 0.3), 0x440154u);
  EXPECT_EQ(at(0.3, 0.7), 0xFFFFFFu);
}

TEST_F(SheetTest, SameFrameSameBytesAndUnwritableIsAnOutputError) {
  const Layout layout(640, 400, 2, square, Layout::everywhere());
  const PixelGrid grid = layout.grid(0.01);
  const std::vector<double> field(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), 10.0);
  const std::vector<Panel> panels{{"density", "kg/m^3", field, colour_scale(ColourMap::inferno, 1, 100)},
                                  {"pressure", "Pa", field, colour_scale(ColourMap::cool_warm, -5, 2000, 1)}};
  const auto write = [&](const std::filesystem::path& to) { write_panels(to, layout, grid, panels, {}, {"x", "z"}); };
  write(file);
  const Png first = read_png(file);
  write(file);
  EXPECT_EQ(first.rgb, read_png(file).rgb);
  EXPECT_THROW(write("/no_such_folder/a.png"), OutputError);
}

}  // namespace
}  // namespace ejecta
