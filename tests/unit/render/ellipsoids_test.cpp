#include "render/ellipsoids.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace ejecta {
namespace {

const OwnedField& field(const std::vector<OwnedField>& fields, const std::string& name) {
  for (const OwnedField& f : fields)
    if (f.name == name) return f;
  throw std::runtime_error("no field " + name);
}

template <int Dim>
Vec<Dim> vector_of(const OwnedField& f, std::size_t i) {
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = f.components[static_cast<std::size_t>(a)][i];
  return v;
}

template <int Dim>
Mat<Dim> some_turn() {
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(0.7).toRotationMatrix();
  else
    return Eigen::AngleAxisd(0.7, Vec<3>(1, -2, 0.5).normalized()).toRotationMatrix();
}

template <int Dim>
Vec<Dim> halving(double first) {
  Vec<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = first / (1 << k);
  return v;
}

/// One particle with semi-axes 4, 2(, 1) and damage 0.8, 0.4(, 0.2) along turned axes.
template <int Dim>
void expect_principal_axes() {
  Particles<Dim> p;
  p.allocate(1, std::array{Field::density, Field::smoothing_length, Field::smoothing_metric, Field::damage,
                           Field::damage_tensor});
  const Mat<Dim> turn = some_turn<Dim>();
  const Vec<Dim> axes = halving<Dim>(4), damage = halving<Dim>(0.8);
  p.set_symmetric(Field::smoothing_metric, 0, turn * axes.cwiseAbs2().cwiseInverse().asDiagonal() * turn.transpose());
  p.set_symmetric(Field::damage_tensor, 0, turn * damage.asDiagonal() * turn.transpose());
  p.column(Field::damage)[0] = 0.8;
  p.label(Label::id)[0] = 5;
  const Ellipsoids e = find_ellipsoids(p, 0, 2);
  ASSERT_EQ(e.id, std::vector<std::int32_t>{5});
  for (int k = 0; k < Dim; ++k) {
    const std::string number = std::to_string(k + 1);
    const Vec<Dim> axis = vector_of<Dim>(field(e.fields, "axis_" + number), 0);
    EXPECT_NEAR(axis.norm(), axes[k], 1e-12);
    EXPECT_NEAR(std::abs(axis.dot(turn.col(k))), axes[k], 1e-12);
    const Vec<Dim> across = vector_of<Dim>(field(e.fields, "damage_axis_" + number), 0);
    EXPECT_NEAR(field(e.fields, "damage_" + number).components[0][0], damage[k], 1e-12);
    EXPECT_NEAR(std::abs(across.dot(turn.col(k))), damage[k], 1e-12);
  }
  EXPECT_NEAR(field(e.fields, "aspect").components[0][0], axes[0] / axes[Dim - 1], 1e-12);
  EXPECT_EQ(field(e.fields, "damage").components[0][0], 0.8);
  EXPECT_NEAR(field(tensor_fields(p), "aspect").components[0][0], axes[0] / axes[Dim - 1], 1e-12);
  if (Dim == 2) {
    EXPECT_NEAR(field(e.fields, "orientation").components[0][0], 0.7, 1e-12);
  }
}

TEST(Ellipsoids, HavePrincipalAxesOfSmoothingAndDamage) {
  expect_principal_axes<2>();
  expect_principal_axes<3>();
}

TEST(Ellipsoids, AreRoundInSph) {
  Particles<3> p;
  p.allocate(1, std::array{Field::density, Field::smoothing_length});
  p.column(Field::smoothing_length)[0] = 0.3;
  const Ellipsoids e = find_ellipsoids(p, 0, 1.3);
  for (const char* axis : {"axis_1", "axis_2", "axis_3"})
    EXPECT_NEAR(vector_of<3>(field(e.fields, axis), 0).norm(), 0.3, 1e-14);
  EXPECT_DOUBLE_EQ(field(e.fields, "aspect").components[0][0], 1);
  EXPECT_TRUE(tensor_fields(p).empty());
}

TEST(Ellipsoids, OfALatticeOneLayerIsShownWhereverThePlaneLies) {
  constexpr int n = 6;
  for (const double shift : {0.0, 0.5, 0.3}) {
    Particles<3> p;
    p.allocate(n * n * n, std::array{Field::density, Field::smoothing_length});
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto k = static_cast<int>(i);
      // By round-off off its place.
      p.set_vector(Field::position, i, Vec<3>(k % n, (k / n % n - 3 + shift) + 1e-14 * (k % 3 - 1), k / n / n));
      p.column(Field::smoothing_length)[i] = 1.3;
    }
    EXPECT_EQ(find_ellipsoids(p, 0, 1.3).id.size(), static_cast<std::size_t>(n * n)) << shift;
  }
}

TEST(Ellipsoids, LeaveOutBrokenMetrics) {
  Particles<2> p;
  p.allocate(3, std::array{Field::density, Field::smoothing_length, Field::smoothing_metric});
  p.set_symmetric(Field::smoothing_metric, 0, Mat<2>::Identity());
  p.set_symmetric(Field::smoothing_metric, 1, -Mat<2>::Identity());
  p.set_symmetric(Field::smoothing_metric, 2, Mat<2>::Constant(std::nan("")));
  const Channel channel = find_ellipsoids(p, 0, 1.3).channel("ellipsoids");
  EXPECT_EQ(channel.count, 1u);
  for (const FieldView& f : channel.fields)
    for (const auto& component : f.components) EXPECT_EQ(component.size(), 1u) << f.name;
}

}  // namespace
}  // namespace ejecta
