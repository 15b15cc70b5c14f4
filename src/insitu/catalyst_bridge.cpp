#include "insitu/catalyst_bridge.hpp"

#include <vtkCPDataDescription.h>
#include <vtkCPInputDataDescription.h>
#include <vtkCPProcessor.h>
#include <vtkCPPythonScriptV2Helper.h>
#include <vtkCollection.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPythonInterpreter.h>
#include <vtkSMExtractTriggerProxy.h>
#include <vtkSMExtractsController.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

#include "base/data_folder.hpp"
#include "base/errors.hpp"
#include "base/json.hpp"
#include "insitu/headless_window.hpp"
#include "insitu/image_index.hpp"
#include "insitu/insitu_log.hpp"
#include "insitu/paint_module.hpp"
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
  Pipeline pipeline;
  vtkSmartPointer<vtkCPPythonScriptV2Helper> module;
  std::vector<vtkSMProxy*> extractors{};  ///< made when it was imported
  bool decides_itself = false;            ///< has a RequestDataDescription
  bool has_execute = false;               ///< has a catalyst_execute
  std::int64_t last_step = std::numeric_limits<std::int64_t>::min();
  PipelineCount count{};
};

std::filesystem::path images_folder(const PipelineSettings& settings) {
  return std::filesystem::path(settings.run_folder) / "images";
}

std::set<vtkSMProxy*> all_extractors() {
  vtkSMSessionProxyManager* manager = vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  vtkNew<vtkCollection> extractors;
  manager->GetProxies("extractors", extractors);
  std::set<vtkSMProxy*> found;
  for (int k = 0; k < extractors->GetNumberOfItems(); ++k)
    found.insert(vtkSMProxy::SafeDownCast(extractors->GetItemAsObject(k)));
  return found;
}

vtkSMExtractTriggerProxy* trigger_of(vtkSMProxy* options, const char* property) {
  return options ? vtkSMExtractTriggerProxy::SafeDownCast(vtkSMPropertyHelper(options, property).GetAsProxy())
                 : nullptr;
}

/// Whether a script's options say more than "at every step", which is what they say of themselves.
bool limits_steps(vtkSMProxy* options) {
  vtkSMProxy* trigger = trigger_of(options, "GlobalTrigger");
  if (!trigger) return false;
  return trigger->GetXMLName() != std::string("TimeStep") ||
         vtkSMPropertyHelper(trigger, "Frequency").GetAsInt() != 1 ||
         vtkSMPropertyHelper(trigger, "UseStartTimeStep").GetAsInt() == 1 ||
         vtkSMPropertyHelper(trigger, "UseEndTimeStep").GetAsInt() == 1;
}

bool is_live(vtkSMProxy* options) {
  return options && vtkSMPropertyHelper(options, "EnableCatalystLive").GetAsInt() == 1;
}

}  // namespace

struct CatalystBridge::State {
  PipelineSettings settings;
  LogRedirection redirection;
  ImageIndex index;
  VtkChannels wrapper;
  vtkNew<vtkCPProcessor> processor;
  vtkNew<vtkCPDataDescription> description;
  vtkNew<vtkSMExtractsController> clock;  ///< what triggers are asked with
  vtkNew<vtkPolyData> nothing;            ///< stands for a channel that is not there
  std::vector<Script> scripts;

  explicit State(PipelineSettings s)
      : settings(std::move(s)), redirection(settings.run_folder + "/insitu.log"), index(images_folder(settings)) {}

  void publish(std::span<const Channel> channels, std::int64_t step, double time);
  void tell_arguments(const Script& script) const;
  bool import(Script& script);
  bool run(Script& script);
  /// The lines that a Python expression yields, which is a list of texts. ejecta_pipelines is imported.
  std::vector<std::string> ask(const std::string& expression);
};

/// Hands the frame to ParaView: the settings through Python's environment, the data through the description.
void CatalystBridge::State::publish(std::span<const Channel> channels, std::int64_t step, double time) {
  const std::string assignment =
      "import os; os.environ['EJECTA_FRAME'] = " + to_json(frame_json(settings, channels)) + "\n";
  vtkPythonInterpreter::RunSimpleString(assignment.c_str());
  description->SetTimeData(time, step);
  for (const std::string& name : settings.channels) {
    description->AddInput(name.c_str());
    vtkCPInputDataDescription* input = description->GetInputDescriptionByName(name.c_str());
    input->AllFieldsOn();
    input->GenerateMeshOn();
    const auto channel = std::ranges::find(channels, name, &Channel::name);
    input->SetGrid(channel == channels.end() ? nothing.Get() : wrapper.wrap(*channel).Get());
  }
}

