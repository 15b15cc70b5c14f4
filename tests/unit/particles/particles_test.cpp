#include "particles/particles.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ejecta {
namespace {

TEST(FieldCatalogue, IsInTheOrderOfTheEnumerationWithUniqueNames) {
  std::set<std::string_view> names;
  for (int f = 0; f < field_count; ++f) {
    const FieldInfo& entry = field_catalogue()[static_cast<std::size_t>(f)];
    EXPECT_EQ(static_cast<int>(entry.field), f) << entry.name;
    EXPECT_FALSE(entry.unit.empty()) << entry.name;
    names.insert(entry.name);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(field_count));
}

TEST(FieldCatalogue, KnowsComponentsByShapeAndDimension) {
  EXPECT_EQ(components(Shape::scalar, 3), 1);
  EXPECT_EQ(components(Shape::vector, 2), 2);
  EXPECT_EQ(components(Shape::tensor, 3), 9);
  EXPECT_EQ(components(Shape::tensor, 2), 4);
  EXPECT_EQ(components(Shape::deviator, 3), deviator_size<3>);
  EXPECT_EQ(components(Shape::deviator, 2), deviator_size<2>);
}

TEST(Particles, HaveTheFieldsAskedForAndTheBasicFour) {
  Particles<3> p;
  const std::array fields{Field::density, Field::compression_rate};
  p.allocate(100, fields);
  EXPECT_EQ(p.fields(), (std::vector<Field>{Field::position, Field::velocity, Field::acceleration, Field::mass,
                                            Field::density, Field::compression_rate}));
  EXPECT_FALSE(p.has(Field::damage));
  EXPECT_EQ(p.column(Field::position, 2).size(), 100u);
  EXPECT_EQ(p.previous(Field::compression_rate).size(), 100u);
  EXPECT_EQ(p.expected(Field::compression_rate).size(), 100u);
}

TEST(Particles, CostTheBytesOfTheirColumnsAlone) {
  Particles<3> p;
  p.allocate(1000, {});
  // position, velocity, acceleration now and before, mass; one column of scratch; three labels and scratch
  EXPECT_EQ(p.bytes(), 1000 * ((3 + 3 + 6 + 1 + 1) * sizeof(double) + 4 * sizeof(std::int32_t)));
  const std::size_t before = p.bytes();
  const std::array fields{Field::deviatoric_stress, Field::stress_rate};
  p.allocate(1000, fields);
  EXPECT_EQ(p.bytes(), before + 1000 * (5 + 3 * 5) * sizeof(double));
}

TEST(Particles, SwapRatesExchangesPresentAndPreviousOfEveryRate) {
  Particles<2> p;
  const std::array fields{Field::density, Field::compression_rate};
  p.allocate(3, fields);
  p.column(Field::acceleration, 1)[2] = 5;
  p.column(Field::compression_rate)[0] = 7;
  p.column(Field::density)[0] = 9;
  p.swap_rates();
  EXPECT_EQ(p.previous(Field::acceleration, 1)[2], 5);
  EXPECT_EQ(p.column(Field::acceleration, 1)[2], 0);
  EXPECT_EQ(p.previous(Field::compression_rate)[0], 7);
  EXPECT_EQ(p.column(Field::density)[0], 9);
}

TEST(Particles, ReorderMovesEveryColumnAndLabel) {
  Particles<2> p;
  const std::array fields{Field::compression_rate};
  p.allocate(3, fields);
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = static_cast<double>(i);
    p.set_vector(Field::position, i, Vec<2>(value, 10 + value));
    p.column(Field::compression_rate)[i] = 20 + value;
    p.previous(Field::compression_rate)[i] = 30 + value;
    p.expected(Field::compression_rate)[i] = 35 + value;
    p.label(Label::body)[i] = 40 + static_cast<int>(i);
  }
  const std::array<std::uint32_t, 3> order{2, 0, 1};
  p.reorder(order);
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = order[i];
    EXPECT_EQ(p.vector(Field::position, i), Vec<2>(value, 10 + value));
    EXPECT_EQ(p.column(Field::compression_rate)[i], 20 + value);
    EXPECT_EQ(p.previous(Field::compression_rate)[i], 30 + value);
    EXPECT_EQ(p.expected(Field::compression_rate)[i], 35 + value);
    EXPECT_EQ(p.label(Label::body)[i], 40 + static_cast<int>(order[i]));
  }
}

}  // namespace
}  // namespace ejecta
