#include "observe/peak_of_matter.hpp"

#include <gtest/gtest.h>

#include <array>

namespace ejecta {
namespace {

/// A square of 6 x 6 particles, 1 m apart, of body 0; all have seen 1 Pa.
Particles<2> square() {
  Particles<2> p;
  p.allocate(36, std::array{Field::initial_position, Field::pressure_peak});
  for (std::size_t i = 0; i < 36; ++i) {
    p.column(Field::initial_position, 0)[i] = static_cast<double>(i % 6);
    p.column(Field::initial_position, 1)[i] = static_cast<double>(i / 6);
    p.column(Field::pressure_peak)[i] = 1;
    p.label(Label::body)[i] = 0;
  }
  return p;
}

TEST(PeakOfMatter, IsNotThatOfAParticleOnItsOwn) {
  Particles<2> p = square();
  p.column(Field::pressure_peak)[14] = 100;
  EXPECT_EQ(peak_of_matter(p, 0, 1.5), 1);
}

TEST(PeakOfMatter, IsWhatTwoSideBySideHaveSeen) {
  Particles<2> p = square();
  const auto peak = p.column(Field::pressure_peak);
  peak[14] = 100, peak[17] = 90, peak[20] = 80;  // the second is not beside the first
  EXPECT_EQ(peak_of_matter(p, 0, 1.5), 80);
  p.label(Label::body)[20] = 1;
  EXPECT_EQ(peak_of_matter(p, 0, 1.5), 1);
}

TEST(PeakOfMatter, OfASmallBodyIsThatOfAllItsParticles) {
  Particles<2> p = square();
  p.label(Label::body)[3] = 1;
  p.column(Field::pressure_peak)[3] = 7;
  EXPECT_EQ(peak_of_matter(p, 1, 1.5), 7);
}

}  // namespace
}  // namespace ejecta
