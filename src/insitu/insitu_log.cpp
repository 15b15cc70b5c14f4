#include "insitu/insitu_log.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>

#include <sstream>
#include <string_view>

namespace ejecta {

vtkStandardNewMacro(InsituLog);

void InsituLog::DisplayText(const char* text) {
  if (!text) return;
  // Said of every channel that a second script looks at in the same step.
  if (std::string_view(text).find("New time step is not after last time step") != std::string_view::npos) return;
  text_ += text;
  if (file_.is_open() && !secret_) file_ << text << std::flush;
}

std::string InsituLog::reason(const std::string& script) const {
  // A Python traceback: 'File "<script>", line <n>, in ...' leads to the last line, 'SomeError: what happened'.
  std::istringstream lines(text_);
  std::string line, last, place;
  const std::string mark = "File \"" + script + "\", line ";
  while (std::getline(lines, line)) {
    if (const auto at = line.find(mark); at != std::string::npos)
      place = line.substr(at + mark.size(), line.find(',', at + mark.size()) - at - mark.size());
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  if (last.empty()) last = "failed without a message";
  return script + (place.empty() ? "" : ":" + place) + ": " + last;
}

LogRedirection::LogRedirection(const std::string& path)
    : previous_(vtkOutputWindow::GetInstance()), log_(vtkSmartPointer<InsituLog>::New()) {
  if (!path.empty()) log_->open(path);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  reinstate();
}

LogRedirection::~LogRedirection() { vtkOutputWindow::SetInstance(previous_); }

}  // namespace ejecta
