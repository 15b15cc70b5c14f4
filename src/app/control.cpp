#include "app/control.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <thread>
#include <utility>

#include "app/run_lock.hpp"
#include "base/errors.hpp"
#include "scene/scene_reader.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;
using What = ControlLine::What;

constexpr std::array words{std::pair{"stop", What::stop},     std::pair{"pause", What::pause},
                           std::pair{"resume", What::resume}, std::pair{"checkpoint", What::checkpoint},
                           std::pair{"frame", What::frame},   std::pair{"end", What::end},
                           std::pair{"every", What::every}};
constexpr const char* expected = "stop, pause, resume, checkpoint, frame, end=TIME or every=TIME";

fs::path control_file(const fs::path& folder) { return folder / "control"; }

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// What the log has said to a line since it was `from` bytes long.
std::string answer_in(const fs::path& log, std::uintmax_t from) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(log, none);
  std::ifstream in(log);
  in.seekg(static_cast<std::streamoff>(size < from ? 0 : from));  // shorter: the run has begun another one
  for (std::string text; std::getline(in, text);)
    if (const auto at = text.find(control_mark); at != std::string::npos && !in.eof())
      return text.substr(at + std::string_view(control_mark).size());
  return "";
}

}  // namespace

ControlLine parse_control(const std::string& line) {
  const std::size_t equals = line.find('=');
  const std::string word = trimmed(line.substr(0, equals));
  const std::string value = equals == std::string::npos ? "" : trimmed(line.substr(equals + 1));
  for (const auto& [name, what] : words) {
    if (word != name) continue;
    const bool timed = what == What::end || what == What::every;
    if (timed != !value.empty() || timed != (equals != std::string::npos)) break;
    if (!timed) return {what};
    double time = 0;
    try {
      time = parse_quantity(value, "s");
    } catch (const InputError& error) {
      throw InputError(fmt::format("control: {}: {}", word, error.what()));
    }
    if (!(time > 0)) throw InputError(fmt::format("control: {}: expected a time > 0, got {}", word, value));
    return {what, time};
  }
  std::vector<std::string> names;
  for (const auto& [name, what] : words) names.emplace_back(name);
  const std::string near = nearest_word(word, names);
  throw InputError(fmt::format("control: expected {}, got \"{}\"{}", expected, trimmed(line),
                               near.empty() || near == word ? "" : "; did you mean " + near + "?"));
}

std::string send_control(const fs::path& folder, const std::string& line, double patience) {
  using Clock = std::chrono::steady_clock;
  parse_control(line);
  if (!run_in(folder)) throw InputError(folder.string() + ": expected the folder of a run that goes on, found none");
  const fs::path file = control_file(folder), part = fmt::format("{}.{}.part", file.string(), getpid());
  const auto give_up = Clock::now() + std::chrono::duration<double>(patience);
  const auto wait = [&](auto done) {
    while (!done()) {
      if (Clock::now() > give_up) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
  };
  errno = 0;
  std::ofstream out(part);
  out << line << '\n';
  out.close();
  if (!out) throw OutputError(part);
  std::error_code none;
  const std::uintmax_t said = fs::file_size(folder / "run.log", none);
  const bool log_is_there = !none;
  // A link is made only if nobody else's line is waiting there.
  const bool left = wait([&] { return link(part.c_str(), file.c_str()) == 0; });
  fs::remove(part, none);
  if (!left) throw OutputError(file, "an earlier line is still waiting there");
  std::string answer;
  bool ended = false;
  wait([&] {
    ended = !run_in(folder);
    answer = answer_in(folder / "run.log", log_is_there ? said : 0);
    return ended || !answer.empty();
  });
  if (ended && answer.empty()) {
    fs::remove(file, none);
    throw InputError(folder.string() + ": the run has ended and has not done it");
  }
  return answer;
}

std::vector<std::string> take_control(const fs::path& folder) {
  const fs::path file = control_file(folder), taken = folder / "control.taken";
  std::error_code none;
  const std::uintmax_t size = fs::file_size(file, none);
  if (none || size == 0) return {};
  fs::rename(file, taken, none);
  if (none) return {};
  std::vector<std::string> lines;
  std::ifstream in(taken);
  for (std::string line; std::getline(in, line);)
    if (line = trimmed(line); !line.empty()) lines.push_back(line);
  in.close();
  fs::remove(taken, none);
  return lines;
}

}  // namespace ejecta
