#include "analysis/fragment_theory.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ejecta {
namespace {

TEST(FragmentTheory, SpacingsAreThoseOfTheExpandingTube) {
  // Steel at 1.5e4 /s, worked out by hand: (2 * 0.6e9/(7900 * 10))^(1/2)/1.5e4 and (24 * 2e4/(7900 * 2.25e8))^(1/3).
  EXPECT_NEAR(mott_spacing(0.6e9, 10, 7900, 1.5e4), 8.2165e-3, 1e-6);
  EXPECT_NEAR(mott_spacing(0.6e9, 1000, 7900, 1.5e4), 0.82165e-3, 1e-7);
  EXPECT_NEAR(grady_spacing(2e4, 7900, 1.5e4), 6.4637e-3, 1e-6);
  EXPECT_NEAR(grady_spacing(2e4, 7900, 8 * 1.5e4), 6.4637e-3 / 4, 1e-6);
}

/// Mass and number of all pieces, from N(m) itself.
TEST(FragmentTheory, PiecesAddUpToTheWhole) {
  for (const int cuts : {1, 2}) {
    const double whole = 5, mean = 0.02;
    EXPECT_DOUBLE_EQ(pieces_at_least(0, mean, whole, cuts), 250);
    double mass = 0;
    const double step = 1e-5;
    for (double m = 0.5 * step; m < 400 * mean; m += step) mass += pieces_at_least(m, mean, whole, cuts) * step;
    EXPECT_NEAR(mass, whole, 1e-3 * whole) << cuts;  // the integral of N over m is that of m over -dN
  }
  EXPECT_NEAR(pieces_at_least(0.03, 0.03, 3, 1), 100 * std::exp(-1), 1e-12);
  EXPECT_NEAR(pieces_at_least(0.03, 0.03, 3, 2), 100 * std::exp(-std::sqrt(2)), 1e-12);
}

TEST(FragmentTheory, ABandHoldsEveryMeanOfItsRange) {
  for (const int dimension : {2, 3}) {
    const FragmentPrediction prediction{"Mott", 0.01, 0.09};
    for (const double mass : {0.001, 0.01, 0.03, 0.1, 0.3}) {
      const PieceRange band = pieces_at_least(mass, prediction, 4, dimension);
      double fewest = 1e300, most = 0;
      for (double mean = 0.01; mean <= 0.09 + 1e-9; mean += 1e-5) {
        const double pieces = pieces_at_least(mass, mean, 4, dimension - 1);
        fewest = std::min(fewest, pieces);
        most = std::max(most, pieces);
      }
      EXPECT_NEAR(band.fewest, fewest, 1e-3 * fewest) << dimension << " " << mass;
      EXPECT_NEAR(band.most, most, 1e-6 * most) << dimension << " " << mass;
    }
  }
}

TEST(FragmentTheory, PredictsWhatTheSceneStates) {
  FragmentTheory theory;
  EXPECT_TRUE(predict_fragments(theory, 7900, 2).empty());
  theory.strain_rate = 1.5e4;
  theory.thickness = 2e-3;
  theory.fracture_energy = {1e4, 5e4};
  theory.flow_stress = {0.5e9, 0.6e9};
  theory.mott_gamma = {10, 100};
  const auto in_plane = predict_fragments(theory, 7900, 2), in_space = predict_fragments(theory, 7900, 3);
  ASSERT_EQ(in_plane.size(), 2u);
  EXPECT_EQ(in_plane[0].who, "Mott");
  EXPECT_DOUBLE_EQ(in_plane[0].lightest, 7900 * 2e-3 * mott_spacing(0.5e9, 100, 7900, 1.5e4));
  EXPECT_DOUBLE_EQ(in_plane[0].heaviest, 7900 * 2e-3 * mott_spacing(0.6e9, 10, 7900, 1.5e4));
  EXPECT_DOUBLE_EQ(in_space[1].heaviest, 7900 * 2e-3 * std::pow(grady_spacing(5e4, 7900, 1.5e4), 2));
  theory.fracture_energy = {2e4};
  const auto one = predict_fragments(theory, 7900, 2)[1];
  EXPECT_EQ(one.lightest, one.heaviest);
}

}  // namespace
}  // namespace ejecta
