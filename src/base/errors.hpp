#pragma once
/// The three kinds of failure a user can meet. Programmer errors are asserts and never reachable by input.
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace ejecta {

/// What the user wrote, or a file that is to be read, cannot be used. Carries every problem found, each as
/// `file:line: key: expected ..., got ...`. Exit code 2; nothing has been written when it is thrown.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> problems);
  explicit InputError(std::string problem) : InputError(std::vector<std::string>{std::move(problem)}) {}
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// The run cannot go on (NaN, negative density, collapsed time step). The message names time, step, stage,
/// particle, material, position and the offending values. Exit code 3, after a last checkpoint and image.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file of a run cannot be written: the disk is full, the folder has gone. The message names the file and the reason.
/// Exit code 3; results so far are kept.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::filesystem::path& file, const std::string& reason);
  /// With the reason of the system call that has just failed.
  explicit OutputError(const std::filesystem::path& file, int code = errno);
};

}  // namespace ejecta
