#include "insitu/vtk_files.hpp"

#include <fmt/format.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXdmfWriter.h>

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
  return file;
}

void write_collection(const std::filesystem::path& file, const std::vector<TimedFile>& files) {
  std::ofstream out(file);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const TimedFile& f : files)
    out << fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", f.time, f.file.filename().string());
  out << "  </Collection>\n</VTKFile>\n";
  out.close();
  if (!out) throw OutputError(file);
}

}  // namespace ejecta
