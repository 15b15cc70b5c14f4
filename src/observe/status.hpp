#pragma once
/// Feeds the monitor page.
#include <filesystem>

#include "observe/frames.hpp"
#include "observe/pace.hpp"
#include "output/fragment_files.hpp"
#include "output/monitor.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

class Status final : public Observer {
 public:
  Status(const Simulation& sim, std::filesystem::path folder, const Frames& frames, FragmentContext context,
         Outputs& outputs);
  void observe(Simulation& sim, bool last) override;
  /// Shows what was asked of the run, and what became of it.
  void note(std::string answer) { status_.control.push_back(std::move(answer)); }
  /// Shows the state of a run between two steps, at once.
  void show(const Simulation& sim, RunState state);
  /// The last word of the run.
  void conclude(const Simulation& sim, RunState state, int exit_code);
  /// The last word of a run that cannot write its files: the status of before, marked as failed.
  void give_up(int exit_code);

 private:
  void gather(const Simulation& sim);
  void gather_limit(const Simulation& sim);

  std::filesystem::path folder_;
  const Frames& frames_;
  Outputs& outputs_;
  Monitor monitor_;
  MonitorStatus status_;
  FragmentContext context_;
  Pace pace_;
  double first_wall_, first_work_;
};

}  // namespace ejecta
