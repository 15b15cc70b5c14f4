#include "observe/field_styles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "observe/plane_impact.hpp"

namespace ejecta {

namespace {

struct Row {
  const char *field, *label;
  ColourMap map;
  ColourRange (*range)(const Extremes&);  ///< null: what the first frame holds
};

constexpr double infinity = std::numeric_limits<double>::infinity();
using enum ColourMap;
constexpr auto unit_range = [](const Extremes&) -> ColourRange { return {0, 1}; };

const Row table[] = {
    {"pressure", "pressure", cool_warm,
     [](const Extremes& e) -> ColourRange {
       return {is_set(e.tension) ? -std::min(e.pressure, 4 * e.tension) : 0, e.pressure};
     }},
    {"pressure_peak", "highest pressure", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.pressure};
     }},
    {"density", "density", viridis,
     [](const Extremes& e) -> ColourRange {
       return {e.least_density, e.density};
     }},
    {"velocity", "velocity", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.speed};
     }},
    {"specific_energy", "specific energy", inferno,
     [](const Extremes& e) -> ColourRange {
       return {0, 0.5 * e.speed * e.speed};
     }},
    {"distension", "distension", viridis,
     [](const Extremes& e) -> ColourRange {
       return {1, e.distension};
     }},
    {"aspect", "aspect", viridis,
     [](const Extremes& e) -> ColourRange {
       return {1, e.aspect};
     }},
    {"mach", "Mach number", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.mach};
     }},
    {"damage", "damage", plasma, unit_range},
    {"damage_1", "largest damage", plasma, unit_range},
    {"damage_2", "damage 2", plasma, unit_range},
    {"damage_3", "damage 3", plasma, unit_range},
};

/// Tension at which the weakest flaw of a particle opens, one flaw per k V eps^m in its volume V [Pa]; infinite without
/// flaws.
double flaw_tension(const Material& m, const Scene& scene) {
  if (!m.damage || !m.elastic || !is_set(m.damage->weibull_m)) return infinity;
  const double volume = std::pow(scene.spacing, scene.dimension);
  return m.elastic->young() * std::exp(-std::log(m.damage->weibull_k * volume) / m.damage->weibull_m);
}

double yield_stress(const Material& m) {
  return m.strength ? std::visit([](const auto& s) { return s.yield(StrengthState{}); }, *m.strength) : infinity;
}

/// Stress that motion alone can bring about in solids [Pa]: rho u (c + u) at the largest speed u, as where a wave has
/// turned all motion into strain. Infinite where something else loads them too.
double stress_of_motion(const Scene& scene, const std::vector<Material>& materials, const Outset& outset) {
  const bool pulled = std::ranges::any_of(scene.bodies, &Body::driven) || !scene.detonators.empty();
  if (pulled || !(outset.speed > 0)) return infinity;
  double stress = outset.pressure;
  for (const Material& m : materials)
    if (m.solid()) {
      const double density = m.bulk_density();
      stress = std::max(stress, density * outset.speed * (m.elastic->longitudinal_speed(density) + outset.speed));
    }
  return stress;
}

/// Adds what solids bear, as far as something can bring it about: `most` [Pa].
void add_strengths(Extremes& e, const Scene& scene, const std::vector<Material>& materials, double most) {
  for (const Material& m : materials) {
    if (!m.solid()) continue;
    double tension = std::min(flaw_tension(m, scene), yield_stress(m));
    if (!(tension > 0 && std::isfinite(tension))) tension = 0.01 * m.elastic->bulk_modulus;
    const double onset = m.porosity ? std::min(tension, m.porosity->curve.elastic_pressure) : tension;
    e.tension = is_set(e.tension) ? std::max(e.tension, tension) : tension;
    e.onset = is_set(e.onset) ? std::min(e.onset, onset) : onset;
  }
  if (!is_set(e.tension)) return;
  e.pressure = std::max(is_set(e.pressure) ? e.pressure : 0.0, std::min(3 * e.tension, most));
  e.tension = std::min(e.tension, most);
}

