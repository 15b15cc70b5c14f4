#pragma once
/// history.csv, largest_fragment.csv and the progress line.
#include <chrono>
#include <filesystem>

#include "observe/frames.hpp"
#include "observe/pace.hpp"
#include "observe/schedule.hpp"
#include "output/fragment_files.hpp"
#include "output/history.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// What the fragment tables are told about the run; without bodies if there are no particles.
FragmentContext fragment_context(const Simulation& sim);

/// The quantities of the simulation, and of its fragments where they are looked for.
Quantities quantities(const Simulation& sim, const Frames& frames, const FragmentContext& context);

class Tables final : public Observer {
 public:
  Tables(const Scene& scene, const std::filesystem::path& folder, Frames& frames, FragmentContext context,
         Outputs& outputs, const std::optional<Clock>& resume_at);
  double next_time() const override { return due_.next_time(); }
  void observe(Simulation& sim, bool last) override;

 private:
  RowTimes due_;
  Frames& frames_;
  Outputs& outputs_;
  FragmentContext context_;
  History history_;
  std::optional<LargestFragmentHistory> largest_;
  bool warned_ = false;  ///< that angular momentum drifts
};

/// One line every few seconds: time, step and what limits it, speed, energy error, time to go.
class Progress final : public Observer {
 public:
  void observe(Simulation& sim, bool last) override;

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point start_ = clock::now(), shown_{};
  bool started_ = false;
  double start_wall_ = 0, start_work_ = 0;
  Pace pace_;
};

}  // namespace ejecta
