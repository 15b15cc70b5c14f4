#include "material/material_settings.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "scene/names.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

template <class Model>
struct Named {
  std::string_view name;
  Model initial;
};

const std::array<Named<Eos>, 6> eos_models{{{"ideal_gas", IdealGas{}},
                                            {"tillotson", Tillotson{}},
                                            {"mie_grueneisen", MieGrueneisen{}},
                                            {"linear", LinearEos{}},
                                            {"equilibrium_air", EquilibriumAir{}},
                                            {"jwl", Jwl{}}}};
const std::array<Named<Strength>, 6> strength_models{{{"von_mises", VonMises{}},
                                                      {"drucker_prager", DruckerPrager{}},
                                                      {"lundborg", Lundborg{}},
                                                      {"collins", Collins{}},
                                                      {"steinberg_guinan", SteinbergGuinan{}},
                                                      {"johnson_cook", JohnsonCook{}}}};

template <std::size_t N, class Model>
std::vector<std::string> words(const std::array<Named<Model>, N>& models) {
  std::vector<std::string> names;
  names.reserve(N);
  for (const auto& model : models) names.emplace_back(model.name);
  return names;
}
template <class Enum>
std::vector<std::string> words() {
  const auto names = enum_names(Enum{});
  return {names.begin(), names.end()};
}
std::vector<std::string> with_none(std::vector<std::string> words) {
  words.insert(words.begin(), "none");
  return words;
}

template <std::size_t N, class Model>
std::string word_of(const std::optional<Model>& model, const std::array<Named<Model>, N>& models) {
  for (const auto& candidate : models)
    if (model && model->index() == candidate.initial.index()) return std::string(candidate.name);
  return "none";
}

using Report = std::function<void(const std::string& path, const std::string& message)>;

/// What the constants of a model ask of each other; of most nothing beyond their limits. Comparisons with what is not
/// set are false: that it is missing has been reported.
template <class Model>
void check(const Model&, const Report&) {}

/// A constant without a default.
void constant(Describer& d, std::string key, double& value, std::string unit, Limits limits, std::string doc) {
  d.number(std::move(key), value, std::move(unit), limits, std::move(doc)).required = true;
}

void describe(Describer& d, IdealGas& g) {
  constant(d, "density", g.rho0, "kg/m^3", positive, "of a body whose density the scene does not give");
  constant(d, "gamma", g.gamma, "1", {.min = 1, .open_min = true}, "ratio of specific heats");
}

void describe(Describer& d, Tillotson& t) {
  constant(d, "density", t.rho0, "kg/m^3", positive, "reference density, without pores");
  constant(d, "a", t.a, "1", positive, "thermal coefficient of the vapour");
  constant(d, "b", t.b, "1", non_negative, "further thermal coefficient of the condensed state");
  constant(d, "A", t.A, "Pa", positive, "bulk modulus");
  constant(d, "B", t.B, "Pa", non_negative, "quadratic companion of A");
  constant(d, "E0", t.E0, "J/kg", positive, "energy at which b has halved, at reference density");
  constant(d, "E_iv", t.E_iv, "J/kg", positive, "incipient vaporisation");
  constant(d, "E_cv", t.E_cv, "J/kg", positive, "complete vaporisation");
  constant(d, "alpha", t.alpha, "1", positive, "Gaussian decay in expansion");
  constant(d, "beta", t.beta, "1", positive, "exponential decay in expansion");
}
void check(const Tillotson& t, const Report& report) {
  if (t.E_cv <= t.E_iv)
    report("eos.E_cv", fmt::format("expected more than E_iv ({})", format_quantity(t.E_iv, "J/kg")));
}

