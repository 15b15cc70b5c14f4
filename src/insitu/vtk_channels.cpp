#include "insitu/vtk_channels.hpp"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <span>

namespace ejecta {
namespace {

constexpr bool keep_ownership = true;  // VTK must not free the columns

/// VTK's arrays take pointers to mutable values; the pipelines only read them.
template <class T>
T* mutable_data(std::span<const T> values) {
  return const_cast<T*>(values.data());
}

vtkSmartPointer<vtkDataArray> wrap_columns(std::span<const std::span<const double>> columns) {
  const auto size = static_cast<vtkIdType>(columns.front().size());
  if (columns.size() == 1) {
    auto array = vtkSmartPointer<vtkAOSDataArrayTemplate<double>>::New();
    array->SetArray(mutable_data(columns.front()), size, keep_ownership);
    return array;
  }
  auto array = vtkSmartPointer<vtkSOADataArrayTemplate<double>>::New();
  array->SetNumberOfComponents(static_cast<int>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
    array->SetArray(static_cast<int>(c), mutable_data(columns[c]), size, c + 1 == columns.size(), keep_ownership);
  return array;
}

/// As ParaView names them; of a symmetric tensor in the order in which VTK reads it.
void name_components(vtkDataArray& array) {
  static const std::map<int, std::vector<const char*>> names{
      {3, {"X", "Y", "Z"}},
      {6, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}},
      {9, {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"}}};
  if (const auto found = names.find(array.GetNumberOfComponents()); found != names.end())
    for (std::size_t c = 0; c < found->second.size(); ++c)
      array.SetComponentName(static_cast<vtkIdType>(c), found->second[c]);
}

/// `zeros`: the third component of the vectors of a plane.
void add_fields(const Channel& channel, std::vector<double>& zeros, vtkPointData& target) {
  for (const FieldView& field : channel.fields) {
    std::vector<std::span<const double>> components = field.components;
    if (components.size() == 2) {
      zeros.resize(std::max(zeros.size(), components[0].size()), 0.0);
      components.push_back(std::span<const double>(zeros).first(components[0].size()));
    }
    const auto array = wrap_columns(components);
    array->SetName(field.name.c_str());
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit.c_str());
    name_components(*array);
    target.AddArray(array);
  }
  for (const IndexView& index : channel.indices) {
    const auto array = vtkSmartPointer<vtkIntArray>::New();
    array->SetArray(mutable_data(index.values), static_cast<vtkIdType>(index.values.size()), keep_ownership);
    array->SetName(index.name.c_str());
    target.AddArray(array);
  }
}

/// The coordinates once more as scalars: scripts select by them, and they cost nothing.
void add_coordinates(const Channel& channel, vtkPointData& target) {
  constexpr std::array names{"position_x", "position_y", "position_z"};
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto array = wrap_columns(std::span(&channel.position[c], 1));
    array->SetName(names[c]);
    target.AddArray(array);
  }
}

vtkSmartPointer<vtkCellArray> make_vertices(vtkIdType count) {
  auto offsets = vtkSmartPointer<vtkTypeInt64Array>::New();
  auto points = vtkSmartPointer<vtkTypeInt64Array>::New();
  offsets->SetNumberOfValues(count + 1);
  points->SetNumberOfValues(count);
  for (vtkIdType i = 0; i <= count; ++i) offsets->SetValue(i, i);
  for (vtkIdType i = 0; i < count; ++i) points->SetValue(i, i);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, points);
  return cells;
}

vtkSmartPointer<vtkDataSet> wrap_image(const Channel& channel, std::vector<double>& zeros) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(channel.extent.data());
  image->SetOrigin(channel.origin.data());
  image->SetSpacing(channel.spacing.data());
  add_fields(channel, zeros, *image->GetPointData());
  return image;
}

}  // namespace

vtkSmartPointer<vtkDataSet> VtkChannels::wrap(const Channel& channel) {
  if (channel.kind == ChannelKind::image) return wrap_image(channel, zeros_[channel.name]);
  const auto count = static_cast<vtkIdType>(channel.count);
  vtkSmartPointer<vtkCellArray>& vertices = vertices_[channel.name];
  if (!vertices || vertices->GetNumberOfCells() != count) vertices = make_vertices(count);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(wrap_columns(channel.position));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  add_fields(channel, zeros_[channel.name], *data->GetPointData());
  add_coordinates(channel, *data->GetPointData());
  return data;
}

}  // namespace ejecta
