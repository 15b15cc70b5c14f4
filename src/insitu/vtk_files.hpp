#pragma once
/// Channels as files that ParaView opens without a plugin.
#include <filesystem>
#include <string>
#include <vector>

#include "model/channel.hpp"

namespace ejecta {

enum class VtkFormat { xml, xdmf };

/// Writes <stem>.vtp (an image: .vti), or <stem>.xmf with its data in <stem>.h5. Arrays carry their units. Returns the
/// file to open. Throws OutputError.
std::filesystem::path write_vtk(const std::filesystem::path& stem, const Channel& channel, VtkFormat format);

struct TimedFile {
  std::filesystem::path file;
  double time = 0;  ///< s
};
/// What shows files of a format and a folder in time: a ParaView collection <stem>.pvd of them, or <stem>.xmf, which
/// takes their place. Returns it. Throws OutputError.
std::filesystem::path write_collection(const std::filesystem::path& stem, const std::vector<TimedFile>& files,
                                       VtkFormat format);

}  // namespace ejecta
