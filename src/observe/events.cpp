#include "observe/events.hpp"

#include <algorithm>
#include <cmath>

namespace ejecta {

namespace {

constexpr double changed_momentum = 1e-6, past_the_peak = 0.8, changed_fragment = 0.05, collapsed = 0.1;

bool once(Event event) {
  return event == Event::first_contact || event == Event::peak_pressure_passed || event == Event::first_fragment;
}

}  // namespace

EventWatch::EventWatch(const std::vector<std::string>& wanted) {
  for (std::size_t k = 0; k < count; ++k) wanted_[k] = std::ranges::find(wanted, event_words[k]) != wanted.end();
}

bool EventWatch::wants_any() const {
  return std::ranges::any_of(wanted_, [](bool wanted) { return wanted; });
}

bool EventWatch::happens(Event event, const Signs& s) {
  switch (event) {
    case Event::first_contact:
      return s.momentum_change > changed_momentum;
    case Event::peak_pressure_passed:
      highest_pressure_ = std::fmax(highest_pressure_, s.pressure);
      return highest_pressure_ > s.noteworthy_pressure && s.pressure < past_the_peak * highest_pressure_;
    case Event::first_fragment:
      if (std::isnan(fragments_)) fragments_ = s.fragments;
      return s.fragments > fragments_;
    case Event::largest_fragment_changed:
      if (std::isnan(largest_fragment_)) largest_fragment_ = s.largest_fragment;
      if (!(std::abs(s.largest_fragment - largest_fragment_) > changed_fragment)) return false;
      largest_fragment_ = s.largest_fragment;
      return true;
    case Event::time_step_collapsed:
      if (s.time_step < collapsed * time_step_) {
        time_step_ = s.time_step;
        return true;
      }
      if (!happened_[static_cast<std::size_t>(event)]) time_step_ = std::fmax(time_step_, s.time_step);
      return false;
  }
  return false;
}

std::vector<std::string_view> EventWatch::look(const Signs& signs) {
  std::vector<std::string_view> words;
  for (std::size_t k = 0; k < count; ++k) {
    const Event event = static_cast<Event>(k);
    if (!wanted_[k] || (happened_[k] && once(event)) || !happens(event, signs)) continue;
    happened_[k] = true;
    words.push_back(event_words[k]);
  }
  return words;
}

std::map<std::string, double> EventWatch::memory() const {
  std::map<std::string, double> memory{{"highest pressure", highest_pressure_},
                                       {"fragments", fragments_},
                                       {"largest fragment", largest_fragment_},
                                       {"time step", time_step_}};
  for (std::size_t k = 0; k < count; ++k) memory[std::string(event_words[k])] = happened_[k];
  return memory;
}

void EventWatch::remember(const std::map<std::string, double>& memory) {
  const auto recall = [&](const std::string& name, auto& value) {
    if (const auto found = memory.find(name); found != memory.end())
      value = static_cast<std::decay_t<decltype(value)>>(found->second);
  };
  recall("highest pressure", highest_pressure_);
  recall("fragments", fragments_);
  recall("largest fragment", largest_fragment_);
  recall("time step", time_step_);
  for (std::size_t k = 0; k < count; ++k) recall(std::string(event_words[k]), happened_[k]);
}

}  // namespace ejecta
