#pragma once
/// The simulation's end of ParaView Catalyst: live channels go in, images and other extracts come out.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "insitu/pipelines.hpp"
#include "model/channel.hpp"

namespace ejecta {

/// A pipeline that is to be run, and why.
struct PipelineCall {
  std::size_t pipeline;  ///< its place in the list
  std::string reason;    ///< stands in images/data.csv
};

/// Scripts cannot be imported, fail on the first data, or name what does not exist.
class ScriptError : public InputError {
 public:
  using InputError::InputError;
};

/// What one call of CatalystBridge::execute did.
struct FrameReport {
  struct Failure {
    std::size_t pipeline;
    std::string text;  ///< one line: script, line, error
  };
  std::vector<std::string> files;  ///< paths of all that was written, each with its row in images/data.csv
  std::vector<Failure> failures;
};

/// How often a pipeline was run, and how often it failed.
struct PipelineCount {
  std::string name;  ///< file name of the script without its ending
  std::int64_t frames = 0, failures = 0;
};

/// One per process: ParaView can be started only once. The signal handlers that are installed when the bridge is made,
/// or later, stay as they are.
class CatalystBridge {
 public:
  /// Starts ParaView with off-screen windows and runs what the scripts do before the first frame. They are absolute
  /// paths that have passed check_pipeline_scripts. VTK's and the scripts' messages go to <run_folder>/insitu.log.
  /// Throws ScriptError naming every script that cannot be imported.
  CatalystBridge(const std::vector<Pipeline>& pipelines, PipelineSettings settings);
  ~CatalystBridge();
  CatalystBridge(const CatalystBridge&) = delete;
  CatalystBridge& operator=(const CatalystBridge&) = delete;

  /// Has a script registered a source of this channel? Channels that nobody reads need not be made.
  bool reads(const char* channel) const;

  std::size_t size() const;
  /// Whether a pipeline is to be run with the frames: it is unless its script leaves all to triggers of its own.
  bool follows_frames(std::size_t pipeline) const;
  /// Whether triggers of the script itself (of its extractors, of its options, of Catalyst Live, or its own
  /// RequestDataDescription) say that it is to be run at this step. To be asked at every step; costs nothing for a
  /// script without.
  bool wants(std::size_t pipeline, std::int64_t step, double time);

  /// A line for each channel that scripts name and the run has not.
  std::vector<std::string> unknown_channels();
  /// The same of fields, once there are data: of filters, displays and extracts that there are so far.
  std::vector<std::string> unknown_fields(std::int64_t step, double time, std::span<const Channel> channels);

  /// Shows the channels to these pipelines, without copying them, and adds what they write to images/data.csv. No
  /// pipeline is run twice at the same step.
  FrameReport execute(std::int64_t step, double time, std::span<const Channel> channels,
                      std::span<const PipelineCall> calls);

  /// From now on extractors write at every call, whatever their triggers say.
  void ignore_triggers();

  /// In the order of the pipelines.
  std::vector<PipelineCount> counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ejecta