void describe(Describer& d, MieGrueneisen& m) {
  constant(d, "density", m.rho0, "kg/m^3", positive, "reference density, without pores");
  constant(d, "c0", m.c0, "m/s", positive, "shock speed at vanishing particle speed");
  constant(d, "S1", m.S1, "1", positive, "slope of the shock speed with the particle speed");
  d.number("S2", m.S2, "1", any_number, "its curvature");
  d.number("S3", m.S3, "1", any_number, "the next order");
  constant(d, "gamma0", m.gamma0, "1", non_negative, "Grueneisen parameter at reference density");
  d.number("b", m.b, "1", non_negative, "Grueneisen parameter times density ratio: gamma0 + b mu in compression");
  d.number("eta_min", m.eta_min, "1", {.min = 0, .max = 1, .open_min = true},
           "density ratio below which the pressure falls to zero with the density");
  d.number("eta_max", m.eta_max, "1", {.min = 1, .open_min = true},
           "density ratio from which the pressure follows its tangent");
  d.number("heat_capacity", m.heat_capacity, "J/kg/K", positive, "for strength that knows the temperature");
  d.number("reference_temperature", m.reference_temperature, "K", positive, "at reference density and zero energy");
  d.number("melt_temperature", m.melt_temperature, "K", positive, "at reference density; else it never melts");
  d.number("melt_exponent", m.melt_exponent, "1", non_negative,
           "a of Lindemann's law; else the melting temperature does not depend on the density");
}
void check(const MieGrueneisen& m, const Report& report) {
  for (int k = 1; k <= 200; ++k) {
    const double mu = (m.eta_max - 1) * k / 200;
    if (m.denominator(mu) <= 0 || m.evaluate((1 + mu) * m.rho0, 0).dP_drho <= 0)
      return report("eos.eta_max", fmt::format("expected less than {:.4g}, where cold pressure no longer grows with "
                                               "density for these S1, S2, S3, gamma0 and b",
                                               1 + mu));
  }
  if (m.melt_temperature <= m.reference_temperature)
    report("eos.melt_temperature",
           fmt::format("expected more than reference_temperature ({})", format_quantity(m.reference_temperature, "K")));
}

void describe(Describer& d, LinearEos& l) {
  constant(d, "density", l.rho0, "kg/m^3", positive, "reference density, without pores");
  constant(d, "c0", l.c0, "m/s", positive, "sound speed");
  d.number("gamma0", l.gamma0, "1", non_negative, "Grueneisen parameter; 0: no heat in the pressure");
}

void describe(Describer& d, EquilibriumAir& a) {
  constant(d, "density", a.rho0, "kg/m^3", positive, "of a body whose density the scene does not give");
}

void describe(Describer& d, Jwl& j) {
  constant(d, "density", j.rho0, "kg/m^3", positive, "of the explosive");
  constant(d, "A", j.A, "Pa", positive,
           "of A (1 - omega/(R1 V)) exp(-R1 V), V = density at the start over density now");
  constant(d, "B", j.B, "Pa", any_number, "of the same with R2");
  constant(d, "R1", j.R1, "1", positive, "decay of A with the volume");
  constant(d, "R2", j.R2, "1", positive, "decay of B with the volume");
  constant(d, "omega", j.omega, "1", positive, "Grueneisen parameter of the products");
  constant(d, "E0", j.E0, "J/m^3", positive, "energy that is set free, per volume of explosive");
  constant(d, "detonation_speed", j.detonation_speed, "m/s", positive,
           "measured; within 1 % of what the constants above give (Chapman & Jouguet)");
  d.number("cj_pressure", j.cj_pressure, "Pa", positive, "measured or published; within 5 % of the same, if given");
}
void check(const Jwl& j, const Report& report) {
  if (std::isnan(j.rho0 + j.A + j.B + j.R1 + j.R2 + j.omega + j.E0)) return;
  const ChapmanJouguet cj = j.chapman_jouguet();
  const auto compare = [&](const char* key, double given, double found, double within, const char* unit) {
    if (is_set(given) && !(std::abs(given / found - 1) <= within))
      report(fmt::format("eos.{}", key),
             fmt::format("expected {} within {:.3g} %, which is what the constants of the products give (Chapman & "
                         "Jouguet: D {}, {}, V {:.4g}), got {}",
                         format_quantity(found, unit), 100 * within, format_quantity(cj.speed, "m/s"),
                         format_quantity(cj.pressure, "Pa"), cj.volume, format_quantity(given, unit)));
  };
  compare("detonation_speed", j.detonation_speed, cj.speed, 0.01, "m/s");
  compare("cj_pressure", j.cj_pressure, cj.pressure, 0.05, "Pa");
}

constexpr Limits below_right_angle{.min = 0, .max = std::numbers::pi / 2};