void CatalystBridge::State::tell_arguments(const Script& script) const {
  const std::string assignment = "ejecta_pipelines.arguments = " + json_list(script.pipeline.args) + "\n";
  vtkPythonInterpreter::RunSimpleString(assignment.c_str());
}

/// Runs the script's own lines, in which it registers its sources.
bool CatalystBridge::State::import(Script& script) {
  redirection.log().clear();
  tell_arguments(script);
  const std::set<vtkSMProxy*> before = all_extractors();
  if (!script.module->PrepareFromScript(script.pipeline.script) || !script.module->Import(description) ||
      !script.module->CatalystInitialize(description))
    return false;
  std::ranges::set_difference(all_extractors(), before, std::back_inserter(script.extractors));
  if (vtkSMProxy* options = script.module->GetOptions()) {  // its table would replace images/data.csv
    vtkSMPropertyHelper(options, "GenerateCinemaSpecification").Set(0);
    options->UpdateVTKObjects();
  }
  const std::string path = to_json(script.pipeline.script);
  script.decides_itself = !ask("ejecta_pipelines.defines(" + path + ", 'RequestDataDescription')").empty();
  script.has_execute = !ask("ejecta_pipelines.defines(" + path + ", 'catalyst_execute')").empty();
  return true;
}

bool CatalystBridge::State::run(Script& script) {
  redirection.log().clear();
  tell_arguments(script);
  return script.module->CatalystExecute(description) && !redirection.log().has_error();
}

std::vector<std::string> CatalystBridge::State::ask(const std::string& expression) {
  redirection.log().clear();
  redirection.log().keep_to_yourself(true);
  const std::string mark = "answer: ";  // VTK may say something besides
  const std::string program = "for answer in " + expression + ": print(" + to_json(mark) + " + answer)\n";
  vtkPythonInterpreter::RunSimpleString(program.c_str());
  redirection.log().keep_to_yourself(false);
  std::istringstream text(redirection.log().text());
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(mark)) lines.push_back(line.substr(mark.size()));
  redirection.log().clear();
  return lines;
}

CatalystBridge::CatalystBridge(const std::vector<Pipeline>& pipelines, PipelineSettings settings) {
  const KeepSignalHandlers keep;
  settings.run_folder = std::filesystem::absolute(settings.run_folder).string();
  const std::string images = images_folder(settings).string();
  setenv("PARAVIEW_OVERRIDE_EXTRACTS_OUTPUT_DIRECTORY", images.c_str(), 1);
  // MPI, which ParaView starts, would end the process where temporary files cannot be written. There is one process.
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  setenv("VTK_SILENCE_GET_VOID_POINTER_WARNINGS", "1", 1);  // some filters copy our separate x, y, z: that is fine
  state_ = std::make_unique<State>(std::move(settings));
  use_headless_window();
  offer_paint_module();
  vtkPythonInterpreter::Initialize(0);
  vtkPythonInterpreter::PrependPythonPath((data_folder() / "catalyst_scripts").c_str());
  // Without output to the terminal ParaView's Python logger would write every step it takes.
  vtkPythonInterpreter::RunSimpleString(
      "import logging, sys, paraview; paraview.logger.setLevel(logging.WARNING); sys.dont_write_bytecode = True\n");
  state_->processor->Initialize();
  state_->redirection.reinstate();  // ParaView has set its own
  vtkPythonInterpreter::RunSimpleString("import ejecta_pipelines; ejecta_pipelines.install()\n");
  constexpr double before_all_frames = -1;  // s
  state_->publish({}, -1, before_all_frames);
  std::vector<std::string> problems;
  for (const Pipeline& pipeline : pipelines) {
    Script script{pipeline, vtkSmartPointer<vtkCPPythonScriptV2Helper>::New()};
    script.count.name = std::filesystem::path(pipeline.script).stem().string();
    if (!state_->import(script)) problems.push_back(state_->redirection.log().reason(pipeline.script));
    state_->scripts.push_back(std::move(script));
  }
  if (!problems.empty()) throw ScriptError(std::move(problems));
}

