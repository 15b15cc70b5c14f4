#include "scene/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "base/errors.hpp"
#include "base/si_prefixes.hpp"

namespace ejecta {

namespace {

using Dimension = std::array<int, 5>;  // powers of kg, m, s, K, rad

/// A unit is factor * 10^ten times the SI unit of its dimension. Powers of ten are kept apart so that they can be added
/// to the exponent of the number: "3.43 mm" is read as 3.43e-3, the double nearest to it, and not as 3.43 * 0.001.
struct Unit {
  double factor = 1;
  int ten = 0;
  Dimension dimension{};
};

struct Symbol {
  std::string_view name;
  Unit unit;
};

constexpr std::array symbols{
    Symbol{"m", {1, 0, {0, 1, 0, 0, 0}}},
    Symbol{"g", {1, -3, {1, 0, 0, 0, 0}}},
    Symbol{"s", {1, 0, {0, 0, 1, 0, 0}}},
    Symbol{"K", {1, 0, {0, 0, 0, 1, 0}}},
    Symbol{"rad", {1, 0, {0, 0, 0, 0, 1}}},
    Symbol{"N", {1, 0, {1, 1, -2, 0, 0}}},
    Symbol{"J", {1, 0, {1, 2, -2, 0, 0}}},
    Symbol{"W", {1, 0, {1, 2, -3, 0, 0}}},
    Symbol{"Pa", {1, 0, {1, -1, -2, 0, 0}}},
    Symbol{"bar", {1, 5, {1, -1, -2, 0, 0}}},
    Symbol{"erg", {1, -7, {1, 2, -2, 0, 0}}},
    Symbol{"dyn", {1, -5, {1, 1, -2, 0, 0}}},
    Symbol{"min", {60, 0, {0, 0, 1, 0, 0}}},
    Symbol{"h", {3600, 0, {0, 0, 1, 0, 0}}},
    Symbol{"deg", {std::numbers::pi / 180, 0, {0, 0, 0, 0, 1}}},
};

/// Understood but never shown; the second is the Greek letter, which looks like the sign for micro.
constexpr std::array more_prefixes{SiPrefix{-2, "c"}, SiPrefix{-6, "\u03bc"}};

struct Noun {
  std::string_view unit, name, example;
};
constexpr std::array nouns{
    Noun{"1", "a number", "1.5"},
    Noun{"m", "a length", "1.2 mm"},
    Noun{"s", "a time", "20 us"},
    Noun{"m/s", "a speed", "5 km/s"},
    Noun{"kg", "a mass", "0.2 g"},
    Noun{"kg/m^3", "a density", "2.7 g/cm^3"},
    Noun{"Pa", "a pressure", "26.7 GPa"},
    Noun{"J/kg", "a specific energy", "4.72 MJ/kg"},
    Noun{"J/kg/K", "a specific heat", "800 J/kg/K"},
    Noun{"K", "a temperature", "300 K"},
    Noun{"rad", "an angle", "30 deg"},
    Noun{"1/m^3", "a number density", "5e34 1/m^3"},
    Noun{"1/s", "a rate", "1e3 1/s"},
    Noun{"any", "a quantity", "1 GPa"},
};

std::optional<Unit> find_symbol(std::string_view name) {
  for (const Symbol& symbol : symbols) {
    if (!name.ends_with(symbol.name)) continue;
    const std::string_view before = name.substr(0, name.size() - symbol.name.size());
    const auto fits = [&](const SiPrefix& prefix) { return before == prefix.symbol || before == prefix.typed; };
    Unit unit = symbol.unit;
    for (const std::span<const SiPrefix> list : {std::span<const SiPrefix>(si_prefixes), {more_prefixes}})
      if (const auto prefix = std::ranges::find_if(list, fits); prefix != list.end()) {
        unit.ten += prefix->ten;
        return unit;
      }
  }
  return std::nullopt;
}

/// Reads "kg/m^3", "J/kg/K", "1/m^3", "m s^-1". Empty text is the unit of a plain number. Nothing if it is no unit.
std::optional<Unit> parse_unit(std::string_view text) {
  Unit product;
  int sign = 1;  // +1 after a product sign, -1 after a division
  bool expect_factor = false;
  while (!text.empty()) {
    const char c = text.front();
    if (c == ' ' || c == '*' || c == '/') {
      if (c != ' ' && expect_factor) return std::nullopt;
      if (c == '/') sign = -1;
      expect_factor = expect_factor || c != ' ';
      text.remove_prefix(1);
      continue;
    }
    const std::size_t length = std::min(text.find_first_of(" */^"), text.size());
    const std::string_view name = text.substr(0, length);
    text.remove_prefix(length);
    int power = 1;
    if (text.starts_with('^')) {
      const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), power);
      if (error != std::errc{} || std::abs(power) > 9) return std::nullopt;
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    const std::optional<Unit> unit = name == "1" ? Unit{} : find_symbol(name);
    if (!unit) return std::nullopt;
    power *= sign;
    product.factor *= std::pow(unit->factor, power);
    product.ten += unit->ten * power;
    for (std::size_t k = 0; k < product.dimension.size(); ++k) product.dimension[k] += unit->dimension[k] * power;
    sign = 1;
    expect_factor = false;
  }
  if (expect_factor) return std::nullopt;
  return product;
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The double nearest to number * 10^ten; `number` as std::from_chars accepts it.
double shifted(std::string_view number, int ten) {
  const std::size_t e = number.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    const std::size_t digits = e + (number[e + 1] == '+' ? 2 : 1);
    std::from_chars(number.data() + digits, number.data() + number.size(), exponent);
  }
  const std::string text = fmt::format("{}e{}", number.substr(0, e), exponent + ten);
  double value = std::numeric_limits<double>::infinity();  // stays if out of range; an underflow is as good as zero
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc::result_out_of_range && ten < 0)
    return 0;
  return value;
}

}  // namespace

