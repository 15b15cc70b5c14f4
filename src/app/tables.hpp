#pragma once
/// history.csv, largest_fragment.csv, the monitor page and the progress line.
#include <chrono>
#include <filesystem>

#include "app/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/history.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// One row of history.csv for the present state.
template <int Dim>
HistoryRow history_row(const Simulation<Dim>& sim, const std::optional<FragmentTable>& fragments);

/// What the fragment tables are told about the run.
template <int Dim>
FragmentContext fragment_context(const Simulation<Dim>& sim);

template <int Dim>
class Tables final : public Observer<Dim> {
 public:
  Tables(const Simulation<Dim>& sim, const std::filesystem::path& folder, Frames<Dim>& frames,
         std::optional<double> resume_at);
  double next_time() const override { return std::numeric_limits<double>::infinity(); }
  void observe(Simulation<Dim>& sim, bool last) override;

 private:
  double interval_;
  double next_ = 0;
  Frames<Dim>& frames_;
  History history_;
  std::optional<LargestFragmentHistory> largest_;
  bool warned_ = false;  ///< that angular momentum drifts
};

/// One line every few seconds: time, step and what limits it, speed, energy error, time to go.
template <int Dim>
class Progress final : public Observer<Dim> {
 public:
  double next_time() const override { return std::numeric_limits<double>::infinity(); }
  void observe(Simulation<Dim>& sim, bool last) override;

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point start_ = clock::now(), shown_{};
  double start_time_ = -1, start_wall_ = 0;  ///< of this part of the run [s]
  std::int64_t start_step_ = 0;
};

}  // namespace ejecta
