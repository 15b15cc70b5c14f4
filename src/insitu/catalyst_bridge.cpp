#include "insitu/catalyst_bridge.hpp"

#include <vtkCPDataDescription.h>
#include <vtkCPInputDataDescription.h>
#include <vtkCPProcessor.h>
#include <vtkCPPythonScriptV2Helper.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPythonInterpreter.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "base/data_folder.hpp"
#include "base/errors.hpp"
#include "base/json.hpp"
#include "insitu/headless_window.hpp"
#include "insitu/image_index.hpp"
#include "insitu/insitu_log.hpp"
#include "insitu/vtk_channels.hpp"

namespace ejecta {
namespace {

/// Python and ParaView install signal handlers of their own; the run's are put back when this goes out of scope.
class KeepSignalHandlers {
 public:
  KeepSignalHandlers() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], nullptr, &actions_[i]);
  }
  ~KeepSignalHandlers() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &actions_[i], nullptr);
  }
  KeepSignalHandlers(const KeepSignalHandlers&) = delete;
  KeepSignalHandlers& operator=(const KeepSignalHandlers&) = delete;

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
  std::array<struct sigaction, signals.size()> actions_{};
};

struct Script {
  std::string path;
  vtkSmartPointer<vtkCPPythonScriptV2Helper> module;
  std::string problem;  ///< why it could not be imported
  bool has_failed = false;
};

std::filesystem::path images_folder(const PipelineSettings& settings) {
  return std::filesystem::path(settings.run_folder) / "images";
}

}  // namespace

struct CatalystBridge::State {
  PipelineSettings settings;
  LogRedirection redirection;
  ImageIndex index;
  VtkChannels wrapper;
  vtkNew<vtkCPProcessor> processor;
  vtkNew<vtkCPDataDescription> description;
  vtkNew<vtkPolyData> nothing;  ///< stands for a channel that is not there
  std::vector<Script> scripts;
  std::int64_t last_step = std::numeric_limits<std::int64_t>::min();
  int failures = 0;

  explicit State(PipelineSettings s)
      : settings(std::move(s)), redirection(settings.run_folder + "/insitu.log"), index(images_folder(settings)) {}

  void publish(std::span<const Channel> channels, std::int64_t step, double time);
  bool import(Script& script);
  bool run(Script& script);
};

/// Hands the frame to ParaView: the settings through Python's environment, the data through the description.
void CatalystBridge::State::publish(std::span<const Channel> channels, std::int64_t step, double time) {
  const std::string assignment =
      "import os; os.environ['EJECTA_FRAME'] = " + to_json(frame_json(settings, channels)) + "\n";
  vtkPythonInterpreter::RunSimpleString(assignment.c_str());
  description->SetTimeData(time, step);
  description->ForceOutputOn();
  std::vector<std::string> names(channel_names.begin(), channel_names.end());
  names.insert(names.end(), settings.more_channels.begin(), settings.more_channels.end());
  for (const std::string& name : names) {
    description->AddInput(name.c_str());
    vtkCPInputDataDescription* input = description->GetInputDescriptionByName(name.c_str());
    input->AllFieldsOn();
    input->GenerateMeshOn();
    const auto channel = std::ranges::find(channels, name, &Channel::name);
    input->SetGrid(channel == channels.end() ? nothing.Get() : wrapper.wrap(*channel).Get());
  }
}

/// Runs the script's own lines, in which it registers its sources.
bool CatalystBridge::State::import(Script& script) {
  return script.module->IsImported() ||
         (script.module->Import(description) && script.module->CatalystInitialize(description));
}

bool CatalystBridge::State::run(Script& script) {
  redirection.log().clear();
  if (!import(script)) return false;
  if (!script.module->RequestDataDescription(description)) return true;  // its own trigger says: not now
  return script.module->CatalystExecute(description) && !redirection.log().has_error();
}

CatalystBridge::CatalystBridge(const std::vector<std::string>& scripts, PipelineSettings settings) {
  const KeepSignalHandlers keep;
  settings.run_folder = std::filesystem::absolute(settings.run_folder).string();
  const std::string images = images_folder(settings).string();
  setenv("PARAVIEW_OVERRIDE_EXTRACTS_OUTPUT_DIRECTORY", images.c_str(), 1);
  setenv("VTK_SILENCE_GET_VOID_POINTER_WARNINGS", "1", 1);  // some filters copy our separate x, y, z: that is fine
  state_ = std::make_unique<State>(std::move(settings));
  use_headless_window();
  vtkPythonInterpreter::Initialize(0);
  vtkPythonInterpreter::PrependPythonPath((data_folder() / "catalyst_scripts").c_str());
  // Without output to the terminal ParaView's Python logger would write every step it takes.
  vtkPythonInterpreter::RunSimpleString(
      "import logging, sys, paraview; paraview.logger.setLevel(logging.WARNING); sys.dont_write_bytecode = True\n");
  state_->processor->Initialize();
  state_->redirection.reinstate();  // ParaView has set its own
  for (const std::string& path : scripts) {
    auto module = vtkSmartPointer<vtkCPPythonScriptV2Helper>::New();
    if (!module->PrepareFromScript(path)) throw InputError(state_->redirection.log().reason(path));
    state_->scripts.push_back({path, module});
  }
  constexpr double before_all_frames = -1;  // s
  state_->publish({}, -1, before_all_frames);
  for (Script& script : state_->scripts) {
    state_->redirection.log().clear();
    if (!state_->import(script)) script.problem = state_->redirection.log().reason(script.path);
  }
}

bool CatalystBridge::reads(const char* channel) const {
  return vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager()->GetProxy("sources", channel) != nullptr;
}

CatalystBridge::~CatalystBridge() {
  const KeepSignalHandlers keep;
  for (Script& script : state_->scripts) script.module->CatalystFinalize();
  state_->scripts.clear();
  state_->processor->Finalize();
}

FrameReport CatalystBridge::execute(std::int64_t step, double time, std::span<const Channel> channels) {
  using Clock = std::chrono::steady_clock;
  FrameReport report;
  if (step == state_->last_step) return report;
  state_->last_step = step;
  const KeepSignalHandlers keep;
  state_->publish(channels, step, time);
  for (Script& script : state_->scripts) {
    const auto start = Clock::now();
    const bool done = state_->run(script);
    report.pipelines.push_back({std::filesystem::path(script.path).stem().string(),
                                std::chrono::duration<double>(Clock::now() - start).count()});
    if (done) continue;
    ++state_->failures;
    if (!script.has_failed)
      report.warnings.push_back(script.problem.empty() ? state_->redirection.log().reason(script.path)
                                                       : script.problem);
    script.has_failed = true;
  }
  report.images = state_->index.add_new_images(step, time);
  return report;
}

int CatalystBridge::failures() const { return state_->failures; }

}  // namespace ejecta