void describe(Describer& d, VonMises& m) {
  constant(d, "yield_stress", m.yield_stress, "Pa", positive, "uniaxial, cold and intact");
}
void describe(Describer& d, DruckerPrager& m) {
  constant(d, "cohesion", m.cohesion, "Pa", non_negative, "of the intact material; damage removes it");
  constant(d, "friction_angle", m.friction_angle, "rad", below_right_angle, "stays when damaged");
}
void describe(Describer& d, Lundborg& m) {
  constant(d, "cohesion", m.cohesion, "Pa", non_negative, "shear strength at zero pressure");
  constant(d, "friction", m.friction, "1", non_negative, "coefficient of internal friction");
  constant(d, "limit", m.limit, "Pa", positive, "shear strength at infinite pressure");
}
void check(const Lundborg& m, const Report& report) {
  if (m.limit <= m.cohesion)
    report("strength.limit", fmt::format("expected more than the cohesion ({})", format_quantity(m.cohesion, "Pa")));
}
void describe(Describer& d, Collins& m) {
  describe(d, m.intact);
  constant(d, "damaged_cohesion", m.damaged_cohesion, "Pa", non_negative, "of broken rock");
  constant(d, "damaged_friction", m.damaged_friction, "1", non_negative, "coefficient of friction of broken rock");
  d.number("brittle_ductile", m.brittle_ductile, "Pa", non_negative,
           "pressure of the brittle-ductile transition; 0: plastic strain does not break the rock")
      .zero_is_unset = true;
  d.number("brittle_plastic", m.brittle_plastic, "Pa", non_negative, "pressure of the brittle-plastic transition")
      .zero_is_unset = true;
}
void check(const Collins& m, const Report& report) {
  check(m.intact, report);
  if (is_set(m.brittle_ductile) && !(m.brittle_plastic > m.brittle_ductile))
    report("strength.brittle_plastic",
           fmt::format("expected more than brittle_ductile ({})", format_quantity(m.brittle_ductile, "Pa")));
}

void describe(Describer& d, SteinbergGuinan& m) {
  constant(d, "yield_stress", m.yield_stress, "Pa", positive, "uniaxial, before any plastic strain");
  constant(d, "yield_limit", m.yield_limit, "Pa", positive, "that hardening leads to");
  constant(d, "hardening", m.hardening, "1", non_negative, "beta of (1 + beta strain)^n");
  constant(d, "hardening_exponent", m.hardening_exponent, "1", non_negative, "n");
  d.number("initial_strain", m.initial_strain, "1", non_negative, "plastic strain of earlier work on the metal");
  d.number("stiffening", m.stiffening, "1/Pa", non_negative, "relative growth of the shear modulus with pressure");
  d.number("softening", m.softening, "1/K", non_negative, "its relative fall with temperature");
  d.number("melt_width", m.melt_width, "1", non_negative, "share of the melting temperature in which it softens");
}
void check(const SteinbergGuinan& m, const Report& report) {
  if (m.yield_limit < m.yield_stress)
    report("strength.yield_limit",
           fmt::format("expected at least the yield stress ({})", format_quantity(m.yield_stress, "Pa")));
}

void describe(Describer& d, JohnsonCook& m) {
  constant(d, "yield_stress", m.yield_stress, "Pa", positive, "A: uniaxial, at the reference rate");
  constant(d, "hardening", m.hardening, "Pa", non_negative, "B of A + B strain^n");
  constant(d, "hardening_exponent", m.hardening_exponent, "1", positive, "n");
  constant(d, "rate_factor", m.rate_factor, "1", non_negative, "C of 1 + C ln(rate/reference rate)");
  constant(d, "softening_exponent", m.softening_exponent, "1", positive, "m of 1 - T*^m");
  d.number("reference_rate", m.reference_rate, "1/s", positive, "of plastic strain; slower flow bears as much");
}

void describe(Describer& d, GradyKipp& m, bool tensor) {
  constant(d, "weibull_m", m.weibull_m, "1", positive, "exponent of the flaw distribution k eps^m");
  constant(d, "weibull_k", m.weibull_k, "1/m^3", positive, "flaws per volume with strain below 1; per area in 2D");
  d.number("crack_speed_factor", m.crack_speed_factor, "1", {.min = 0, .max = 1, .open_min = true},
           "speed of a crack / longitudinal wave speed");
  d.choice("growth", m.growth,
           "how fast open flaws damage: as the spheres they relieve, whatever the particle size, or n c_g/h");
  if (tensor)
    d.choice(
        "strain", m.strain,
        "that opens flaws: of the present stress, or accumulated: deviatoric strain without yield, all stretching");
}

void describe(Describer& d, PorositySettings& p, bool two_power) {
  constant(d, "initial_distension", p.initial_distension, "1", at_least(1), "grain density / bulk density");
  constant(d, "elastic_pressure", p.elastic_pressure, "Pa", non_negative, "P_e, where crushing begins");
  constant(d, "solid_pressure", p.solid_pressure, "Pa", positive, "P_s, where no pores are left");
  if (two_power) {
    constant(d, "transition_pressure", p.transition_pressure, "Pa", positive, "P_t, where the first power law ends");
    constant(d, "reference_distension", p.reference_distension, "1", at_least(1),
             "alpha_e of the fitted curve, which is scaled to the initial distension");
    constant(d, "transition_distension", p.transition_distension, "1", at_least(1), "alpha_t of the fitted curve");
    d.integer("n1", p.n1, between(1, 100), "exponent below P_t").required = true;
    d.integer("n2", p.n2, between(1, 100), "exponent of the whole").required = true;
  }
  d.number("sound_speed", p.sound_speed, "m/s", non_negative, "of the uncrushed body; 0: that of the solid")
      .zero_is_unset = true;
  d.flag("stress_factor", p.stress_factor, "deviatoric stress follows the strain of the solid, not of the pores");
  d.flag("crush_damage", p.crush_damage, "crushing pores damages the material");
}

