#include "output/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Csv, UnwritablePlaceIsAnOutputError) {
  EXPECT_THROW(CsvWriter(scratch("no_such_folder") / "a.csv", columns), OutputError);
  EXPECT_THROW(read_csv(scratch("missing.csv")), InputError);
}

TEST(History, HasOnlyTheColumnsThatApply) {
  const auto file = scratch("history.csv");
  {
    History gas(file, 2);
    HistoryRow row;
    row.limited_by = "courant";
    row.kinetic_energy = 2;
    row.internal_energy = 3;
    gas.write(row);
  }
  const CsvTable plain = read_csv(file);
  EXPECT_EQ(plain.find("min distension"), CsvTable::npos);
  EXPECT_EQ(plain.find("momentum z"), CsvTable::npos);
  EXPECT_EQ(plain.rows[0][plain.find("total energy")], "5");
  EXPECT_EQ(plain.unit(plain.find("kinetic energy")), "J/m");

  {
    History rock(file, 3);
    HistoryRow row;
    row.min_distension = 1.25;
    row.fragments = 12;
    rock.write(row);
  }
  {
    History resumed(file, 3, 0.0);
    HistoryRow row;
    row.time = 1;
    row.min_distension = 1.125;
    row.fragments = 13;
    resumed.write(row);
  }
  const CsvTable porous = read_csv(file);
  ASSERT_EQ(porous.rows.size(), 2u);
  EXPECT_EQ(porous.rows[1][porous.find("min distension")], "1.125");
  EXPECT_EQ(porous.rows[0][porous.find("fragments")], "12");
  EXPECT_EQ(porous.find("damaged mass fraction"), CsvTable::npos);
}

TEST(Timers, SharesAddUpToOne) {
  const auto file = scratch("timers.csv");
  const std::vector<TimerRow> timers{{"neighbours", 1.0, 10}, {"pair rates", 3.0, 20}};
  write_timers(file, timers);
  const CsvTable table = read_csv(file);
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"pair rates", "3", "20", "0.75"}));
}

}  // namespace
}  // namespace ejecta
