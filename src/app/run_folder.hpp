#pragma once
/// The folder of a run, or of a reference: when they may have it, and which of the files in it are their own.
#include <filesystem>

#include "app/options.hpp"
#include "model/clock.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// A run begins in a folder that is new or empty, goes on in one that holds a checkpoint (--restart), or replaces an
/// earlier run (--overwrite). Throws InputError otherwise; nothing is touched.
void check_run_folder(const RunOptions& options, const std::filesystem::path& folder);

/// Removes the files that a run writes and the folders that this empties. All others stay, as do symbolic links to
/// folders. Throws OutputError.
void clear_run_folder(const std::filesystem::path& folder);

/// After a restart: removes images, line-outs and snapshots of steps that the run has not come to yet or, at the clock
/// of the checkpoint, that are on no schedule of the scene. Returns how many. They are the run's own, and are made
/// again.
int remove_later_files(const std::filesystem::path& folder, const Clock& clock, const Scene& scene);

/// A reference takes a folder that is new, empty, or holds nothing but an earlier reference. Throws InputError
/// otherwise; nothing is touched.
void check_reference_folder(const std::filesystem::path& folder);

/// Makes the folder, or removes the earlier reference in it. Throws OutputError.
void clear_reference_folder(const std::filesystem::path& folder);

}  // namespace ejecta
