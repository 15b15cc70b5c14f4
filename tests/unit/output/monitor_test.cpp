#include "output/monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/property_tree/json_parser.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "base/errors.hpp"
#include "base/si_prefixes.hpp"

namespace ejecta {
namespace {

using Tree = boost::property_tree::ptree;

Tree parse(const std::string& json) {
  std::istringstream in(json);
  Tree tree;
  boost::property_tree::read_json(in, tree);
  return tree;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::filesystem::path empty_folder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "ejecta_monitor" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(Monitor, JsonHoldsTheStatusAndSurvivesAnyText) {
  MonitorStatus s;
  s.scene = "pumice \"quoted\" \\ line\nbreak \x01 µ</script>";
  s.state = RunState::stopped;
  s.step = 12345678901;
  s.time = 0.1 + 0.2;
  s.energy_error = std::numeric_limits<double>::quiet_NaN();
  s.warnings = {"first", "second, with \t"};
  s.views = {{"slice", {{"images/slice_000000.png", 0, 0}, {"images/slice_000010.png", 1e-6, 10}}}, {"none", {}}};
  s.record("max pressure", "Pa", 0, 1e9);
  s.record("dt", "s", 0, 2e-9);
  s.record("max pressure", "Pa", 1e-6, std::numeric_limits<double>::infinity());
  s.fragment_masses = {0.25, 0.125};
  s.limits = {{1, 2, 3},
              {1e-3, 2e-3, 1e-3},
              {"damage in ball", "Courant condition", "Courant condition"},
              {{1, 2}, {}, {3, 4}}};
  s.profile = {"x", {0, 1}, {{"pressure", "Pa", {5, 6}}}};

  const Tree tree = parse(monitor_json(s, 1700000000));
  EXPECT_EQ(tree.get<std::string>("scene"), s.scene);
  EXPECT_EQ(tree.get<std::string>("state"), "stopped");
  EXPECT_EQ(tree.get<std::int64_t>("step"), s.step);
  EXPECT_EQ(tree.get<std::int64_t>("updated"), 1700000000);
  EXPECT_EQ(tree.get<double>("time_s"), 0.1 + 0.2);
  EXPECT_EQ(tree.get<std::string>("energy_error_rel"), "null");
  EXPECT_EQ(tree.get<std::string>("eta_s"), "null");
  EXPECT_EQ(tree.get_child("warnings").back().second.data(), "second, with \t");
  const Tree& slice = tree.get_child("views").front().second;
  EXPECT_EQ(slice.get<std::string>("latest"), "../images/slice_000010.png");
  EXPECT_EQ(slice.get_child("frames").size(), 2u);
  EXPECT_EQ(std::next(slice.get_child("frames").back().second.begin(), 2)->second.data(), "10");
  EXPECT_EQ(tree.get_child("views").back().second.get<std::string>("latest"), "null");
  ASSERT_EQ(tree.get_child("history").size(), 2u);
  const Tree& pressure = tree.get_child("history").front().second;
  EXPECT_EQ(pressure.get<std::string>("unit"), "Pa");
  EXPECT_EQ(pressure.get_child("values").front().second.data(), "1e+09");
  EXPECT_EQ(pressure.get_child("values").back().second.data(), "null");
  EXPECT_EQ(pressure.get_child("time").back().second.data(), "1e-06");
  const Tree& causes = tree.get_child("limits.causes");  // most frequent first
  ASSERT_EQ(causes.size(), 2u);
  EXPECT_EQ(causes.front().second.front().second.data(), "Courant condition");
  EXPECT_NEAR(std::stod(causes.front().second.back().second.data()), 2.0 / 3, 1e-6);
  const Tree& first_row = tree.get_child("limits.rows").front().second;
  EXPECT_EQ(std::next(first_row.begin(), 2)->second.data(), "1");
  EXPECT_EQ(first_row.back().second.back().second.data(), "2");
  EXPECT_EQ(tree.get_child("profile.fields").front().second.get_child("values").back().second.data(), "6");
  const Tree& lighter = tree.get_child("fragments").back().second;
  EXPECT_EQ(lighter.front().second.data(), "0.125");
  EXPECT_EQ(lighter.back().second.data(), "2");
  const Tree& prefixes = tree.get_child("prefixes");  // with which the page shows numbers
  EXPECT_EQ(prefixes.size(), si_prefixes.size());
  EXPECT_EQ(prefixes.front().second.front().second.data(), "1000000000000");
  EXPECT_EQ(prefixes.front().second.back().second.data(), "T");
}

TEST(Monitor, LongSeriesKeepTheirPeaksAndBothEnds) {
  std::vector<double> values(20011);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(1e-3 * static_cast<double>(i));
  values[777] = 50;
  values[19003] = -40;
  const std::vector<std::size_t> rows = telling_rows(values, 300);
  EXPECT_LE(rows.size(), 300u);
  EXPECT_GT(rows.size(), 250u);
  EXPECT_EQ(rows.front(), 0u);
  EXPECT_EQ(rows.back(), values.size() - 1);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end(), std::less_equal<>()));
  EXPECT_NE(std::find(rows.begin(), rows.end(), 777u), rows.end());
  EXPECT_NE(std::find(rows.begin(), rows.end(), 19003u), rows.end());
  EXPECT_EQ(telling_rows({3, 1, 2}, 4), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_LE(telling_rows(std::vector<double>(301, 1.0), 300).size(), 300u);
}

TEST(Monitor, ManyFragmentsAreThinnedOutButNotTheHeavyOnes) {
  MonitorStatus s;
  for (int rank = 1; rank <= 5000; ++rank) s.fragment_masses.push_back(0.5 / rank);
  const Tree fragments = parse(monitor_json(s, 0)).get_child("fragments");
  EXPECT_LE(fragments.size(), 300u);
  int expected = 0, previous = 0;
  for (const auto& [none, point] : fragments) {
    const int rank = std::stoi(point.back().second.data());
    EXPECT_GT(rank, previous);
    EXPECT_NEAR(std::stod(point.front().second.data()), 0.5 / rank, 1e-7);
    if (++expected <= 10) {
      EXPECT_EQ(rank, expected);
    }
    previous = rank;
  }
  EXPECT_EQ(previous, 5000);
}

TEST(Monitor, ReadsTheViewsOfTheImageIndex) {
  const auto folder = empty_folder("views");
  EXPECT_TRUE(read_views(folder).empty());
  std::filesystem::create_directories(folder / "images");
  std::ofstream(folder / "images" / "data.csv") << "time,step,view,reason,FILE\n"
                                                   "0,0,slice,frame,slice_000000.png\n"
                                                   "0,0,damage,frame,damage_000000.png\n"
                                                   "1.5e-06,20,slice,first contact,slice_000020.png\n"
                                                   "3e-06,4";  // a row being written
  const std::vector<MonitorView> views = read_views(folder);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].name, "slice");
  ASSERT_EQ(views[0].frames.size(), 2u);
  EXPECT_EQ(views[0].frames[1].file, "images/slice_000020.png");
  EXPECT_EQ(views[0].frames[1].time, 1.5e-6);
  EXPECT_EQ(views[0].frames[1].step, 20);
  EXPECT_EQ(views[0].frames[1].reason, "first contact");
  EXPECT_EQ(views[1].frames.size(), 1u);
}

