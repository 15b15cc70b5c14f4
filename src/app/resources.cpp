#include "app/resources.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "model/package_kind.hpp"

namespace ejecta {

namespace {

double free_memory() {
  std::ifstream meminfo("/proc/meminfo");
  std::string key, unit;
  for (double kilobytes; meminfo >> key >> kilobytes >> unit;)
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

bool is_writable(const std::filesystem::path& folder) { return access(folder.c_str(), W_OK | X_OK) == 0; }

std::vector<Estimate> estimates(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<Estimate> list;
  for (const PackageKind& kind : package_kinds())
    if (kind.estimate && kind.in(scene)) list.push_back(kind.estimate(scene, materials));
  return list;
}

void check_memory(const Scene& scene, const std::vector<Material>& materials) {
  double needed = 0;
  std::string what;
  bool too_many = false;
  for (const Estimate& e : estimates(scene, materials)) {
    needed += e.elements * e.bytes_each;
    too_many = too_many || e.elements >= 2e9;
    what += fmt::format("{}{:.3g} {}s", what.empty() ? "" : " and ", e.elements, e.element);
  }
  const double free = free_memory();
  if (needed < free && !too_many) return;
  throw InputError(
      fmt::format("{}: resolution.spacing: expected a scene that fits in the {:.1f} GB of free memory, got "
                  "{} that need {:.3g} GB",
                  scene.file, free / 1e9, what, needed / 1e9));
}

std::string timer_table(std::span<const StageTimers::Entry> times) {
  double total = 0;
  for (const auto& e : times) total += e.seconds;
  std::string text = fmt::format("{:<22}{:>12}{:>9}{:>10}\n", "stage", "seconds", "share", "calls");
  for (const auto& e : times)
    text += fmt::format("{:<22}{:>12.3f}{:>8.1f}%{:>10}\n", e.name, e.seconds, 100 * e.seconds / total, e.calls);
  return text;
}

}  // namespace ejecta
