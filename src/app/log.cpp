#include "app/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace ejecta {

void log_to_folder(const std::filesystem::path& folder, bool append) {
  auto terminal = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  auto file = std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder / "run.log").string(), !append);
  auto logger = std::make_shared<spdlog::logger>("ejecta", spdlog::sinks_init_list{terminal, file});
  logger->set_pattern("%H:%M:%S %^%L%$ %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

}  // namespace ejecta
