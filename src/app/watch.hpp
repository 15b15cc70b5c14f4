#pragma once
/// Feeds the monitor page.
#include <filesystem>

#include "observe/frames.hpp"
#include "output/fragment_files.hpp"
#include "output/monitor.hpp"
#include "sph/sph.hpp"

namespace ejecta {

template <int Dim>
class Watch final : public Observer<Dim> {
 public:
  Watch(const Sph<Dim>& sim, std::filesystem::path folder, const Frames<Dim>& frames);
  double next_time() const override { return std::numeric_limits<double>::infinity(); }
  void observe(Sph<Dim>& sim, bool last) override;
  /// The last word of the run.
  void conclude(const Sph<Dim>& sim, RunState state);

 private:
  void gather(const Sph<Dim>& sim);

  std::filesystem::path folder_;
  const Frames<Dim>& frames_;
  Monitor monitor_;
  MonitorStatus status_;
  FragmentContext context_;
  double first_time_, first_wall_;
};

}  // namespace ejecta
