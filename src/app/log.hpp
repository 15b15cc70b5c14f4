#pragma once
#include <spdlog/spdlog.h>

#include <filesystem>
#include <vector>

#include "model/package.hpp"

namespace ejecta {

/// Messages go to stderr.
void log_to_terminal();

/// Messages go to stderr, and from here on to run.log in the run folder too.
void log_to_folder(const std::filesystem::path& folder, bool append);

/// Says what a package remarks.
void say(const std::vector<Remark>& remarks);

}  // namespace ejecta
