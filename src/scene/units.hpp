#pragma once
/// Physical quantities as text: "2.7 g/cm^3" in, 2700 out, and back. Inside the code everything is SI.
#include <string>
#include <string_view>

namespace ejecta {

/// The value in SI of a quantity such as "5 km/s", "20us", "1e6 Pa" or "5e34 1/m^3". `si_unit` is what is expected,
/// written in SI symbols ("m/s", "Pa", "1" for a plain number, "rad" for an angle, "any" for whatever unit).
/// Symbols: m g s K rad N J W Pa bar erg dyn deg min h, prefixes f p n u (µ) m c k M G T, powers ^n, products * / and
/// space. Throws InputError saying what was expected and what was got, e.g. `expected a speed such as "5 km/s", got "5
/// km"`.
double parse_quantity(std::string_view text, std::string_view si_unit);

/// An SI value with the prefix that suits it: format_quantity(1.25e-5, "s") is "12.5 us". Four significant digits.
std::string format_quantity(double value, std::string_view si_unit);

/// The shortest decimal that reads back as exactly this double, with its SI unit unless that is "1".
std::string format_exact(double value, std::string_view si_unit);

/// What a quantity of this unit is called, with an example: `a speed such as "5 km/s"`.
std::string expected_quantity(std::string_view si_unit);

}  // namespace ejecta
