#pragma once
/// Files that are either the old or the new version, never half of one.
#include <filesystem>
#include <string_view>

namespace ejecta {

/// Name under which a file is written before it is moved into place.
inline std::filesystem::path part_name(const std::filesystem::path& file) { return file.string() + ".part"; }

/// Makes the folder, with those around it, if it is not there. Throws OutputError.
void ensure_folder(const std::filesystem::path& folder);

/// Renames the finished part over `file`. Throws OutputError if that fails.
void move_into_place(const std::filesystem::path& file);

/// Returns once a file, or what a folder lists, is on the disk and survives a loss of power. Throws OutputError.
void sync_to_disk(const std::filesystem::path& path);

/// Removes the part of `file` if it goes out of scope before the part is moved into place: half a file is of no use,
/// and a full disk needs the room.
class PartGuard {
 public:
  explicit PartGuard(std::filesystem::path file) : file_(std::move(file)) {}
  ~PartGuard();
  PartGuard(const PartGuard&) = delete;
  PartGuard& operator=(const PartGuard&) = delete;

 private:
  std::filesystem::path file_;
};

/// Writes the text by way of a part file, in a folder that is made if it has gone. Throws OutputError if it cannot be
/// written.
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace ejecta
