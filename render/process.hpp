#pragma once
/// Child processes without a shell.
#include <filesystem>
#include <string>
#include <vector>

namespace ejecta {

/// Runs `arguments` (the program, found on PATH, first) in `folder` with no input and waits for it. Returns an empty
/// text on success, else one sentence: not installed, or the exit status and the last line the program said.
std::string run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace ejecta
