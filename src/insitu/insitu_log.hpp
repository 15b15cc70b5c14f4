#pragma once
/// Where VTK, ParaView and the scripts' own output go: a file of the run folder instead of the terminal.
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <fstream>
#include <string>

namespace ejecta {

/// Appends every message to a file (none if the path is empty) and keeps the text since the last clear().
class InsituLog : public vtkOutputWindow {
 public:
  static InsituLog* New();
  vtkTypeMacro(InsituLog, vtkOutputWindow);

  void open(const std::string& path) { file_.open(path, std::ios::app); }
  void DisplayText(const char* text) override;
  /// While this is so nothing goes to the file: what is said is an answer to a question of the program.
  void keep_to_yourself(bool now) { secret_ = now; }

  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }
  /// Whether VTK has spoken of an error since: its filters and writers raise no exception of Python.
  bool has_error() const { return text_.find("ERROR: In ") != std::string::npos; }
  /// The end of the text as one line: of a Python traceback the exception, with the script's line that raised it.
  std::string reason(const std::string& script) const;

 private:
  std::ofstream file_;
  std::string text_;
  bool secret_ = false;
};

/// Makes an InsituLog VTK's output window for as long as it lives.
class LogRedirection {
 public:
  explicit LogRedirection(const std::string& path);
  ~LogRedirection();
  LogRedirection(const LogRedirection&) = delete;
  LogRedirection& operator=(const LogRedirection&) = delete;
  InsituLog& log() { return *log_; }
  /// Takes the output back from whoever has set a window of its own since.
  void reinstate() { vtkOutputWindow::SetInstance(log_); }

 private:
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkSmartPointer<InsituLog> log_;
};

}  // namespace ejecta
