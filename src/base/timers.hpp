#pragma once
/// Wall time by name: the table of contents of the algorithm.
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace ejecta {

class StageTimers {
 public:
  struct Entry {
    std::string name;
    double seconds = 0;
    std::int64_t calls = 0;
  };

  /// Runs body and books its wall time under the name.
  template <class Body>
  void time(const std::string& name, Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    Entry& e = entry(name);
    e.seconds += taken.count();
    ++e.calls;
  }
  /// Seconds booked under a name so far, 0 if none.
  double seconds(const std::string& name) const {
    for (const Entry& e : entries_)
      if (e.name == name) return e.seconds;
    return 0;
  }
  /// In order of first use.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Entry& entry(const std::string& name) {
    for (Entry& e : entries_)
      if (e.name == name) return e;
    return entries_.emplace_back(Entry{name});
  }
  std::vector<Entry> entries_;
};

}  // namespace ejecta