std::string expected_quantity(std::string_view si_unit) {
  if (si_unit == "1") return "a number such as 1.5";
  for (const Noun& noun : nouns)
    if (noun.unit == si_unit) return fmt::format("{} such as \"{}\"", noun.name, noun.example);
  return fmt::format("a quantity in {}", si_unit);
}

double parse_quantity(std::string_view text, std::string_view si_unit) {
  const auto fail = [&](std::string_view reason) {
    throw InputError(fmt::format("expected {}, got \"{}\"{}", expected_quantity(si_unit), text, reason));
  };
  std::string_view rest = trim(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc{}) fail("");
  if (!std::isfinite(value)) fail(" (not a finite number)");
  const std::string_view number = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
  rest.remove_prefix(number.size());
  const std::string_view unit_text = trim(rest);
  const std::optional<Unit> unit = parse_unit(unit_text);
  if (!unit) fail(fmt::format(" (unknown unit \"{}\")", unit_text));
  const bool any = si_unit == "any";
  if (!any && unit_text.empty() && si_unit != "1" && value != 0) fail(" (the unit is missing)");
  const bool bare_zero = unit_text.empty() && value == 0;
  if (!any && !bare_zero && unit->dimension != parse_unit(si_unit).value().dimension) fail("");
  value = shifted(number, unit->ten) * unit->factor;
  if (!std::isfinite(value)) fail(" (too large)");
  return value;
}

std::string format_quantity(double value, std::string_view si_unit) {
  if (si_unit == "1") return fmt::format("{:.4g}", value);
  if (si_unit == "kg/m^3" && std::abs(value) >= 100) return fmt::format("{:.4g} g/cm^3", value / 1000);
  if (si_unit == "kg" && std::abs(value) < 1) return format_quantity(value * 1000, "g");
  const std::string_view first = si_unit.substr(0, si_unit.find_first_of(" */^"));
  const bool takes_prefix =
      find_symbol(first) && first != "kg" && first != "rad" && !si_unit.substr(first.size()).starts_with('^');
  if (!takes_prefix || value == 0 || !std::isfinite(value)) return fmt::format("{:.4g} {}", value, si_unit);
  // The rounded value decides, so that 0.99999 ms reads "1 ms" and not "1000 us".
  const double rounded = std::abs(std::stod(fmt::format("{:.4g}", value)));
  const int step = static_cast<int>(std::floor(std::log10(rounded) / 3 + 1e-12));
  const SiPrefix& prefix = *std::ranges::find_if(
      si_prefixes, [&](const SiPrefix& p) { return p.ten <= 3 * step || &p == &si_prefixes.back(); });
  return fmt::format("{:.4g} {}{}", value / prefix.factor(), prefix.typed, si_unit);
}

std::string format_exact(double value, std::string_view si_unit) {
  return si_unit == "1" || si_unit == "any" ? fmt::format("{}", value) : fmt::format("{} {}", value, si_unit);
}

}  // namespace ejecta
