#include "app/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include "base/errors.hpp"

namespace ejecta {

namespace {

void log_to(spdlog::sinks_init_list sinks) {
  auto logger = std::make_shared<spdlog::logger>("ejecta", sinks);
  logger->set_pattern("%H:%M:%S %^%L%$ %v");
  logger->flush_on(spdlog::level::info);
  // The log is not what a run is for: where it cannot be written the results cannot either, and they complain.
  logger->set_error_handler([](const std::string&) {});
  spdlog::set_default_logger(logger);
}

}  // namespace

void log_to_terminal() { log_to({std::make_shared<spdlog::sinks::stderr_color_sink_mt>()}); }

void log_to_folder(const std::filesystem::path& folder, bool append) try {
  log_to({std::make_shared<spdlog::sinks::stderr_color_sink_mt>(),
          std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder / "run.log").string(), !append)});
} catch (const spdlog::spdlog_ex&) {
  throw OutputError(folder / "run.log");
}

void say(const std::vector<Remark>& remarks) {
  for (const Remark& remark : remarks)
    spdlog::log(remark.worrying ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
}

}  // namespace ejecta
