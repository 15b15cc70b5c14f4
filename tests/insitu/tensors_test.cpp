/// Tensors leave in the order in which VTK reads them: its eigenvectors are ours.
#include <gtest/gtest.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTensorGlyph.h>

#include <array>

#include "insitu/stretched_rod.hpp"
#include "insitu/vtk_channels.hpp"
#include "observe/channels.hpp"

namespace ejecta {
namespace {

template <int Dim>
Particles<Dim> turned_particles() {
  const std::array fields{Field::velocity, Field::density, Field::deviatoric_stress, Field::damage_tensor};
  Particles<Dim> p;
  p.allocate(20, fields);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double s = static_cast<double>(i + 1);
    Mat<Dim> turn = Mat<Dim>::Identity();
    if constexpr (Dim == 2)
      turn = Eigen::Rotation2Dd(0.3 * s).toRotationMatrix();
    else
      turn = Eigen::AngleAxisd(0.3 * s, Vec<3>(1, -2, 0.5 * s).normalized()).toRotationMatrix();
    Vec<Dim> values;
    for (int a = 0; a < Dim; ++a) values[a] = 0.9 / (1 + a);
    p.set_symmetric(Field::damage_tensor, i, turn * values.asDiagonal() * turn.transpose());
    for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::deviatoric_stress, k)[i] = s * (k + 1);
    for (int a = 0; a < Dim; ++a) {
      p.column(Field::position, a)[i] = s + a;
      p.column(Field::velocity, a)[i] = s * (a + 1);
    }
  }
  return p;
}

template <int Dim>
void expect_the_same_eigenvectors() {
  const Particles<Dim> p = turned_particles<Dim>();
  FrameChannels<Dim> channels;
  VtkChannels wrapper;
  const auto data = wrapper.wrap(channels.particles(p, std::nullopt));
  vtkDataArray* tensor = data->GetPointData()->GetArray("damage_tensor");
  ASSERT_EQ(tensor->GetNumberOfComponents(), 6);
  EXPECT_STREQ(tensor->GetComponentName(4), "YZ");
  // The glyph of a tensor is its eigenvalues times eigenvectors: of a line along x the largest one.
  vtkNew<vtkLineSource> line;
  line->SetPoint1(0, 0, 0);
  line->SetPoint2(1, 0, 0);
  vtkNew<vtkTensorGlyph> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "damage_tensor");
  glyphs->SetSourceConnection(line->GetOutputPort());
  glyphs->ExtractEigenvaluesOn();
  glyphs->ColorGlyphsOff();
  glyphs->Update();
  vtkDataArray* ours = data->GetPointData()->GetArray("damage_axis_1");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    double base[3], end[3], axis[3];
    glyphs->GetOutput()->GetPoint(2 * i, base);
    glyphs->GetOutput()->GetPoint(2 * i + 1, end);
    ours->GetTuple(i, axis);
    const Vec<3> theirs(end[0] - base[0], end[1] - base[1], end[2] - base[2]), mine(axis[0], axis[1], axis[2]);
    EXPECT_NEAR(mine.norm(), 0.9, 1e-12);
    EXPECT_LT(std::min((theirs - mine).norm(), (theirs + mine).norm()), 1e-5) << i;  // VTK's points are single
  }
}

TEST(Tensors, HaveTheEigenvectorsThatVtkFinds) {
  expect_the_same_eigenvectors<2>();
  expect_the_same_eigenvectors<3>();
}

TEST(Tensors, TheDeviatorHasAllSixComponents) {
  const auto expect = []<int Dim>(const Particles<Dim>& p, std::array<double, 6> first) {
    FrameChannels<Dim> channels;
    VtkChannels wrapper;
    const auto data = wrapper.wrap(channels.particles(p, std::nullopt));
    vtkDataArray* stress = data->GetPointData()->GetArray("deviatoric_stress");
    ASSERT_EQ(stress->GetNumberOfComponents(), 6);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(stress->GetComponent(0, k), first[static_cast<std::size_t>(k)]) << k;
  };
  expect(turned_particles<2>(), {1, 2, -3, 3, 0, 0});
  expect(turned_particles<3>(), {1, 2, -3, 3, 5, 4});  // ours: xx, yy, xy, xz, yz
}

TEST(Vectors, HaveThreeComponentsInThePlaneToo) {
  const Particles<2> p = turned_particles<2>();
  FrameChannels<2> channels;
  VtkChannels wrapper;
  const auto data = wrapper.wrap(channels.particles(p, std::nullopt));
  vtkDataArray* velocity = data->GetPointData()->GetArray("velocity");
  ASSERT_EQ(velocity->GetNumberOfComponents(), 3);
  EXPECT_EQ(velocity->GetComponent(3, 1), 8);
  EXPECT_EQ(velocity->GetComponent(3, 2), 0);
  std::vector<double> u{1, 2}, v{3, 4};
  Channel image;
  image.name = "slice";
  image.kind = ChannelKind::image;
  image.extent = {2, 1, 1};
  image.fields = {{"velocity", "m/s", {u, v}}};
  EXPECT_EQ(wrapper.wrap(image)->GetPointData()->GetArray("velocity")->GetNumberOfComponents(), 3);
}

}  // namespace
}  // namespace ejecta
