#pragma once
/// Feeds the monitor page.
#include <filesystem>

#include "app/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/monitor.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

template <int Dim>
class Watch final : public Observer<Dim> {
 public:
  Watch(const Simulation<Dim>& sim, std::filesystem::path folder, const Frames<Dim>& frames);
  double next_time() const override { return std::numeric_limits<double>::infinity(); }
  void observe(Simulation<Dim>& sim, bool last) override;
  /// The last word of the run.
  void conclude(const Simulation<Dim>& sim, RunState state, int exit_code);
  /// The last word of a run that cannot write its files: the status of before, marked as failed.
  void give_up();

 private:
  void gather(const Simulation<Dim>& sim);

  std::filesystem::path folder_;
  const Frames<Dim>& frames_;
  Monitor monitor_;
  MonitorStatus status_;
  FragmentContext context_;
  double first_time_, first_wall_;
};

}  // namespace ejecta
