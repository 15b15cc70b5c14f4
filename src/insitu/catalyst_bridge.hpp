#pragma once
/// The simulation's end of ParaView Catalyst: live channels go in, images come out.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "insitu/pipelines.hpp"
#include "model/channel.hpp"

namespace ejecta {

/// What one call of CatalystBridge::execute did.
struct FrameReport {
  struct Pipeline {
    std::string name;    ///< file name of the script without its ending
    double seconds = 0;  ///< wall time
  };
  std::vector<std::string> images;    ///< paths of the images written, each with its row in images/data.csv
  std::vector<std::string> warnings;  ///< one line for each script that failed for the first time
  std::vector<Pipeline> pipelines;
};

/// One per process: ParaView can be started only once. The signal handlers that are installed when the bridge is made,
/// or later, stay as they are.
class CatalystBridge {
 public:
  /// Starts ParaView with off-screen windows and runs what the scripts do before the first frame. They are absolute
  /// paths that have passed check_pipeline_scripts. VTK's and the scripts' messages go to <run_folder>/insitu.log.
  /// Throws InputError if a script cannot be loaded.
  CatalystBridge(const std::vector<std::string>& scripts, PipelineSettings settings);
  ~CatalystBridge();
  CatalystBridge(const CatalystBridge&) = delete;
  CatalystBridge& operator=(const CatalystBridge&) = delete;

  /// Has a script registered a source of this channel (of channel_names, or one more of the settings)? Channels that nobody reads need not be
  /// made.
  bool reads(const char* channel) const;

  /// Shows the channels to every script, without copying them, and adds new images to images/data.csv. A step that has
  /// been shown already is not shown again. A script that fails is reported once, counted, and tried again next time.
  FrameReport execute(std::int64_t step, double time, std::span<const Channel> channels);

  /// Number of calls of scripts that failed.
  int failures() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ejecta