TEST(Monitor, TailOfTheLogAndFilesWorthALink) {
  const auto folder = empty_folder("tail");
  EXPECT_TRUE(read_log_tail(folder, 3).empty());
  std::ofstream log(folder / "run.log");
  for (int k = 0; k < 5000; ++k) log << "line " << k << '\n';
  log.close();
  EXPECT_EQ(read_log_tail(folder, 2), (std::vector<std::string>{"line 4998", "line 4999"}));
  const auto tail = read_log_tail(folder, 100000);  // long logs are not read whole, and begin with a whole line
  EXPECT_LT(tail.size(), 5000u);
  EXPECT_TRUE(tail.front().starts_with("line "));
  std::filesystem::create_directories(folder / "figures");
  for (const char* name : {"history.csv", "control", "movie_slice.mp4", "figures/energy.png", "figures/energy.gp"})
    std::ofstream(folder / name) << "x";
  EXPECT_EQ(find_files(folder),
            (std::vector<std::string>{"movie_slice.mp4", "figures/energy.png", "history.csv", "run.log"}));
}

TEST(Monitor, WritesAtMostOnceAnIntervalUnlessForced) {
  const auto folder = empty_folder("rate");
  Monitor monitor(folder, std::chrono::milliseconds(200));
  const auto step_on_disk = [&] { return parse(text_of(folder / "monitor" / "status.json")).get<int>("step"); };
  MonitorStatus s;
  s.step = 1;
  EXPECT_TRUE(monitor.due());
  monitor.update(s);
  EXPECT_FALSE(monitor.due());
  EXPECT_EQ(step_on_disk(), 1);
  s.step = 2;
  monitor.update(s);
  EXPECT_EQ(step_on_disk(), 1);
  monitor.update(s, true);
  EXPECT_EQ(step_on_disk(), 2);
  std::this_thread::sleep_for(std::chrono::milliseconds(210));
  s.step = 3;
  monitor.update(s);
  EXPECT_EQ(step_on_disk(), 3);
}

TEST(Monitor, FilesAreReplacedWholeAndThePageNeedsNothingElse) {
  const auto folder = empty_folder("files");
  Monitor monitor(folder);
  std::vector<std::string> names;
  MonitorStatus s;
  monitor.update(s);
  std::ifstream reader(folder / "monitor" / "status.json");  // holds the old version while it is replaced
  s.step = 7;
  monitor.update(s, true);
  std::ostringstream old;
  old << reader.rdbuf();
  EXPECT_EQ(parse(old.str()).get<int>("step"), 0);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "monitor"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"index.html", "status.js", "status.json"}));
  EXPECT_EQ(text_of(folder / "monitor" / "status.js"),
            "ejecta_status(" + text_of(folder / "monitor" / "status.json") + ");\n");

  const std::string page = text_of(folder / "monitor" / "index.html");
  EXPECT_EQ(page, monitor_page());
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  std::string without_svg_name = page;
  const std::string svg_name = "http://www.w3.org/2000/svg";
  without_svg_name.erase(without_svg_name.find(svg_name), svg_name.size());
  const std::string steering = "fetch(\"/control\"";  // only where ejecta serve has given a token
  without_svg_name.erase(without_svg_name.find(steering), steering.size());
  for (const char* outside : {"http:", "https:", "@import", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(without_svg_name.find(outside), std::string::npos) << outside;
}

TEST(Monitor, UnwritablePlaceIsAnOutputError) {
  const auto folder = empty_folder("file_in_the_way");
  std::ofstream(folder / "monitor") << "not a folder";
  EXPECT_THROW(Monitor{folder}.update({}), OutputError);
}

}  // namespace
}  // namespace ejecta
