#pragma once
/// Feeds the monitor page.
#include <filesystem>

#include "observe/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/monitor.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

class Status final : public Observer {
 public:
  Status(const Simulation& sim, std::filesystem::path folder, const Frames& frames, FragmentContext context);
  void observe(Simulation& sim, bool last) override;
  /// The last word of the run.
  void conclude(const Simulation& sim, RunState state, int exit_code);
  /// The last word of a run that cannot write its files: the status of before, marked as failed.
  void give_up(int exit_code);

 private:
  void gather(const Simulation& sim);

  std::filesystem::path folder_;
  const Frames& frames_;
  Monitor monitor_;
  MonitorStatus status_;
  FragmentContext context_;
  double first_time_, first_wall_, first_total_, first_work_;
};

}  // namespace ejecta