bool CatalystBridge::reads(const char* channel) const {
  return vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager()->GetProxy("sources", channel) != nullptr;
}

CatalystBridge::~CatalystBridge() {
  if (!state_) return;
  const KeepSignalHandlers keep;
  for (Script& script : state_->scripts) script.module->CatalystFinalize();
  state_->scripts.clear();
  state_->processor->Finalize();
}

std::size_t CatalystBridge::size() const { return state_->scripts.size(); }

bool CatalystBridge::follows_frames(std::size_t pipeline) const {
  const Script& script = state_->scripts[pipeline];
  vtkSMProxy* options = script.module->GetOptions();
  if (script.decides_itself || limits_steps(options)) return false;
  return script.has_execute || (script.extractors.empty() && !is_live(options));
}

bool CatalystBridge::wants(std::size_t pipeline, std::int64_t step, double time) {
  Script& script = state_->scripts[pipeline];
  vtkSMProxy* options = script.module->GetOptions();
  const bool limited = limits_steps(options), live = is_live(options);
  if (script.extractors.empty() && !limited && !live && !script.decides_itself) return false;
  vtkSMExtractsController* clock = state_->clock;
  clock->SetTimeStep(static_cast<int>(step));
  clock->SetTime(time);
  if (vtkSMExtractTriggerProxy* all = trigger_of(options, "GlobalTrigger"); all && !all->IsActivated(clock))
    return false;
  if (script.decides_itself) {
    const KeepSignalHandlers keep;
    vtkCPDataDescription* description = state_->description;
    description->SetTimeData(time, step);
    for (const std::string& name : state_->settings.channels)
      description->GetInputDescriptionByName(name.c_str())->Reset();
    state_->tell_arguments(script);
    script.module->RequestDataDescription(description);
    return std::ranges::any_of(state_->settings.channels, [&](const std::string& name) {
      return description->GetInputDescriptionByName(name.c_str())->GetGenerateMesh();
    });
  }
  if (limited && script.has_execute) return true;
  if (vtkSMExtractTriggerProxy* trigger = live ? trigger_of(options, "CatalystLiveTrigger") : nullptr;
      trigger && trigger->IsActivated(clock))
    return true;
  return std::ranges::any_of(script.extractors, [&](vtkSMProxy* e) { return clock->IsTriggerActivated(e); });
}

std::vector<std::string> CatalystBridge::unknown_channels() {
  const KeepSignalHandlers keep;
  return state_->ask("ejecta_pipelines.unknown_channels(" + json_list(state_->settings.channels) + ")");
}

std::vector<std::string> CatalystBridge::unknown_fields(std::int64_t step, double time,
                                                        std::span<const Channel> channels) {
  const KeepSignalHandlers keep;
  state_->publish(channels, step, time);
  for (std::size_t k = 0; k < size(); ++k) {
    Script& script = state_->scripts[k];
    // Those that are not run at this step have no data yet: they take them and do nothing.
    if (script.last_step != step && !script.has_execute && !wants(k, step, time)) state_->run(script);
  }
  return state_->ask("ejecta_pipelines.unknown_fields()");
}

FrameReport CatalystBridge::execute(std::int64_t step, double time, std::span<const Channel> channels,
                                    std::span<const PipelineCall> calls) {
  FrameReport report;
  const KeepSignalHandlers keep;
  state_->publish(channels, step, time);
  for (const PipelineCall& call : calls) {
    Script& script = state_->scripts[call.pipeline];
    if (script.last_step == step) continue;
    script.last_step = step;
    ++script.count.frames;
    if (!state_->run(script)) {
      ++script.count.failures;
      report.failures.push_back({call.pipeline, state_->redirection.log().reason(script.pipeline.script)});
    }
    for (std::string& file : state_->index.add_new_files(step, time, call.reason))
      report.files.push_back(std::move(file));
  }
  return report;
}

void CatalystBridge::ignore_triggers() { vtkPythonInterpreter::RunSimpleString("ejecta_pipelines.fire_always()\n"); }

std::vector<PipelineCount> CatalystBridge::counts() const {
  std::vector<PipelineCount> list;
  for (const Script& script : state_->scripts) list.push_back(script.count);
  return list;
}

}  // namespace ejecta
