#pragma once
/// What happens in a run and is worth a picture.
#include <array>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/every.hpp"

namespace ejecta {

/// What events are told from; what a solver does not know is not a number, and nothing is told from it.
struct Signs {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double momentum_change = unknown;   ///< of the body that has changed most, over its mass times the largest speed
  double pressure = unknown;          ///< highest there is [Pa]
  double noteworthy_pressure = 0;     ///< lower ones are no peak [Pa]
  double fragments = unknown;         ///< number of them
  double largest_fragment = unknown;  ///< its mass over that of the target
  double time_step = unknown;         ///< s, not shortened to end at a time
};

/// Notices these events:
///  - first contact: momentum of a body changes, by more than a millionth;
///  - peak pressure passed: the highest pressure has fallen below 0.8 of the highest so far;
///  - first fragment: there are more fragments than at the first look;
///  - largest fragment changed: by more than 5 % of the target since the first look or the last such event;
///  - time step collapsed: below a tenth of the longest so far, or of that of the last such event.
/// The first three happen once.
class EventWatch {
 public:
  explicit EventWatch(const std::vector<std::string>& wanted);

  bool wants(Event event) const { return wanted_[static_cast<std::size_t>(event)]; }
  bool wants_any() const;
  /// What has happened since the last look, in words.
  std::vector<std::string_view> look(const Signs& signs);

  /// All that it remembers, by name.
  std::map<std::string, double> memory() const;
  void remember(const std::map<std::string, double>& memory);

 private:
  static constexpr std::size_t count = event_words.size();
  std::array<bool, count> wanted_{}, happened_{};
  double highest_pressure_ = 0, fragments_ = Signs::unknown, largest_fragment_ = Signs::unknown, time_step_ = 0;

  bool happens(Event event, const Signs& signs);
};

}  // namespace ejecta