void check(const PorositySettings& p, const Report& report) {
  const std::string elastic = format_quantity(p.elastic_pressure, "Pa"),
                    solid = format_quantity(p.solid_pressure, "Pa");
  if (p.solid_pressure <= p.elastic_pressure)
    report("porosity.solid_pressure", fmt::format("expected more than elastic_pressure ({})", elastic));
  else if (p.transition_pressure <= p.elastic_pressure || p.transition_pressure > p.solid_pressure)
    report("porosity.transition_pressure",
           fmt::format("expected a pressure between elastic_pressure ({}) and solid_pressure ({})", elastic, solid));
  if (p.transition_distension >= p.reference_distension)
    report("porosity.transition_distension",
           fmt::format("expected less than reference_distension ({})", format_quantity(p.reference_distension, "1")));
}

/// Whether the strength falls by the temperature of the equation of state, not by a melt energy.
bool softens_by_temperature(const Strength& strength) {
  return std::visit([]<class Model>(const Model&) { return hardens<Model>; }, strength);
}

/// The temperature that a strength asks the equation of state for.
void check_temperature(const MaterialSettings& s, const Report& report) {
  std::visit(
      [&]<class EosT, class Model>(const EosT& eos, const Model& strength) {
        if constexpr (!hardens<Model>) {
          return;
        } else if constexpr (!gives_temperature<EosT>) {
          std::vector<std::string> able;
          for (const auto& [name, model] : eos_models)
            if (has_temperature(model)) able.push_back(fmt::format("\"{}\"", name));
          report("strength.model", fmt::format("needs the temperature of eos.model = {}", fmt::join(able, " or ")));
        } else {
          if (!eos.warms() && (strength.needs_temperature() || eos.melts()))
            report("eos.heat_capacity", "missing: the strength depends on the temperature");
          if (!eos.melts() && strength.needs_melting())
            report("eos.melt_temperature", "missing: the strength depends on the temperature");
        }
      },
      *s.eos, *s.strength);
}

}  // namespace

void choose_models(MaterialSettings& settings, Document& document, Problems& problems) {
  const auto forget = [&](const std::string& section) {
    std::erase_if(document.items, [&](const auto& entry) { return entry.first.starts_with(section + "."); });
  };
  // The place of the model's word among the known ones; nothing where the section, which may miss, is not there. A
  // section without a model is as good as none: its constants may stay, so that --set can switch a model off.
  const auto choose = [&](const std::string& section, const std::vector<std::string>& known,
                          bool may_miss = true) -> std::optional<std::size_t> {
    const std::string path = section + ".model";
    if (may_miss && !document.holds(section)) return std::nullopt;
    const auto item = document.items.find(path);
    const auto* name = item == document.items.end() ? nullptr : std::get_if<std::string>(&item->second.literal.value);
    const auto found = name ? std::ranges::find(known, *name) : known.end();
    if (found != known.end()) {
      if (*found == "none") forget(section);
      return static_cast<std::size_t>(found - known.begin());
    }
    problems.add(document.origin(path), path,
                 fmt::format("expected one of {}, got {}", fmt::join(known, ", "),
                             item == document.items.end() ? "nothing" : to_text(item->second.literal)));
    forget(section);
    return std::nullopt;
  };
  if (const auto k = choose("eos", words(eos_models), false)) settings.eos = eos_models[*k].initial;
  if (document.holds("elastic")) settings.elastic.emplace();
  if (const auto k = choose("strength", with_none(words(strength_models))); k && *k > 0)
    settings.strength = strength_models[*k - 1].initial;
  settings.damage_model = static_cast<DamageModel>(choose("damage", words<DamageModel>()).value_or(0));
  settings.porosity_model = static_cast<PorosityModel>(choose("porosity", words<PorosityModel>()).value_or(0));
}

