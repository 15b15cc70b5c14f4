#include "render/figure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "png.hpp"

namespace ejecta {
namespace {

namespace fs = std::filesystem;

class FigureTest : public testing::Test {
 protected:
  FigureTest() {
    fs::remove_all(run);
    fs::create_directories(run / "figures");
  }
  void write_data() {
    std::ofstream compaction(run / "figures/compaction.csv"), curve(run / "figures/crush_curve.csv");
    compaction << "pressure [Pa],distension [1],loading [1]\n";
    curve << "pressure [Pa],distension [1]\n";
    for (int k = 0; k <= 400; ++k) {
      const double p = 1e6 * std::pow(300, k / 400.0);
      const double alpha = p < 2.13e8 ? 1 + 2.3 * std::pow((2.13e8 - p) / (2.13e8 - 1e6), 12) : 1;
      curve << p << ',' << alpha << '\n';
      if (k % 4 == 0) compaction << p << ',' << alpha << ",1\n";
      compaction << p * std::sin(37.0 * k) << ',' << alpha << ",0\n";
    }
    std::ofstream distribution(run / "fragment_distribution.csv");
    distribution << "mass [kg],mass fraction [1],fragments at least as heavy [1]\n";
    for (int n = 1; n < 200; ++n)
      distribution << 0.1 * 0.08 * std::pow(n, -1.4) << ',' << 0.08 * std::pow(n, -1.4) << ',' << n << '\n';
    std::ofstream fragments(run / "fragments.csv"), caught(run / "fragments_measured.csv");
    fragments << "number [1],mass fraction [mass of small_target]\n";
    for (int n = 1; n < 200; ++n) fragments << n << ',' << 0.08 * std::pow(n, -1.4) << '\n';
    fragments << "0,0.7\n";  // dust
    caught << "mass [kg],fragments at least as heavy [1]\n0.02,1\n0.001,2\n";
    std::ofstream theory(run / "fragment_theory.csv");
    theory << "mass [kg],mass fraction [mass of small_target],\"Mott, fewest [1]\",\"Mott, most [1]\"\n";
    for (int k = 0; k <= 100; ++k) {
      const double share = std::pow(10, -5 + 0.05 * k), few = 20 * std::exp(-20 * share),
                   most = 300 * std::exp(-300 * share);
      theory << 0.1 * share << ',' << share << ',' << std::min(few, most) << ',' << std::max(few, most) << '\n';
    }
    std::ofstream probe(run / "probe_A.csv"), measured(run / "probe_A_measured.csv");
    probe << "time [s],velocity [m/s],pressure [Pa]\n";
    for (int k = 0; k <= 60; ++k)
      probe << k * 1e-6 << ',' << 200 * (1 - std::exp(-k / 9.0)) << ',' << 1e9 - 1e7 * k << '\n';
    measured << "time [s],velocity [m/s]\n1e-6,100\n2e-6,180\n";
    std::ofstream profile(run / "profile.csv");
    profile << "x [m],density [kg/m^3],velocity x [m/s],pressure [Pa]\n";
    for (int k = 0; k <= 60; ++k) profile << 0.01 * k << ',' << 1 + 0.1 * k << ',' << -3 * k << ",1e5\n";
    std::ofstream largest(run / "largest_fragment.csv"), history(run / "history.csv");
    largest << "time [s],largest fragment mass fraction [1],fragments [1],dust mass fraction [1]\n";
    history << "time [s],limited by,kinetic energy [J],internal energy [J],total energy [J],energy error [1]\n";
    for (int k = 0; k <= 60; ++k) {
      const double t = k * 1e-6;
      largest << t << ',' << 1 - 0.9 * (1 - std::exp(-t / 2e-5)) << ',' << 1 + 3 * k << ',' << 0.004 * k << '\n';
      history << t << ",\"courant, 7\"," << 700 - 4 * k << ',' << 4 * k << ',' << 700 << ',' << 1e-5 * k << '\n';
    }
  }
  fs::path run = fs::path(testing::TempDir()) /
                 (std::string("ejecta_figures_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FigureTest, EveryPlotIsDrawnAndNotBlank) {
  write_data();
  FigureSettings settings;
  settings.title = "Nylon ball on pumice_3d";
  settings.fragment_target = "small_target";
  settings.resolution_limit = 8e-6;
  settings.probes = {{"A", 1e-6}};
  const std::vector<Figure> figures = make_figures(run, settings);
  ASSERT_EQ(figures.size(), 7u);
  for (const Figure& figure : figures) {
    EXPECT_EQ(figure.problem, "") << figure.file;
    EXPECT_TRUE(fs::exists(fs::path(figure.file).replace_extension(".gp")));
    const Png png = read_png(figure.file);
    EXPECT_EQ(png.width, 1120);
    EXPECT_GT(png.colours(), 50u) << figure.file;
  }
}

/// How many pixels are a colour of gnuplot's that covers a share of white.
int pixels_covered(const Png& png, std::uint32_t colour, double share) {
  int count = 0;
  for (const std::uint32_t pixel : png.rgb) {
    bool alike = true;
    for (const int shift : {0, 8, 16}) {
      const double expected = 255 + share * ((colour >> shift & 0xFF) - 255.0);
      alike = alike && std::abs((pixel >> shift & 0xFF) - expected) < 3;
    }
    count += alike;
  }
  return count;
}

TEST_F(FigureTest, TheoriesAreBands) {
  write_data();
  FigureSettings settings;
  settings.fragment_target = "small_target";
  const fs::path file = run / "figures/fragment_distribution.png";
  make_figures(run, settings);
  EXPECT_GT(pixels_covered(read_png(file), 0x8a226a, 0.22), 20000);
  fs::remove(run / "fragment_theory.csv");
  make_figures(run, settings);
  EXPECT_EQ(pixels_covered(read_png(file), 0x8a226a, 0.22), 0);
}

TEST_F(FigureTest, PlotsWithoutDataAreLeftOut) {
  EXPECT_TRUE(make_figures(run, {}).empty());
  std::ofstream(run / "largest_fragment.csv") << "time [s],largest fragment mass fraction [1]\n";  // header only
  EXPECT_TRUE(make_figures(run, {}).empty());
  std::ofstream(run / "fragments.csv") << "number [1],mass fraction [mass of target]\n1,0\n0,1\n";  // of another body
  std::ofstream(run / "fragment_distribution.csv") << "mass [kg],mass fraction [1],fragments at least as heavy [1]\n";
  EXPECT_TRUE(make_figures(run, {}).empty());
}

TEST_F(FigureTest, WithoutGnuplotEachPlotSaysSo) {
  write_data();
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/no_such_folder", 1);
  const std::vector<Figure> figures = make_figures(run, {});
  setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(figures.size(), 6u);
  for (const Figure& figure : figures) EXPECT_EQ(figure.problem, "gnuplot is not installed");
}

}  // namespace
}  // namespace ejecta
