#include "scene/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/errors.hpp"
#include "base/si_prefixes.hpp"

namespace ejecta {
namespace {

std::string refusal(const std::string& text, const std::string& unit) {
  try {
    parse_quantity(text, unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseQuantity, ConvertsToSi) {
  EXPECT_EQ(parse_quantity("2.7 g/cm^3", "kg/m^3"), 2700);
  EXPECT_EQ(parse_quantity("5 km/s", "m/s"), 5000);
  EXPECT_EQ(parse_quantity("20us", "s"), 20e-6);
  EXPECT_EQ(parse_quantity("20 µs", "s"), 20e-6);
  EXPECT_EQ(parse_quantity("1e6 Pa", "Pa"), 1e6);
  EXPECT_EQ(parse_quantity("26.7 GPa", "Pa"), 26.7e9);
  EXPECT_EQ(parse_quantity("1 Mbar", "Pa"), 1e11);
  EXPECT_EQ(parse_quantity("4.72 MJ/kg", "J/kg"), 4.72e6);
  EXPECT_EQ(parse_quantity("1e10 erg/g", "J/kg"), 1e6);
  EXPECT_EQ(parse_quantity("800 J/kg/K", "J/kg/K"), 800);
  EXPECT_EQ(parse_quantity("800 J kg^-1 K^-1", "J/kg/K"), 800);
  EXPECT_EQ(parse_quantity("5e28 1/cm^3", "1/m^3"), 5e34);
  EXPECT_EQ(parse_quantity("5e34 m^-3", "1/m^3"), 5e34);
  EXPECT_DOUBLE_EQ(parse_quantity("-30 deg", "rad"), -std::numbers::pi / 6);
  EXPECT_EQ(parse_quantity("2 min", "s"), 120);
  EXPECT_EQ(parse_quantity("1 N/mm^2", "Pa"), 1e6);
  EXPECT_EQ(parse_quantity("1.3", "1"), 1.3);
  EXPECT_EQ(parse_quantity("+1.5 m", "m"), 1.5);
}

TEST(ParseQuantity, DecimalPrefixesAreExact) {
  EXPECT_EQ(parse_quantity("1.2 mm", "m"), 0.0012);
  EXPECT_EQ(parse_quantity("0.7 g/cm^3", "kg/m^3"), 700);
  EXPECT_EQ(parse_quantity("3.43 mm", "m"), 0.00343);
  EXPECT_EQ(parse_quantity("3.43e+0 mm", "m"), 0.00343);
  EXPECT_EQ(parse_quantity("1e-323 mm", "m"), 0);
}

TEST(ParseQuantity, EveryPrefixThatIsShownIsReadAsItIsShownAndTyped) {
  for (const SiPrefix& prefix : si_prefixes) {
    EXPECT_EQ(parse_quantity("1 " + std::string(prefix.symbol) + "Pa", "Pa"), prefix.factor());
    EXPECT_EQ(parse_quantity("1 " + std::string(prefix.typed) + "Pa", "Pa"), prefix.factor());
    EXPECT_EQ(format_quantity(prefix.factor(), "Pa"), "1 " + std::string(prefix.typed) + "Pa");
  }
  EXPECT_EQ(parse_quantity("1 \u03bcs", "s"), 1e-6);  // the Greek letter
  EXPECT_EQ(parse_quantity("3 cm", "m"), 0.03);
  EXPECT_EQ(format_quantity(3e15, "Pa"), "3000 TPa");
  EXPECT_EQ(format_quantity(3e-17, "Pa"), "0.03 fPa");
}

TEST(ParseQuantity, ZeroNeedsNoUnit) { EXPECT_EQ(parse_quantity("0", "m/s"), 0); }

TEST(ParseQuantity, AnyUnitTakesAll) {
  EXPECT_EQ(parse_quantity("1 GPa", "any"), 1e9);
  EXPECT_EQ(parse_quantity("3", "any"), 3);
}

TEST(ParseQuantity, RefusesWithReason) {
  EXPECT_EQ(refusal("5 km", "m/s"), "expected a speed such as \"5 km/s\", got \"5 km\"");
  EXPECT_EQ(refusal("5", "m/s"), "expected a speed such as \"5 km/s\", got \"5\" (the unit is missing)");
  EXPECT_EQ(refusal("5 kms", "m/s"), "expected a speed such as \"5 km/s\", got \"5 kms\" (unknown unit \"kms\")");
  EXPECT_EQ(refusal("fast", "m/s"), "expected a speed such as \"5 km/s\", got \"fast\"");
  EXPECT_EQ(refusal("", "m"), "expected a length such as \"1.2 mm\", got \"\"");
  EXPECT_EQ(refusal("inf m", "m"), "expected a length such as \"1.2 mm\", got \"inf m\" (not a finite number)");
  EXPECT_EQ(refusal("1e999 m", "m"), "expected a length such as \"1.2 mm\", got \"1e999 m\"");
  EXPECT_EQ(refusal("1e308 km", "m"), "expected a length such as \"1.2 mm\", got \"1e308 km\" (too large)");
  EXPECT_EQ(refusal("5 m/", "m"), "expected a length such as \"1.2 mm\", got \"5 m/\" (unknown unit \"m/\")");
  EXPECT_EQ(refusal("5 m^x", "m"), "expected a length such as \"1.2 mm\", got \"5 m^x\" (unknown unit \"m^x\")");
  EXPECT_EQ(refusal("30 deg", "1"), "expected a number such as 1.5, got \"30 deg\"");
}

TEST(FormatQuantity, ChoosesReadablePrefix) {
  EXPECT_EQ(format_quantity(1.25e-5, "s"), "12.5 us");
  EXPECT_EQ(format_quantity(0.999999e-3, "s"), "1 ms");
  EXPECT_EQ(format_quantity(0, "s"), "0 s");
  EXPECT_EQ(format_quantity(-26.7e9, "Pa"), "-26.7 GPa");
  EXPECT_EQ(format_quantity(2580, "m/s"), "2.58 km/s");
  EXPECT_EQ(format_quantity(4.72e6, "J/kg"), "4.72 MJ/kg");
  EXPECT_EQ(format_quantity(2700, "kg/m^3"), "2.7 g/cm^3");
  EXPECT_EQ(format_quantity(1.2, "kg/m^3"), "1.2 kg/m^3");
  EXPECT_EQ(format_quantity(2.13e-4, "kg"), "213 mg");
  EXPECT_EQ(format_quantity(12, "kg"), "12 kg");
  EXPECT_EQ(format_quantity(1.3, "1"), "1.3");
  EXPECT_EQ(format_quantity(5e34, "1/m^3"), "5e+34 1/m^3");
}

TEST(FormatExact, ReadsBackAsTheSameDouble) {
  for (const double value : {0.1 + 0.2, 1.0 / 3, 6.02e23, -4.9e-324, 1e-300})
    EXPECT_EQ(parse_quantity(format_exact(value, "m/s"), "m/s"), value);
}

}  // namespace
}  // namespace ejecta
