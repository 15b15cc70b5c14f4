#include "scene/every.hpp"

#include <fmt/format.h>

#include <charconv>

#include "base/errors.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

/// Takes the word, and blanks before it, from the end of the text.
bool take_end(std::string_view& text, std::string_view word) {
  if (!text.ends_with(word)) return false;
  text.remove_suffix(word.size());
  while (text.ends_with(' ')) text.remove_suffix(1);
  return true;
}

}  // namespace

Every parse_every(std::string_view text) {
  const auto refuse = [text]() -> Every {
    throw InputError(
        fmt::format("expected a time such as \"2 us\", a number of steps such as \"100 steps\", or a wall "
                    "time such as \"30 s wall\", got \"{}\"",
                    text));
  };
  Every every;
  std::string_view rest = text;
  if (take_end(rest, "steps") || take_end(rest, "step")) {
    if (rest.empty()) rest = "1";
    const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), every.steps);
    return failure == std::errc{} && end == rest.data() + rest.size() && every.steps > 0 ? every : refuse();
  }
  double& interval = take_end(rest, "wall") ? every.wall : every.time;
  try {
    interval = parse_quantity(rest, "s");
  } catch (const InputError&) {
    return refuse();
  }
  return interval > 0 && interval < std::numeric_limits<double>::infinity() ? every : refuse();
}

}  // namespace ejecta
