#include "base/errors.hpp"

#include <system_error>

namespace ejecta {

namespace {
std::string join_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}
}  // namespace

InputError::InputError(std::vector<std::string> problems)
    : std::runtime_error(join_lines(problems)), problems_(std::move(problems)) {}

OutputError::OutputError(const std::filesystem::path& file, const std::string& reason)
    : std::runtime_error(file.string() + ": cannot be written: " + reason) {}
OutputError::OutputError(const std::filesystem::path& file, int code)
    : OutputError(file, code == 0 ? "for an unknown reason" : std::generic_category().message(code)) {}

}  // namespace ejecta
