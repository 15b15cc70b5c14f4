/// A gas in the plane: no damage, no distension, no fragments, and of velocity nothing known before the first frame.
#include <gtest/gtest.h>

#include "insitu/catalyst_bridge.hpp"
#include "insitu/picture.hpp"

namespace ejecta {
namespace {

TEST(Gas, TheDefaultPipelinesShowWhatThereIs) {
  constexpr int columns = 100, rows = 10;
  std::vector<double> x, y, zero, density, pressure, vx, vy, h;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double s = (i + 0.5) / columns;
      x.push_back(s);
      y.push_back((j + 0.5) / columns);
      density.push_back(s < 0.5 ? 1 : 0.125);
      pressure.push_back(s < 0.5 ? 1e5 : 1e4);
      vx.push_back(200 * s);
      vy.push_back(0);
    }
  zero.assign(x.size(), 0.0);
  h.assign(x.size(), 0.013);
  const std::vector<FieldView> fields{{"density", "kg/m^3", {density}},
                                      {"pressure", "Pa", {pressure}},
                                      {"velocity", "m/s", {vx, vy}},
                                      {"smoothing_length", "m", {h}}};
  Channel particles, slice;
  particles.name = "particles";
  particles.count = x.size();
  particles.position = {x, y, zero};
  particles.fields = fields;
  slice.name = "slice";
  slice.kind = ChannelKind::image;
  slice.count = x.size();
  slice.extent = {columns, rows, 1};
  slice.spacing = {0.01, 0.01, 0.01};
  slice.origin = {0.005, 0.005, 0};
  slice.fields = fields;

  PipelineSettings s;
  s.run_folder = fresh_folder("gas");
  s.dimension = 2;
  s.channels = {"particles", "slice", "ellipsoids"};
  s.slice_fields = {"density", "pressure", "velocity"};
  s.styles = {{"density", {"density", ColourMap::plasma, ColourRange{0, 1.5}}},
              {"pressure", {"pressure", ColourMap::cool_warm, ColourRange{-5e4, 3e5}}}};
  s.view_center = {0.5, 0.05, 0};
  s.view_width = 1.2;
  s.view_height = 0.2;
  s.time_end = 1e-3;
  s.particle_radius = 0.006;
  s.image_width = 800;
  s.image_height = 500;
  Scene plane;
  plane.dimension = 2;
  CatalystBridge bridge(plain_pipelines(default_pipelines(plane)), s);
  const FrameReport report = bridge.execute(7, 5e-4, std::vector{particles, slice}, every_frame(bridge));
  EXPECT_TRUE(report.failures.empty()) << report.failures.front().text;
  ASSERT_EQ(report.files.size(), 2u);
  EXPECT_NE(report.files[1].find("particles_000007.png"), std::string::npos);
  EXPECT_NE(report.files[0].find("slice_000007.png"), std::string::npos);
  for (const std::string& path : report.files) {
    SCOPED_TRACE(path);
    const Picture picture(path);
    EXPECT_EQ(picture.width, 800);
    EXPECT_EQ(picture.height, 500);
    EXPECT_GT(picture.colours(), 30u);
    EXPECT_GT(picture.coloured_share(), 0.03);
    EXPECT_TRUE(picture.band_and_margins_are_clean());
  }
  // The pipelines have no colours of their own: they show what the settings say, as Ejecta's painter does.
  const Picture panels(report.files[0]);
  for (const auto& [field, values] : {std::pair{"density", density}, std::pair{"pressure", pressure}}) {
    const FieldStyle& style = s.styles.at(field);
    const ColourScale scale = colour_scale(style.map, style.range->min, style.range->max);
    for (const double value : {values.front(), values.back()})
      EXPECT_GT(panels.count(scale.at(value)), 1000) << field << ' ' << value;
  }
  const ColourScale open = colour_scale(ColourMap::viridis, 200 * 0.005, 200 * 0.995);  // of the first frame
  EXPECT_GT(panels.count(open.at(100)), 50);
}

}  // namespace
}  // namespace ejecta
