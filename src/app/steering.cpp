#include "app/steering.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <thread>

#include "app/control.hpp"
#include "app/signals.hpp"
#include "base/errors.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

constexpr std::chrono::milliseconds between_looks{200}, between_tending{1000}, between_reports{5000};

std::string now(const Simulation& sim) {
  return fmt::format("at t = {}, step {}", format_quantity(sim.clock.time, "s"), sim.clock.step);
}

}  // namespace

Steering::Steering(std::filesystem::path folder, Frames& frames, Checkpoints& checkpoints, Status& status,
                   std::vector<Observer*> observers, std::function<void()> tend)
    : folder_(std::move(folder)),
      frames_(frames),
      checkpoints_(checkpoints),
      status_(status),
      observers_(std::move(observers)),
      tend_(std::move(tend)) {}

bool Steering::stops(Simulation& sim) {
  look(sim);
  if (paused_) wait(sim);
  return !stopped_by_.empty();
}

bool Steering::look(Simulation& sim) {
  if (stop_requested()) stopped_by_ = "a signal";
  if (take_checkpoint_request()) checkpoints_.ask();
  const auto time = WallClock::now();
  if (time - looked_ < between_looks) return false;
  looked_ = time;
  if (time - tended_ >= between_tending) {
    tended_ = time;
    tend_();
  }
  const std::vector<std::string> lines = take_control(folder_);
  for (const std::string& line : lines) {
    std::string answer;
    auto level = spdlog::level::info;
    try {
      answer = obey(sim, line);
    } catch (const InputError& error) {
      answer = fmt::format("ignored: {}", error.what());
      level = spdlog::level::warn;
    }
    status_.note(line + ": " + answer);
    status_.show(sim, paused_ ? RunState::paused : RunState::running);
    spdlog::log(level, "{}{}: {}", control_mark, line, answer);
  }
  return !lines.empty();
}

std::string Steering::obey(Simulation& sim, const std::string& line) {
  using What = ControlLine::What;
  const ControlLine asked = parse_control(line);
  switch (asked.what) {
    case What::stop:
      stopped_by_ = "control";
      return "stops " + now(sim);
    case What::pause:
      paused_ = true;
      return "paused " + now(sim);
    case What::resume:
      if (!paused_) return "was not paused";
      paused_ = false;
      return "goes on " + now(sim);
    case What::checkpoint:
      checkpoints_.ask();
      return "written " + now(sim);
    case What::frame:
      frames_.ask();
      return "drawn " + now(sim);
    case What::end:
      if (asked.value <= sim.clock.time)
        throw InputError(
            fmt::format("end: expected a time to come, got {} {}", format_quantity(asked.value, "s"), now(sim)));
      sim.scene.time_end = asked.value;
      return "ends at " + format_quantity(asked.value, "s");
    case What::every:
      frames_.change_interval(sim, asked.value);
      return fmt::format("a frame every {} from t = {} on", format_quantity(asked.value, "s"),
                         format_quantity(sim.clock.time, "s"));
  }
  return "";
}

void Steering::refuse_the_rest() {
  for (const std::string& line : take_control(folder_))
    spdlog::warn("{}{}: ignored: the run has ended", control_mark, line);
}

/// The state between two steps is shown and kept, and whatever is asked for is done with it.
void Steering::wait(Simulation& sim) {
  const auto report = [&] {
    for (Observer* observer : observers_) observer->observe(sim, false);
    status_.show(sim, RunState::paused);
  };
  report();
  for (auto reported = WallClock::now(); paused_ && stopped_by_.empty();) {
    std::this_thread::sleep_for(between_looks / 2);
    if (!look(sim) && WallClock::now() - reported < between_reports) continue;
    reported = WallClock::now();
    report();
  }
}

}  // namespace ejecta
