#include "output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>

#include "base/errors.hpp"

namespace ejecta {

void ensure_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw OutputError(folder, failure.message());
}

void sync_to_disk(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw OutputError(path);
  const int failure = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  if (failure != 0 && failure != EINVAL) throw OutputError(path, failure);  // EINVAL: nothing that could be synced
}

void move_into_place(const std::filesystem::path& file) {
  std::error_code failure;
  std::filesystem::rename(part_name(file), file, failure);
  if (failure) throw OutputError(file, failure.message());
}

PartGuard::~PartGuard() {
  std::error_code none_left;
  std::filesystem::remove(part_name(file_), none_left);
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  ensure_folder(file.parent_path().empty() ? "." : file.parent_path());
  const PartGuard guard(file);
  errno = 0;
  std::ofstream out(part_name(file), std::ios::trunc | std::ios::binary);
  out << text;
  out.close();
  if (!out) throw OutputError(file);
  move_into_place(file);
}

}  // namespace ejecta
