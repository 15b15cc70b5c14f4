#pragma once
/// Files that cannot be written end no run: it is said once, tried again, and remembered to the end.
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ejecta {

class Outputs {
 public:
  /// What a failure costs: nothing that the next success does not bring (a table, the status), or what was to be
  /// written then (an image, a snapshot).
  enum class Loss { until_next, for_good };

  /// Calls write(), which throws OutputError or std::filesystem::filesystem_error if it fails. `name`: of the file or
  /// folder, for people. Says when that begins to fail and when it works again. Returns whether it has worked.
  bool write(const std::string& name, Loss loss, const std::function<void()>& write);

  /// From now on failures are not said at once: nothing is tried again, and missing() has the last word.
  void conclude() { concluded_ = true; }
  /// One sentence for each name of which something is missing now.
  std::vector<std::string> missing() const;
  /// What has been said, for the monitor page.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Record {
    bool failing = false;  ///< last time
    int lost = 0;          ///< for good
    std::string reason;    ///< of the last failure
  };
  void fail(const std::string& name, Loss loss, const std::string& reason);

  std::map<std::string, Record> records_;
  std::vector<std::string> warnings_;
  bool concluded_ = false;
};

}  // namespace ejecta
