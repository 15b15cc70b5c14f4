#include "app/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "base/errors.hpp"
#include "output/atomic_file.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

fs::path lock_file(const fs::path& folder) { return folder / "run.lock"; }

std::string host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string read_all(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t got = pread(descriptor, text.data(), text.size(), 0);
  std::string words(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!words.empty() && words.back() == '\n') words.pop_back();
  return words;
}

/// Whether the lock was written on another host. Locks may not reach across: then nobody here can tell.
bool is_foreign(const std::string& words) { return !words.empty() && !words.ends_with(" on " + host()); }

bool same_file(int descriptor, const fs::path& file) {
  struct stat ours {
  }, there{};
  return fstat(descriptor, &ours) == 0 && stat(file.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& words) {
  throw InputError(fmt::format("{}: expected a folder that no run is using, got that of {}", folder.string(), words));
}

}  // namespace

std::optional<std::string> run_in(const fs::path& folder) {
  const int descriptor = open(lock_file(folder).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  const std::string words = read_all(descriptor);
  const bool held = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  if (is_foreign(words)) return words + "; if that process is gone, remove run.lock";
  return held ? std::optional(words) : std::nullopt;
}

RunLock::RunLock(fs::path folder) : folder_(std::move(folder)), file_(lock_file(folder_)) {
  for (fs::path missing = fs::absolute(folder_).lexically_normal(); !missing.empty() && !fs::exists(missing);
       missing = missing.parent_path())
    made_.push_back(missing);
  std::error_code failure;
  fs::create_directories(folder_, failure);
  if (failure)
    throw InputError(fmt::format("{}: expected a folder to write to, got: {}", folder_.string(), failure.message()));
  take();
}

RunLock::~RunLock() {
  std::error_code stays;
  if (same_file(descriptor_, file_)) fs::remove(file_, stays);
  close(descriptor_);
  for (const fs::path& folder : made_) fs::remove(folder, stays);  // those that are empty
}

void RunLock::take() {
  if (const auto other = run_in(folder_)) refuse(folder_, *other);
  ensure_folder(folder_);
  const int descriptor = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) throw OutputError(file_);
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    const std::string words = read_all(descriptor);
    close(descriptor);
    refuse(folder_, words);
  }
  left_by_ = read_all(descriptor);
  const std::string words = fmt::format("process {} on {}\n", getpid(), host());
  if (ftruncate(descriptor, 0) != 0 || pwrite(descriptor, words.data(), words.size(), 0) < 0) {
    const int reason = errno;
    close(descriptor);
    throw OutputError(file_, reason);
  }
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = descriptor;
}

bool RunLock::keep() {
  if (same_file(descriptor_, file_)) return false;
  take();
  return true;
}

}  // namespace ejecta
