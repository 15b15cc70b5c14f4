#include "insitu/vtk_files.hpp"

#include <fmt/format.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUtilities.h>
#include <vtkXdmfWriter.h>

#include <algorithm>
#include <fstream>

#include "base/errors.hpp"
#include "insitu/insitu_log.hpp"
#include "insitu/vtk_channels.hpp"

namespace ejecta {

namespace {

template <class Writer>
bool write_xml(const std::filesystem::path& file, vtkDataSet* data) {
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  writer->SetCompressorTypeToZLib();
  return writer->Write() == 1;
}

using Element = vtkSmartPointer<vtkXMLDataElement>;

Element element(const char* name, std::initializer_list<std::pair<const char*, std::string>> attributes) {
  auto made = Element::New();
  made->SetName(name);
  for (const auto& [key, value] : attributes) made->SetAttribute(key, value.c_str());
  return made;
}

/// Takes away the blanks about all text, which every writing would add to.
void trim(vtkXMLDataElement* element) {
  constexpr const char* blanks = " \t\r\n";
  const std::string text = element->GetCharacterData() ? element->GetCharacterData() : "";
  const auto first = text.find_first_not_of(blanks);
  const std::string trimmed =
      first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
  element->SetCharacterData(trimmed.c_str(), static_cast<int>(trimmed.size()));
  for (int k = 0; k < element->GetNumberOfNestedElements(); ++k) trim(element->GetNestedElement(k));
}

/// The one grid that VTK has written to a file.
Element grid_in(const std::filesystem::path& file) {
  const auto root = Element::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  vtkXMLDataElement* domain = root ? root->FindNestedElementWithName("Domain") : nullptr;
  vtkXMLDataElement* grid = domain ? domain->FindNestedElementWithName("Grid") : nullptr;
  if (!grid) throw OutputError(file, "expected a Grid in it");
  trim(grid);
  return grid;
}

void write_xdmf(const std::filesystem::path& file, vtkXMLDataElement* grid) {
  const Element root = element("Xdmf", {{"Version", "2.2"}}), domain = element("Domain", {});
  domain->AddNestedElement(grid);
  root->AddNestedElement(domain);
  std::ofstream out(file);
  out << "<?xml version=\"1.0\"?>\n";
  root->PrintXML(out, vtkIndent());
  out.close();
  if (!out) throw OutputError(file);
}

/// What VTK leaves out.
void add_units(const std::filesystem::path& file, const Channel& channel) {
  const Element grid = grid_in(file);
  for (int k = 0; k < grid->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement* attribute = grid->GetNestedElement(k);
    const char* name = attribute->GetAttribute("Name");
    const auto field = std::ranges::find_if(channel.fields, [&](const FieldView& f) { return name && f.name == name; });
    if (field != channel.fields.end())
      attribute->AddNestedElement(element("Information", {{"Name", "Units"}, {"Value", field->unit}}));
  }
  write_xdmf(file, grid);
}

}  // namespace

std::filesystem::path write_vtk(const std::filesystem::path& stem, const Channel& channel, VtkFormat format) {
  LogRedirection redirection("");
  VtkChannels wrapper;
  const auto data = wrapper.wrap(channel);
  std::filesystem::path file = stem;
  bool written = false;
  if (format == VtkFormat::xdmf) {
    file += ".xmf";
    vtkNew<vtkXdmfWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(data);
    writer->SetLightDataLimit(0);
    written = writer->Write() == 1;
  } else if (channel.kind == ChannelKind::image) {
    file += ".vti";
    written = write_xml<vtkXMLImageDataWriter>(file, data);
  } else {
    file += ".vtp";
    written = write_xml<vtkXMLPolyDataWriter>(file, data);
  }
  if (!written || redirection.log().has_error()) throw OutputError(file, redirection.log().reason(""));
  if (format == VtkFormat::xdmf) add_units(file, channel);
  return file;
}

std::filesystem::path write_collection(const std::filesystem::path& stem, const std::vector<TimedFile>& files,
                                       VtkFormat format) {
  std::filesystem::path file = stem;
  if (format == VtkFormat::xdmf) {
    file += ".xmf";
    const Element series = element(
        "Grid", {{"Name", stem.filename().string()}, {"GridType", "Collection"}, {"CollectionType", "Temporal"}});
    for (const TimedFile& f : files) {
      const Element grid = grid_in(f.file);
      grid->AddNestedElement(element("Time", {{"Value", fmt::format("{}", f.time)}}));
      series->AddNestedElement(grid);
    }
    write_xdmf(file, series);
    std::error_code stays;
    for (const TimedFile& f : files) std::filesystem::remove(f.file, stays);
    return file;
  }
  file += ".pvd";
  std::ofstream out(file);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const TimedFile& f : files)
    out << fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", f.time, f.file.filename().string());
  out << "  </Collection>\n</VTKFile>\n";
  out.close();
  if (!out) throw OutputError(file);
  return file;
}

}  // namespace ejecta
