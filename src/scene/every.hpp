#pragma once
/// The words with which a scene says when something is drawn.
#include <array>
#include <cstdint>
#include <string_view>

#include "scene/choices.hpp"

namespace ejecta {

/// Every so much simulated time, every so many steps, or every so much wall time: one of them is set.
struct Every {
  double time = unset;  ///< s
  std::int64_t steps = 0;
  double wall = unset;  ///< s
};

/// "2 us", "100 steps" ("step" for each) or "30 s wall". Throws InputError saying what was expected.
Every parse_every(std::string_view text);

/// What insitu.events may name, in the order of enum Event.
inline constexpr auto event_words = std::to_array<std::string_view>(
    {"first contact", "peak pressure passed", "first fragment", "largest fragment changed", "time step collapsed"});
enum class Event { first_contact, peak_pressure_passed, first_fragment, largest_fragment_changed, time_step_collapsed };

}  // namespace ejecta
