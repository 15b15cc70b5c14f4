#include "render/display_unit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/si_prefixes.hpp"

namespace ejecta {

namespace {
std::string with_superscripts(std::string unit) {
  for (const auto& [plain, raised] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}})
    for (std::size_t at; (at = unit.find(plain)) != std::string::npos;) unit.replace(at, 2, raised);
  return unit;
}
}  // namespace

DisplayUnit display_unit(double magnitude, const std::string& unit) {
  if (unit == "1") return {1, ""};
  const bool prefixable = unit.find('^') == std::string::npos && !unit.starts_with("kg");
  if (!prefixable || !(std::abs(magnitude) > 0) || !std::isfinite(magnitude)) return {1, with_superscripts(unit)};
  for (const SiPrefix& p : si_prefixes)
    if (std::abs(magnitude) >= p.factor() * (1 - 1e-9)) return {p.factor(), std::string(p.symbol) + unit};
  return {1, unit};
}

std::vector<double> round_ticks(double min, double max, int count) {
  const double range = max - min;
  if (!(range > 0) || !std::isfinite(range)) return {min};
  const double rough = range / count, power = std::pow(10, std::floor(std::log10(rough)));
  const double lead = rough / power, step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  const double slack = 1e-9 * range;
  for (double k = std::ceil((min - slack) / step); k * step <= max + slack; ++k) ticks.push_back(k * step + 0.0);
  return ticks;
}

std::string short_number(double value) {
  const double size = std::abs(value);
  if (size >= 1e4 && size < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", size < 1e-300 ? 0.0 : value);
}

std::string time_text(double time, double end) {
  const DisplayUnit unit = display_unit(end, "s");
  const double shown_end = end / unit.si;
  const int decimals = shown_end >= 100 ? 0 : shown_end >= 10 ? 1 : 2;
  return fmt::format("{:.{}f} {}", time / unit.si, decimals, unit.label);
}

}  // namespace ejecta
