#include "insitu/vtk_channels.hpp"

#include <gtest/gtest.h>
#include <vtkAOSDataArrayTemplate.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSOADataArrayTemplate.h>

#include "insitu/shattered_ball.hpp"

namespace ejecta {
namespace {

using Columns = vtkSOADataArrayTemplate<double>;
using Column = vtkAOSDataArrayTemplate<double>;

TEST(VtkChannels, PointsAndFieldsAreNotCopied) {
  const ShatteredBall ball(200, 5, 8, 0.3);
  VtkChannels wrapper;
  const auto data = wrapper.wrap(ball.particles());
  auto* places = Columns::FastDownCast(vtkPointSet::SafeDownCast(data)->GetPoints()->GetData());
  ASSERT_NE(places, nullptr);
  EXPECT_EQ(places->GetComponentArrayPointer(0), ball.x.data());
  EXPECT_EQ(places->GetComponentArrayPointer(2), ball.z.data());
  auto* velocity = Columns::FastDownCast(data->GetPointData()->GetArray("velocity"));
  ASSERT_NE(velocity, nullptr);
  EXPECT_EQ(velocity->GetComponentArrayPointer(1), ball.vy.data());
  auto* damage = Column::FastDownCast(data->GetPointData()->GetArray("damage"));
  ASSERT_NE(damage, nullptr);
  EXPECT_EQ(damage->GetPointer(0), ball.damage.data());
  auto* number = vtkIntArray::SafeDownCast(data->GetPointData()->GetArray("fragment_number"));
  ASSERT_NE(number, nullptr);
  EXPECT_EQ(number->GetPointer(0), ball.fragment.data());
}

TEST(VtkChannels, EveryPointHasAVertexAndTheyAreKeptBetweenFrames) {
  const ShatteredBall ball(200, 5, 8, 0.3);
  VtkChannels wrapper;
  const auto first = wrapper.wrap(ball.particles()), second = wrapper.wrap(ball.particles());
  EXPECT_EQ(first->GetNumberOfCells(), static_cast<vtkIdType>(ball.count()));
  EXPECT_EQ(vtkPolyData::SafeDownCast(first)->GetVerts(), vtkPolyData::SafeDownCast(second)->GetVerts());
}

TEST(VtkChannels, AnImageKeepsPlaceSpacingAndData) {
  const ShatteredBall ball(200, 5, 8, 0.3);
  const auto data = VtkChannels().wrap(ball.slice());
  auto* image = vtkImageData::SafeDownCast(data);
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->GetDimensions()[2], 8);
  EXPECT_DOUBLE_EQ(image->GetOrigin()[0], -1.5 * ShatteredBall::radius);
  auto* pressure = Column::FastDownCast(image->GetPointData()->GetArray("pressure"));
  ASSERT_NE(pressure, nullptr);
  EXPECT_EQ(pressure->GetPointer(0), ball.slice_pressure.data());
}

TEST(VtkChannels, AnEmptyChannelIsAnEmptyDataSet) {
  Channel nothing;
  nothing.name = "fragments";
  nothing.fields = {{"mass", "kg", {std::span<const double>()}}};
  EXPECT_EQ(VtkChannels().wrap(nothing)->GetNumberOfPoints(), 0);
}

}  // namespace
}  // namespace ejecta
