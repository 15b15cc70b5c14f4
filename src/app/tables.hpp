#pragma once
/// history.csv, largest_fragment.csv, the monitor page and the progress line.
#include <chrono>
#include <filesystem>

#include "observe/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/history.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// One row of history.csv for the present state.
template <int Dim>
HistoryRow history_row(const Sph<Dim>& sim, const std::optional<FragmentTable>& fragments);

/// What the fragment tables are told about the run.
template <int Dim>
FragmentContext fragment_context(const Sph<Dim>& sim);

template <int Dim>
class Tables final : public Observer<Dim> {
 public:
  Tables(const Sph<Dim>& sim, const std::filesystem::path& folder, Frames<Dim>& frames,
         std::optional<double> resume_at);
  double next_time() const override { return std::numeric_limits<double>::infinity(); }
  void observe(Sph<Dim>& sim, bool last) override;

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
  void observe(Sph<Dim>& sim, bool last) override;

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point start_ = clock::now(), shown_{};
  double start_time_ = -1;
  std::int64_t shown_step_ = 0;
};

}  // namespace ejecta
