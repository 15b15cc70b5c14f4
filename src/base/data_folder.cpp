#include "base/data_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <string>

#include "base/errors.hpp"

namespace ejecta {

namespace fs = std::filesystem;

namespace {

bool holds_data(const fs::path& folder) {
  return fs::is_directory(folder / "inputs" / "materials") && fs::is_directory(folder / "catalyst_scripts");
}

}  // namespace

fs::path data_folder() {
  if (const char* asked = std::getenv("EJECTA_DATA")) {
    if (holds_data(asked)) return fs::absolute(asked);
    throw InputError(std::string("EJECTA_DATA: expected a folder with inputs/materials and catalyst_scripts, got ") +
                     asked);
  }
  const fs::path program = fs::read_symlink("/proc/self/exe");
  if (const fs::path installed = program.parent_path().parent_path() / "share" / "ejecta"; holds_data(installed))
    return installed;
  for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    std::ifstream note(folder / "ejecta_data_folder");
    std::string named;
    if (std::getline(note, named) && holds_data(named)) return named;
  }
  throw InputError("the folder with inputs/materials and catalyst_scripts is not beside " + program.string() +
                   ": set EJECTA_DATA to it");
}

}  // namespace ejecta
