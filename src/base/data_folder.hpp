#pragma once
/// Where the files that come with Ejecta are, so that an installed program can be moved to any place.
#include <filesystem>

namespace ejecta {

/// The folder that holds `inputs/materials` and `catalyst_scripts`. In this order: the environment variable
/// EJECTA_DATA;
/// `../share/ejecta` beside the folder of the program, where an installation has it; the folder named in the file
/// `ejecta_data_folder`, which a build writes, beside the program or in a folder above it. Throws InputError if there
/// is none.
std::filesystem::path data_folder();

}  // namespace ejecta