/// Densities of solids: what is neither crushed nor broken is compressed and stretched by what the pressure over its
/// bulk modulus says, and nothing by more than a fifth and a half.
void bound_densities(Extremes& e, const Scene& scene, const std::vector<Material>& materials) {
  e.least_density = 0.5 * e.density;
  double least = infinity, largest = 0;
  for (const Body& body : scene.bodies) {
    const auto m = std::ranges::find(materials, body.material, &Material::name);
    if (m == materials.end() || !body.profile.density.empty()) return;
    const double density = is_set(body.density) ? body.density : m->bulk_density();
    const double strain = e.pressure / m->elastic->bulk_modulus;
    const bool loosens = m->damage || m->porosity || m->breaks_in_shear();
    least = std::min(least, density * (1 - (loosens ? 0.5 : std::min(0.5, strain))));
    largest = std::max(largest, density * (1 + (m->porosity ? 0.2 : std::min(0.2, strain))));
  }
  if (!(largest > 0)) return;
  e.least_density = least;
  e.density = largest;
}

/// Pressures rise above those of a plane impact where shocks meet, and where bodies first touch.
constexpr double overshoot = 1.25;

/// Colours of pressure follow its logarithm, both ways from zero, from what solids bear on, and from this part of the
/// range at the latest: shocks and waves of all strengths are seen.
constexpr double linear_part = 0.03;

/// What an explosive drives, such as water around it, is seen down to this part of the pressure at its front.
constexpr double driven_part = 1e-3;

/// Ends of a colour bar that nobody has given are round: to two digits of their own or of the range, outwards.
ColourRange rounded(const ColourRange& range) {
  const auto digit = [](double value) { return std::pow(10, std::floor(std::log10(std::abs(value))) - 1); };
  const auto outwards = [&](double value, double away) {
    if (value == 0 || !std::isfinite(value)) return value;
    const double unit = std::min(digit(value), digit(range.max - range.min));
    return away * std::ceil(away * value / unit - 1e-9 * std::abs(value / unit)) * unit;
  };
  if (!(range.max > range.min)) return range;
  return {outwards(range.min, -1), outwards(range.max, 1)};
}

}  // namespace

Extremes extremes(const Scene& scene, const std::vector<Material>& materials, const Outset& outset) {
  double distension = 1.01;
  for (const Material& m : materials)
    if (m.porosity) distension = std::max(distension, m.porosity->initial_distension());
  const double speed = outset.speed > 0 ? outset.speed : std::sqrt(outset.pressure / outset.density);
  const PlaneImpact impact = strongest_impact(scene, materials);
  Extremes e{.pressure = std::max(outset.pressure, overshoot * impact.pressure),
             .density = outset.density,
             .speed = std::max(speed, impact.speed),
             .distension = distension,
             .aspect = std::clamp(scene.numerics.largest_aspect, 1.5, 4.0)};
  add_strengths(e, scene, materials, stress_of_motion(scene, materials, outset));
  // Where a shock has come back from a free surface, matter is pulled as hard as it was pressed, if nothing has flaws.
  if (is_set(e.tension) && std::ranges::none_of(materials, [](const Material& m) { return m.damage.has_value(); }))
    e.tension = std::max(e.tension, impact.pressure);
  for (const Material& m : materials)
    if (const auto explosive = m.explosive()) {
      const double front = m.bulk_density() * std::pow(explosive->detonation_speed, 2) * explosive->cj_compression;
      const double onset = driven_part * front;
      e.onset = is_set(e.onset) ? std::min(e.onset, onset) : onset;
    }
  if (!materials.empty() && std::ranges::all_of(materials, &Material::solid)) bound_densities(e, scene, materials);
  return e;
}

std::map<std::string, FieldStyle> field_styles(const Scene& scene, const Extremes& expected) {
  std::map<std::string, FieldStyle> styles;
  for (const Row& row : table) {
    FieldStyle& style = styles.try_emplace(row.field, FieldStyle{row.label, row.map, {}}).first->second;
    if (!row.range) continue;
    const ColourRange range = rounded(row.range(expected));
    if (range.max > range.min) style.range = range;  // a scene at rest leaves nothing to tell a range from
  }
  for (const auto& [name, range] : scene.insitu.ranges) {
    const auto style = styles.try_emplace(name, plain_style(name)).first;
    style->second.range = range;
  }
  FieldStyle& pressure = styles.at("pressure");
  if (pressure.range)
    pressure.linear_to = std::min(is_set(expected.onset) ? expected.onset : infinity,
                                  linear_part * std::max(-pressure.range->min, pressure.range->max));
  return styles;
}

}  // namespace ejecta
