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
/// A ParaView collection (.pvd) of files beside it in time. Throws OutputError.
void write_collection(const std::filesystem::path& file, const std::vector<TimedFile>& files);

}  // namespace ejecta
