#include "output/atomic_file.hpp"

#include <fstream>

#include "base/errors.hpp"

namespace ejecta {

void move_into_place(const std::filesystem::path& file) {
  std::error_code failure;
  std::filesystem::rename(part_name(file), file, failure);
  if (failure) throw InputError(file.string() + ": cannot be written: " + failure.message());
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  std::ofstream out(part_name(file), std::ios::trunc | std::ios::binary);
  out << text;
  out.close();
  if (!out) throw InputError(file.string() + ": cannot be written");
  move_into_place(file);
}

}  // namespace ejecta
