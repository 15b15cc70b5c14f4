#include "output/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace ejecta {
namespace {

TEST(Summary, HasExactlyThePromisedKeysInOrder) {
  std::istringstream lines(summary_json({}));
  std::vector<std::string> keys;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  \"")) keys.push_back(line.substr(3, line.find("\": ") - 3));
  const std::vector<std::string> promised{"scene",
                                          "dimension",
                                          "scheme",
                                          "precision",
                                          "threads",
                                          "particles",
                                          "cells",
                                          "steps",
                                          "element_steps",
                                          "time_s",
                                          "wall_s",
                                          "particle_steps_per_s",
                                          "cell_steps_per_s",
                                          "pair_interactions_per_s",
                                          "neighbours_mean",
                                          "bytes_per_particle",
                                          "peak_rss_mb",
                                          "mass_error_rel",
                                          "momentum_error_rel",
                                          "angular_momentum_error_rel",
                                          "energy_error_rel",
                                          "shape_votes",
                                          "shape_few_neighbours",
                                          "shape_limited_change",
                                          "shape_largest_aspect",
                                          "images",
                                          "extracts",
                                          "frames",
                                          "frames_left_out",
                                          "pipelines",
                                          "insitu_share",
                                          "insitu_bytes_written",
                                          "full_dump_bytes_avoided",
                                          "fragment_target",
                                          "largest_fragment_mass_fraction",
                                          "fragments",
                                          "bodies",
                                          "quantities",
                                          "state",
                                          "reason",
                                          "not_written",
                                          "exit"};
  EXPECT_EQ(keys, promised);
}

TEST(Summary, WritesValuesNullsAndEscapes) {
  Summary s;
  s.scene = "a \"b\"\\\n";
  s.energy_error_rel = 0.1 + 0.2;
  s.neighbours_mean = std::nan("");
  s.fragments = 0;
  s.bodies = {{"ball", 2.5, 1, 0.75, 0.25, {}, {}}};
  s.exit = 3;
  const auto file = std::filesystem::path(testing::TempDir()) / "ejecta_summary.json";
  write_summary(file, s);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_NE(text.str().find("\"scene\": \"a \\\"b\\\"\\\\\\u000a\","), std::string::npos);
  EXPECT_NE(text.str().find("\"energy_error_rel\": 0.30000000000000004,"), std::string::npos);
  EXPECT_NE(text.str().find("\"neighbours_mean\": null,"), std::string::npos);
  EXPECT_NE(text.str().find("\"images\": null,"), std::string::npos);
  EXPECT_NE(text.str().find("\"fragments\": 0,"), std::string::npos);
  EXPECT_NE(text.str().find("\"ball\": {\"mass\": 2.5, \"fragments\": 1, \"largest_fragment_mass_fraction\": 0.75, "
                            "\"dust_mass_fraction\": 0.25, \"pressure_peak_max\": null, "),
            std::string::npos);
  EXPECT_NE(text.str().find("\"exit\": 3\n}"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  EXPECT_THROW(write_summary("/dev/null/summary.json", s), OutputError);
}

}  // namespace
}  // namespace ejecta
