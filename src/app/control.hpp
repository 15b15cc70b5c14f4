#pragma once
/// What can be asked of a run while it goes on: one line a time in the file `control` of its folder.
#include <filesystem>
#include <string>
#include <vector>

namespace ejecta {

struct ControlLine {
  enum class What { stop, pause, resume, checkpoint, frame, end, every };
  What what;
  double value = 0;  ///< s; of end and every
};

/// Reads "pause" or "end = 80 us". Throws InputError with what was expected.
ControlLine parse_control(const std::string& line);

/// Leaves a line for the run. Returns once the run has taken it, with what it said to it, or after `patience` [s], with
/// nothing. Throws InputError if the line is malformed, if no run is going on in the folder or the run ends without
/// taking it, OutputError if it cannot be left there.
std::string send_control(const std::filesystem::path& folder, const std::string& line, double patience);

/// The run's side: takes the lines that have been left since, malformed ones too.
std::vector<std::string> take_control(const std::filesystem::path& folder);

/// How the log marks what became of a line.
inline constexpr const char* control_mark = "control: ";

}  // namespace ejecta
