#include "output/atomic_file.hpp"

#include <fstream>

#include "base/errors.hpp"

namespace ejecta {

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
  const PartGuard guard(file);
  std::ofstream out(part_name(file), std::ios::trunc | std::ios::binary);
  out << text;
  out.close();
  if (!out) throw OutputError(file);
  move_into_place(file);
}

}  // namespace ejecta
