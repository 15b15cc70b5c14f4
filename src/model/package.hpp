#pragma once
/// A solver as the time loop sees it. What it solves, and with which fields, is its own affair.
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/timers.hpp"
#include "model/archive.hpp"
#include "model/channel.hpp"
#include "model/clock.hpp"
#include "model/conserved.hpp"
#include "model/quantity.hpp"
#include "model/shock_front.hpp"

namespace ejecta {

/// The longest step somebody can bear, and why.
struct Vote {
  static constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
  double dt = std::numeric_limits<double>::infinity();  ///< s
  std::string_view reason = "end of run";
  std::size_t culprit = nobody;  ///< particle, cell, ...: Package::describe() knows
};

/// Where a culprit is. Asked for in every step, so that nothing is allocated.
struct Whereabouts {
  std::string_view body;      ///< that it belongs to, of the package; may be empty
  std::array<double, 3> x{};  ///< its first coordinates [m]
  std::size_t dimension = 0;  ///< how many of them; 0: it has no place
  std::vector<double> place() const { return {x.begin(), x.begin() + static_cast<std::ptrdiff_t>(dimension)}; }
};

/// Something to say when a run is over.
struct Remark {
  std::string text;
  bool worrying = false;
};

/// Whether somebody reads the channel of this name.
using Asked = std::function<bool(const char*)>;

class Package {
 public:
  virtual ~Package() = default;
  /// Of files, messages and timers; unique among the packages of a run.
  virtual std::string_view name() const = 0;

  /// The longest step it can bear from here. Whoever can take several steps of his own within one need not vote.
  virtual Vote vote() = 0;
  /// Carries its state on by dt [s], and its clock with it. Throws SimulationError.
  virtual void advance(double dt) = 0;
  /// Throws SimulationError if its state makes no sense.
  virtual void check_health() const = 0;

  /// Sums over its present state; what acts on it from outside is in `external`.
  virtual Totals conserved() const = 0;
  virtual Kept kept() const { return {}; }
  /// Whether loads from outside may act on it.
  virtual bool is_loaded() const { return false; }
  /// Everything from which it goes on bit for bit, but for clock and ledger, which every package has.
  virtual void persist(Archive& archive) = 0;

  virtual Quantities quantities() const { return {}; }
  /// What it does, for `ejecta check`: lines of text.
  virtual std::string outline() const { return ""; }
  virtual std::vector<Remark> remarks() const { return {}; }
  /// The same of what has been set up, to be said before the run.
  virtual std::vector<Remark> remarks_at_start() const { return {}; }
  /// Channels that it has, by name.
  virtual std::vector<std::string> channel_names() const { return {}; }
  /// Live fields for the in-situ pipelines, of the channels that are asked for; the views are good until the next step.
  virtual std::vector<Channel> channels(const Asked&) const { return {}; }
  /// Of a culprit, for messages.
  virtual std::string describe(std::size_t culprit) const = 0;
  virtual Whereabouts whereabouts(std::size_t /*culprit*/) const { return {}; }
  /// The blast of the charge; nothing without one, or before there is a shock.
  virtual std::optional<BlastFront> blast() const { return std::nullopt; }
  virtual std::string_view element() const { return "element"; }  ///< what it is made of: "particle", "cell"
  virtual std::size_t elements() const = 0;                       ///< how many
  /// Steps of single elements so far: what the speed is counted in.
  virtual double element_steps() const { return static_cast<double>(elements()) * static_cast<double>(clock.step); }
  virtual std::size_t bytes() const = 0;  ///< memory

  /// Solvers that it drives: they are saved and shown like those of the run, which does not step them itself.
  virtual std::vector<Package*> parts() { return {}; }

  Clock clock;
  Totals initial;         ///< conserved() at the start
  ExternalLoad external;  ///< on it
  StageTimers timers;
};

}  // namespace ejecta
