#include "observe/outputs.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>

#include "base/errors.hpp"

namespace ejecta {

bool Outputs::write(const std::string& name, Loss loss, const std::function<void()>& write) {
  try {
    write();
  } catch (const OutputError& error) {
    fail(name, loss, error.what());
    return false;
  } catch (const std::filesystem::filesystem_error& error) {
    fail(name, loss, error.path1().string() + ": " + error.code().message());
    return false;
  }
  if (const auto record = records_.find(name); record != records_.end() && record->second.failing) {
    record->second.failing = false;
    spdlog::info("{}: written again{}", name,
                 record->second.lost > 0 ? fmt::format(", {} missing", record->second.lost) : "");
  }
  return true;
}

void Outputs::fail(const std::string& name, Loss loss, const std::string& reason) {
  Record& record = records_[name];
  if (!record.failing && !concluded_) {
    warnings_.push_back(fmt::format("{}; the run goes on and tries again", reason));
    spdlog::warn("{}", warnings_.back());
  }
  record.failing = true;
  record.reason = reason;
  if (loss == Loss::for_good) ++record.lost;
}

std::vector<std::string> Outputs::missing() const {
  std::vector<std::string> sentences;
  for (const auto& [name, record] : records_)
    if (record.lost > 0)
      sentences.push_back(fmt::format("{}: {} not written, the last because {}", name, record.lost, record.reason));
    else if (record.failing)
      sentences.push_back(fmt::format("{}: not written: {}", name, record.reason));
  return sentences;
}

}  // namespace ejecta
