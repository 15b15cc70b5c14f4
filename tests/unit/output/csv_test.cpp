#include "output/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "output/history.hpp"
#include "render/csv_table.hpp"

namespace ejecta {
namespace {

std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "ejecta_csv";
  std::filesystem::create_directories(folder);
  return folder / name;  // every test uses a name of its own
}

const std::vector<CsvColumn> columns{{"time", "s"}, {"step", "1"}, {"reason", ""}};

TEST(Csv, RoundTripKeepsEveryBitAndQuotes) {
  const auto file = scratch("round_trip.csv");
  CsvWriter writer(file, columns);
  writer.row(std::vector<CsvCell>{0.1 + 0.2, std::int64_t{7}, std::string("Courant, \"iron\"")});
  writer.row(std::vector<CsvCell>{std::nan(""), std::int64_t{-8}, std::string("")});
  const CsvTable table = read_csv(file);  // readable while the writer is still open
  EXPECT_EQ(table.columns, (std::vector<std::string>{"time [s]", "step [1]", "reason"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(std::stod(table.rows[0][0]), 0.1 + 0.2);
  EXPECT_EQ(table.rows[0][2], "Courant, \"iron\"");
  EXPECT_EQ(table.rows[1][0], "");
  EXPECT_EQ(table.find("step"), 1u);
  EXPECT_EQ(table.unit(0), "s");
  EXPECT_EQ(table.find("absent"), CsvTable::npos);
}

TEST(Csv, ResumeDropsLaterRowsAndTornLines) {
  const auto file = scratch("resume.csv");
  {
    CsvWriter writer(file, columns);
    for (int k = 0; k < 5; ++k) writer.row(std::vector<CsvCell>{k * 1e-6, std::int64_t{k}, std::string("x")});
  }
  std::ofstream(file, std::ios::app) << "5e-07,9";  // cut off while writing
  CsvWriter resumed(file, columns, 2e-6);
  resumed.row(std::vector<CsvCell>{2.5e-6, std::int64_t{99}, std::string("y")});
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[2][1], "2");
  EXPECT_EQ(table.rows[3][1], "99");
}

TEST(Csv, ResumesAFileOfOtherColumnsByTheirNames) {
  const auto file = scratch("other_columns.csv"), aside = scratch("other_columns.csv.aside");
  for (const char* end : {"", ".aside", ".aside2"}) std::filesystem::remove(file.string() + end);
  {
    CsvWriter writer(file, columns);
    for (int k = 0; k < 3; ++k) writer.row(std::vector<CsvCell>{1.0 * k, std::int64_t{k}, std::string("a, b")});
  }
  const std::vector<CsvColumn> more{{"time", "s"}, {"reason", ""}, {"dt", "s"}, {"step", "1"}};
  CsvWriter(file, more, 1).row(std::vector<CsvCell>{1.5, std::string("c"), 0.5, std::int64_t{9}});
  CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"1", "a, b", "", "1"}));
  EXPECT_EQ(table.rows[2], (std::vector<std::string>{"1.5", "c", "0.5", "9"}));
  EXPECT_FALSE(std::filesystem::exists(aside));  // nothing was lost
  const std::vector<CsvColumn> fewer{{"time", "s"}, {"dt", "s"}};
  for (int k = 0; k < 2; ++k) {
    CsvWriter(file, k == 0 ? fewer : columns, 2)
        .row(k == 0 ? std::vector<CsvCell>{3.0, 1.0} : std::vector<CsvCell>{4.0, std::int64_t{1}, std::string()});
  }
  EXPECT_EQ(read_csv(file).rows.size(), 4u);
  EXPECT_EQ(read_csv(aside).columns.size(), more.size());
  EXPECT_EQ(read_csv(aside).rows.size(), 3u);
  EXPECT_EQ(read_csv(file.string() + ".aside2").columns.size(), fewer.size());
}

TEST(Csv, UnwritablePlaceIsAnOutputError) {
  const auto in_the_way = scratch("a_file");
  std::ofstream(in_the_way) << "no folder";
  CsvWriter writer(in_the_way / "a.csv", columns);
  EXPECT_THROW(writer.row(std::vector<CsvCell>{0.0, std::int64_t{0}, std::string("x")}), OutputError);
  EXPECT_THROW(read_csv(scratch("missing.csv")), InputError);
}

TEST(Csv, RowsThatCouldNotBeWrittenComeWithTheNext) {
  const auto folder = scratch("comes_and_goes"), file = folder / "a.csv";
  std::filesystem::remove_all(folder);
  CsvWriter writer(file, columns);
  const auto row = [&](int k) { writer.row(std::vector<CsvCell>{1.0 * k, std::int64_t{k}, std::string("x")}); };
  row(0);
  std::filesystem::remove_all(folder);
  std::ofstream(folder) << "a file in the way";
  EXPECT_THROW(row(1), OutputError);
  EXPECT_THROW(row(2), OutputError);
  std::filesystem::remove(folder);
  row(3);
  row(4);
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(table.rows[k][1], std::to_string(k));
}

TEST(History, HasAColumnForEachQuantityAndGoesOnAfterARestart) {
  const auto file = scratch("history.csv");
  auto row = [](double time, double alpha) {
    return Quantities{{"time", "s", time, ""},
                      {"step", "1", std::int64_t{12}, ""},
                      {"limited by", "", std::string("Courant condition"), ""},
                      {"min distension", "1", alpha, ""}};
  };
  {
    History history(file);
    history.write(row(0, 1.25));
    history.write(row(2, 1.5));
  }
  {
    History resumed(file, 1.0);
    resumed.write(row(1.5, 1.125));
  }
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.unit(table.find("time")), "s");
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"1.5", "12", "Courant condition", "1.125"}));
}

TEST(Timers, SharesAddUpToOne) {
  const auto file = scratch("timers.csv");
  const std::vector<StageTimers::Entry> timers{{"neighbours", 1.0, 10}, {"pair rates", 3.0, 20}};
  write_timers(file, timers);
  const CsvTable table = read_csv(file);
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"pair rates", "3", "20", "0.75"}));
}

}  // namespace
}  // namespace ejecta
