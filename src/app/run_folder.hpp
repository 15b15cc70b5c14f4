#pragma once
/// The folder of a run, or of a reference: when they may have it, and which of the files in it are their own.
#include <filesystem>

#include "app/options.hpp"

namespace ejecta {

/// A run begins in a folder that is new or empty, goes on in one that holds a checkpoint (--restart), or replaces an
/// earlier run (--overwrite). Throws InputError otherwise; nothing is touched.
void check_run_folder(const RunOptions& options, const std::filesystem::path& folder);

/// Removes the files that a run writes and the folders that this empties. All others stay, as do symbolic links to
/// folders. Throws OutputError.
void clear_run_folder(const std::filesystem::path& folder);

/// A reference takes a folder that is new, empty, or holds nothing but an earlier reference. Throws InputError
/// otherwise; nothing is touched.
void check_reference_folder(const std::filesystem::path& folder);

/// Makes the folder, or removes the earlier reference in it. Throws OutputError.
void clear_reference_folder(const std::filesystem::path& folder);

}  // namespace ejecta
