#pragma once
/// Files that are either the old or the new version, never half of one.
#include <filesystem>
#include <string_view>

namespace ejecta {

/// Name under which a file is written before it is moved into place.
inline std::filesystem::path part_name(const std::filesystem::path& file) { return file.string() + ".part"; }

/// Renames the finished part over `file`. Throws InputError if that fails.
void move_into_place(const std::filesystem::path& file);

/// Writes the text by way of a part file. Throws InputError if it cannot be written.
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace ejecta
