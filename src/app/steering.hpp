#pragma once
/// What people ask of a run while it goes on, by signals and by lines of control.
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "observe/checkpoints.hpp"
#include "observe/frames.hpp"
#include "observe/status.hpp"

namespace ejecta {

class Steering {
 public:
  /// `observers` look at the state of a pause too; `tend` is called about once a second.
  Steering(std::filesystem::path folder, Frames& frames, Checkpoints& checkpoints, Status& status,
           std::vector<Observer*> observers, std::function<void()> tend);
  /// To be called before every step: does what has been asked for, and waits while the run is paused. Returns whether
  /// the run is to stop.
  bool stops(Simulation& sim);
  /// Answers what has come too late.
  void refuse_the_rest();
  /// Who has stopped the run.
  const std::string& stopped_by() const { return stopped_by_; }

 private:
  /// Returns whether a line of control was there.
  bool look(Simulation& sim);
  std::string obey(Simulation& sim, const std::string& line);
  void wait(Simulation& sim);

  using WallClock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  Frames& frames_;
  Checkpoints& checkpoints_;
  Status& status_;
  std::vector<Observer*> observers_;
  std::function<void()> tend_;
  WallClock::time_point looked_{}, tended_ = WallClock::now();
  bool paused_ = false;
  std::string stopped_by_;
};

}  // namespace ejecta
