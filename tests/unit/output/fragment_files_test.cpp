#include "output/fragment_files.hpp"

#include <gtest/gtest.h>

#include "render/csv_table.hpp"

namespace ejecta {
namespace {

/// Three fragments with a quarter from the target, two of equal mass, one of the ball alone, and some dust.
FragmentTable example() {
  FragmentTable table;
  for (const double mass : {6.0, 1.0, 1.0}) {
    Fragment f;
    f.number = static_cast<std::int32_t>(table.fragments.size()) + 4;
    f.carried.particles = 10;
    f.carried.mass = mass;
    f.mass_by_body = {0.25 * mass, 0.75 * mass};
    f.mass_by_material = {mass};
    f.centre = {1, 2, 3};
    f.velocity = {4, 5, 6};
    f.spin = {7, 8, 9};
    f.semi_axes = {3, 2, 1};
    table.fragments.push_back(f);
  }
  Fragment ball = table.fragments[0];
  ball.number = 7;
  ball.mass_by_body = {0, 6.0};
  table.fragments.push_back(ball);
  table.dust = {4, 2.0, {2, 0, -4}, {0, 0, 0}};
  table.dust_mass_by_body = {0.5, 1.5};
  return table;
}

class FragmentFilesTest : public testing::Test {
 protected:
  std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string("ejecta_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
  FragmentContext context{3, {"target", "ball"}, {"pumice", "nylon"}, {2.5, 13.5}, 0};
};

TEST_F(FragmentFilesTest, TableListsFragmentsThenDust) {
  write_fragments(file, example(), context);
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 5u);
  const auto cell = [&](std::size_t row, const char* name) { return table.rows[row].at(table.find(name)); };
  EXPECT_EQ(cell(0, "number"), "4");
  EXPECT_EQ(cell(0, "mass fraction"), "0.6");
  EXPECT_EQ(cell(3, "mass fraction"), "0");
  EXPECT_EQ(table.unit(table.find("mass fraction")), "mass of target");
  EXPECT_EQ(cell(0, "mass of ball"), "4.5");
  EXPECT_EQ(cell(0, "mass of material nylon"), "0");
  EXPECT_EQ(cell(0, "velocity z"), "6");
  EXPECT_EQ(cell(0, "spin x"), "7");
  EXPECT_EQ(cell(0, "semi-axis c"), "1");
  EXPECT_EQ(cell(4, "number"), "0");
  EXPECT_EQ(cell(4, "mass"), "2");
  EXPECT_EQ(cell(4, "mass fraction"), "0.2");
  EXPECT_EQ(cell(4, "mass of ball"), "1.5");
  EXPECT_EQ(cell(4, "velocity z"), "-2");
  EXPECT_EQ(cell(4, "spin x"), "");
  EXPECT_EQ(table.unit(table.find("semi-axis a")), "m");
}

TEST_F(FragmentFilesTest, DistributionCountsEqualMassesOnce) {
  write_fragment_distribution(file, example(), context);
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"1.5", "0.6", "1"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"0.25", "0.1", "3"}));
}

TEST_F(FragmentFilesTest, EveryBodyIsMeasuredInItsOwnMass) {
  const std::vector<BodyFragments> bodies = fragments_by_body(example(), context);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0].fragments, 3);
  EXPECT_EQ(bodies[1].fragments, 4);
  EXPECT_DOUBLE_EQ(bodies[0].largest_mass_fraction, 0.6);
  EXPECT_DOUBLE_EQ(bodies[1].largest_mass_fraction, 6 / 13.5);
  EXPECT_DOUBLE_EQ(bodies[1].dust_mass_fraction, 1.5 / 13.5);
}

TEST_F(FragmentFilesTest, LargestFragmentHistoryResumes) {
  {
    LargestFragmentHistory history(file, context);
    history.write(0, example());
    history.write(2, example());
  }
  LargestFragmentHistory history(file, context, 1.0);
  history.write(1.5, FragmentTable{});
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"0", "0.6", "4", "0.2"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"1.5", "0", "0", "0"}));
}

TEST_F(FragmentFilesTest, CompactionKeepsPressureAndFlag) {
  const std::vector<double> p{1e6, -2e5}, alpha{3.25, 1.5};
  const std::vector<std::int32_t> loading{1, 0};
  write_compaction(file, p, alpha, loading);
  const CsvTable table = read_csv(file);
  EXPECT_EQ(std::stod(table.rows[1][0]), -2e5);
  EXPECT_EQ(table.rows[0][1], "3.25");
  EXPECT_EQ(table.rows[1][2], "0");
  write_crush_curve(file, p, alpha);
  EXPECT_EQ(read_csv(file).columns.size(), 2u);
}

}  // namespace
}  // namespace ejecta