void describe(Describer& d, MaterialSettings& s) {
  const auto section = [&](const std::string& name, std::string_view what, const std::string& model,
                           const std::vector<std::string>& known, std::string doc) {
    d.section(name, fmt::format("{}: {}", what, model));
    d.chosen("model", model, known, std::move(doc)).required = model != "none";
  };
  section("eos", "equation of state", word_of(s.eos, eos_models), words(eos_models), "the constants depend on it");
  if (s.eos) std::visit([&](auto& eos) { describe(d, eos); }, *s.eos);
  if (s.elastic) {
    d.section("elastic", "moduli of the solid; without this section the material is a fluid");
    constant(d, "shear_modulus", s.elastic->shear_modulus, "Pa", positive, "without pores and damage");
    constant(d, "bulk_modulus", s.elastic->bulk_modulus, "Pa", positive, "without pores and damage");
  }
  section("strength", "limit of the deviatoric stress", word_of(s.strength, strength_models),
          with_none(words(strength_models)), "none: elastic without limit");
  if (s.strength) {
    std::visit([&](auto& strength) { describe(d, strength); }, *s.strength);
    if (!softens_by_temperature(*s.strength))
      d.number("melt_energy", s.melt_energy, "J/kg", positive, "at which no strength is left; else it never softens");
  }
  section("damage", "brittle fracture", std::string(name_of(s.damage_model)), words<DamageModel>(),
          "none: never breaks");
  if (s.damage_model != DamageModel::none) describe(d, s.damage, s.damage_model == DamageModel::grady_kipp_tensor);
  section("porosity", "pores below the resolution (P-alpha)", std::string(name_of(s.porosity_model)),
          words<PorosityModel>(), "form of the crush curve; none: no pores");
  if (s.porosity_model != PorosityModel::none) describe(d, s.porosity, s.porosity_model == PorosityModel::two_power);
}

void check_settings(const MaterialSettings& s, const Document& document, Problems& problems) {
  const auto report = [&](const std::string& path, const std::string& message) {
    if (!problems.has(path)) problems.add(document.origin(path), path, message);
  };
  if (s.eos) std::visit([&](const auto& eos) { check(eos, report); }, *s.eos);
  if (s.strength) std::visit([&](const auto& strength) { check(strength, report); }, *s.strength);
  if (s.eos && s.strength) check_temperature(s, report);
  const bool gas = s.eos && is_gas(*s.eos);
  const bool porous = s.porosity_model != PorosityModel::none, breaks = s.damage_model != DamageModel::none;
  if (gas && s.elastic) report("elastic", "a gas has no moduli");
  if (gas && porous) report("porosity.model", "a gas has no pores");
  if (!s.elastic && s.strength) report("strength.model", "needs section [elastic]");
  if (!s.elastic && breaks) report("damage.model", "needs section [elastic]");
  if (s.damage_model == DamageModel::grady_kipp_tensor && !s.strength)
    report("damage.model",
           "grady_kipp_tensor needs section [strength]: cracks with a direction cut off a deviatoric "
           "stress, and nothing would bound the one that is left");
  check(s.porosity, report);
}

Material make_material(const std::string& name, const MaterialSettings& s) {
  Material material;
  material.name = name;
  material.eos = s.eos.value();
  material.elastic = s.elastic;
  material.strength = s.strength;
  material.melt_energy = s.melt_energy;
  if (s.damage_model != DamageModel::none) {
    material.damage = s.damage;
    material.damage->tensor = s.damage_model == DamageModel::grady_kipp_tensor;
  }
  if (s.porosity_model == PorosityModel::none) return material;
  const PorositySettings& p = s.porosity;
  const CrushCurve curve =
      s.porosity_model == PorosityModel::quadratic
          ? CrushCurve::quadratic(p.initial_distension, p.elastic_pressure, p.solid_pressure)
          : CrushCurve::two_power(p.initial_distension, p.reference_distension, p.transition_distension,
                                  p.elastic_pressure, p.transition_pressure, p.solid_pressure, *p.n1, *p.n2);
  material.porosity = Porosity{curve, p.sound_speed, p.stress_factor, p.crush_damage};
  return material;
}

std::vector<MaterialSettings> every_model() {
  std::vector<MaterialSettings> all;
  for (std::size_t k = 0; k < strength_models.size(); ++k) {
    MaterialSettings s;
    s.eos = eos_models[k % eos_models.size()].initial;
    s.elastic.emplace();
    s.strength = strength_models[k].initial;
    s.damage_model = static_cast<DamageModel>(1 + k % 2);
    s.porosity_model = static_cast<PorosityModel>(1 + k % 2);
    all.push_back(s);
  }
  return all;
}

}  // namespace ejecta
