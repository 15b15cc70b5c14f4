#pragma once
/// Checkpoints and snapshots: named columns of particles, a clock and the scene as text, in one HDF5 file that appears
/// only when it is complete.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ejecta {

template <class T>
struct NamedColumn {
  std::string name, unit;  ///< unit: SI symbol, "1" if dimensionless
  std::span<const T> values;
};

/// What is to be written. Columns and labels of one prefix ("grid." of "grid.pressure", or none) have the same length;
/// nothing is copied.
struct CheckpointView {
  double time = 0, dt = 0;  ///< s
  std::int64_t step = 0;
  std::map<std::string, double> scalars;  ///< whatever else the run must remember
  std::string scene;                      ///< text of resolved.toml
  std::vector<NamedColumn<double>> columns;
  std::vector<NamedColumn<std::int32_t>> labels;
};

/// What was read back.
struct Checkpoint {
  std::filesystem::path file;
  double time = 0, dt = 0;
  std::int64_t step = 0;
  std::map<std::string, double> scalars;
  std::string scene;
  std::map<std::string, std::vector<double>> columns;
  std::map<std::string, std::vector<std::int32_t>> labels;

  /// Throw InputError, naming the file, if the checkpoint does not hold what is asked for.
  const std::vector<double>& column(const std::string& name) const;
  const std::vector<std::int32_t>& label(const std::string& name) const;
  double scalar(const std::string& name) const;
  /// Length of the columns and labels of a prefix; 0 if there are none.
  std::size_t size(const std::string& prefix) const;
};

/// Writes one file, with a checksum at its front, in a folder that is made if need be. It has its name only once it is
/// on the disk as a whole. Throws OutputError if it cannot be written.
void write_checkpoint(const std::filesystem::path& file, const CheckpointView& view);

/// Writes folder/checkpoint_<step>.h5 and removes all but the newest `kept`. Returns its path. Throws OutputError.
std::filesystem::path write_rotating_checkpoint(const std::filesystem::path& folder, const CheckpointView& view,
                                                int kept = 2);

/// The checkpoint of the highest step in the folder, if there is one.
std::optional<std::filesystem::path> latest_checkpoint(const std::filesystem::path& folder);

/// Where a checkpoint or snapshot stands, without reading the rest of it. Throws InputError as read_checkpoint() does.
struct CheckpointClock {
  double time = 0;  ///< s
  std::int64_t step = 0;
};
CheckpointClock read_checkpoint_clock(const std::filesystem::path& file);

/// Throws InputError if the file is missing, truncated, damaged, of another format or its columns differ in length.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// The newest checkpoint of a folder that can be read. What is wrong with newer ones is added to `problems`. Throws
/// InputError if there is none.
Checkpoint read_latest_checkpoint(const std::filesystem::path& folder, std::vector<std::string>& problems);

/// Renames the checkpoints of later steps to <name>.aside, so that the run that goes on from `step` is not mixed up
/// with them. Returns their former names.
std::vector<std::string> set_later_checkpoints_aside(const std::filesystem::path& folder, std::int64_t step);

}  // namespace ejecta
