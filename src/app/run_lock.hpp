#pragma once
/// One run, one folder: run.lock says which process writes there.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ejecta {

/// "process 4711 on host" if a run is going on in the folder: one that holds the lock, or that was begun on another
/// host and has not given it back, with what to do then.
std::optional<std::string> run_in(const std::filesystem::path& folder);

class RunLock {
 public:
  /// Makes the folder if need be and takes its lock; that of a process that is gone is taken over. Throws InputError if
  /// a run is going on there, OutputError if the lock cannot be written.
  explicit RunLock(std::filesystem::path folder);
  /// Gives the lock back, and removes what the constructor has made if nothing has been put into it.
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Takes the lock again if somebody has removed it, perhaps with the folder. Returns whether that was so. Throws as
  /// the constructor does.
  bool keep();
  /// Of the run that was killed here before, as run_in; empty if none was.
  const std::string& left_by() const { return left_by_; }

 private:
  void take();

  std::filesystem::path folder_, file_;
  std::vector<std::filesystem::path> made_;  ///< folders, the innermost first
  int descriptor_ = -1;
  std::string left_by_;
};

}  // namespace ejecta
