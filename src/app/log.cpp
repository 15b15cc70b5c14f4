#include "app/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace ejecta {

namespace {

void log_to(spdlog::sinks_init_list sinks) {
  auto logger = std::make_shared<spdlog::logger>("ejecta", sinks);
  logger->set_pattern("%H:%M:%S %^%L%$ %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

}  // namespace

void log_to_terminal() { log_to({std::make_shared<spdlog::sinks::stderr_color_sink_mt>()}); }

void log_to_folder(const std::filesystem::path& folder, bool append) {
  log_to({std::make_shared<spdlog::sinks::stderr_color_sink_mt>(),
          std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder / "run.log").string(), !append)});
}

}  // namespace ejecta
