#include "material/material_reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/errors.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {
namespace {

namespace fs = std::filesystem;

const std::string library = std::string(EJECTA_SOURCE_DIR) + "/inputs/materials";

std::vector<std::string> problems_of(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}
using One = std::vector<std::string>;

/// Problems of a material given in the scene alone.
std::vector<std::string> problems_of_text(const std::string& text) {
  return problems_of([&] { read_material("m", {}, parse_document(text, "m.toml")); });
}

const std::string tillotson = R"([eos]
model = "tillotson"
density = "2.7 g/cm^3"
a = 0.5
b = 1.5
A = "26.7 GPa"
B = "26.7 GPa"
E0 = "487 MJ/kg"
E_iv = "4.72 MJ/kg"
E_cv = "18.2 MJ/kg"
alpha = 5
beta = 5
)";
const std::string elastic = "[elastic]\nshear_modulus = \"22.7 GPa\"\nbulk_modulus = \"26.7 GPa\"\n";
const std::string two_power = R"([porosity]
model = "two_power"
initial_distension = 3
elastic_pressure = "1 MPa"
transition_pressure = "68 MPa"
solid_pressure = "213 MPa"
reference_distension = 4.64
transition_distension = 1.9
n1 = 12
n2 = 3
)";

std::string scene_text(const std::string& numerics = "", const std::string& body = "") {
  return "[scene]\nname = \"x\"\n[resolution]\nspacing = \"1 mm\"\n[time]\nend = \"1 us\"\n" + numerics +
         "[[bodies]]\nname = \"target\"\nmaterial = \"pumice\"\nradius = \"1 cm\"\n" + body;
}

TEST(ReadMaterial, BasaltInSi) {
  const Material basalt = read_material("basalt", {library});
  EXPECT_EQ(basalt.name, "basalt");
  const Tillotson& eos = std::get<Tillotson>(basalt.eos);
  EXPECT_EQ(eos.rho0, 2700);
  EXPECT_EQ(eos.A, 26.7e9);
  EXPECT_EQ(eos.E_iv, 4.72e6);
  EXPECT_EQ(basalt.elastic->shear_modulus, 22.7e9);
  EXPECT_EQ(std::get<Collins>(*basalt.strength).intact.limit, 3.5e9);
  EXPECT_EQ(std::get<Collins>(*basalt.strength).damaged_friction, 0.8);
  EXPECT_EQ(std::get<VonMises>(*read_material("basalt_von_mises", {library}).strength).yield_stress, 3.5e9);
  EXPECT_EQ(basalt.melt_energy, 3.4e6);
  EXPECT_EQ(basalt.damage->weibull_k, 5e34);
  EXPECT_EQ(basalt.damage->crack_speed_factor, 0.4);
  EXPECT_FALSE(basalt.porosity.has_value());
}

TEST(ReadMaterial, PumiceHasItsBulkDensityAndCrushCurve) {
  const Material pumice = read_material("pumice", {library});
  EXPECT_NEAR(pumice.bulk_density(), 700, 1e-9);
  const CrushCurve& curve = pumice.porosity->curve;
  EXPECT_EQ(curve.elastic_pressure, 1e6);
  EXPECT_EQ(curve.solid_pressure, 213e6);
  EXPECT_NEAR(curve.alpha(1e6 + 1e-3), 2.327 / 0.7, 1e-6);
  EXPECT_TRUE(pumice.porosity->crush_damage);
}

TEST(ReadMaterial, GasHasNothingElse) {
  const Material air = read_material("air", {library});
  EXPECT_EQ(std::get<IdealGas>(air.eos).gamma, 1.4);
  EXPECT_FALSE(air.solid() || air.strength || air.damage || air.porosity);
  const Material hot = read_material("air_equilibrium", {library});
  EXPECT_TRUE(hot.gas());
  EXPECT_EQ(hot.bulk_density(), air.bulk_density());
}

TEST(ReadMaterial, TheFirstFolderWins) {
  const fs::path folder = fs::path(testing::TempDir()) / "ejecta_material_reader";
  fs::create_directories(folder);
  std::ofstream(folder / "basalt.toml") << tillotson;
  EXPECT_FALSE(read_material("basalt", {folder.string(), library}).solid());
  EXPECT_TRUE(read_material("granite", {folder.string(), library}).solid());
  fs::remove_all(folder);
}

TEST(ReadMaterial, OverridesReplaceValues) {
  const Document overrides =
      parse_document("[porosity]\ninitial_distension = 2\n[strength]\nyield_stress = \"5 MPa\"\n", "s");
  const Material pumice = read_material("pumice", {library}, overrides);
  EXPECT_EQ(pumice.porosity->initial_distension(), 2);
  EXPECT_EQ(std::get<VonMises>(*pumice.strength).yield_stress, 5e6);
  EXPECT_EQ(pumice.porosity->curve.n1, 12);
}

TEST(ReadMaterial, WhatIsNotGivenIsNotSet) {
  const Material bare = read_material("x", {},
                                      parse_document("[eos]\nmodel = \"mie_grueneisen\"\ndensity = \"1 g/cm^3\"\n"
                                                     "c0 = \"1 km/s\"\nS1 = 1\ngamma0 = 1\n",
                                                     "s"));
  const auto& eos = std::get<MieGrueneisen>(bare.eos);
  EXPECT_FALSE(eos.warms());
  EXPECT_FALSE(eos.melts());
  EXPECT_FALSE(is_set(bare.melt_energy));
  EXPECT_FALSE(is_set(
      read_material("pumice", {library}, parse_document("[porosity]\nsound_speed = 0\n", "s")).porosity->sound_speed));
  const Material rock = read_material("basalt", {library}, parse_document("[strength]\nbrittle_ductile = 0\n", "s"));
  EXPECT_FALSE(rock.breaks_in_shear());
  EXPECT_EQ(
      problems_of([] { read_material("basalt", {library}, parse_document("[strength]\nbrittle_plastic = 0\n", "s")); }),
      One{"s:2: strength.brittle_plastic: expected more than brittle_ductile (1.23 GPa)"});
}

/// Of a section that another model has replaced no constant is left; whoever misses them is told why.
TEST(ReadMaterial, SaysThatAnotherModelHasReplacedTheSection) {
  const auto problems = [](const std::string& overrides) {
    return problems_of([&] { read_material("basalt", {library}, parse_document(overrides, "scene.toml")); });
  };
  const auto replaced = problems("[eos]\nmodel = \"mie_grueneisen\"\nc0 = \"3 km/s\"\n");
  const auto why = std::ranges::find_if(replaced, [](const std::string& text) {
    return text.starts_with("scene.toml:2: eos.model: \"mie_grueneisen\" is another model than \"tillotson\" of ") &&
           text.ends_with("and replaces all of its section: no constant of that stays, so that all must be given");
  });
  EXPECT_NE(why, replaced.end());
  EXPECT_EQ(std::ranges::count_if(replaced, [](const std::string& text) { return text.find("missing") != text.npos; }),
            3)
      << "density, S1, gamma0";
  // A value that is wrong is no reason to explain anything, nor is one that is missing in a section of its own.
  EXPECT_EQ(problems("[eos]\nA = \"-1 Pa\"\n").size(), 1u);
}

TEST(ReadMaterial, AnotherModelReplacesTheSection) {
  const Document overrides = parse_document(R"([porosity]
model = "quadratic"
initial_distension = 4
elastic_pressure = "1 MPa"
solid_pressure = "100 MPa"
[damage]
model = "none"
[strength]
model = "drucker_prager"
cohesion = "1 MPa"
friction_angle = "30 deg"
)",
                                            "s");
  const Material pumice = read_material("pumice", {library}, overrides);
  EXPECT_EQ(pumice.porosity->curve.alpha(100e6), 1);
  EXPECT_EQ(pumice.porosity->initial_distension(), 4);
  EXPECT_FALSE(pumice.damage.has_value());
  EXPECT_NEAR(std::get<DruckerPrager>(*pumice.strength).friction_angle, 0.5235987755982988, 1e-15);
}

TEST(ReadMaterial, ASectionWithoutModelIsAsGoodAsNone) {
  const auto off = [](const std::string& section, const std::string& constants) {
    return read_material("m", {}, parse_document(tillotson + elastic + section + "model = \"none\"\n" + constants, "m"));
  };
  EXPECT_FALSE(off("[strength]\n", "yield_stress = \"1 GPa\"\n").strength);
  EXPECT_FALSE(off("[damage]\n", "weibull_m = 9\nweibull_k = \"5e34 1/m^3\"\n").damage);
  EXPECT_FALSE(off("[porosity]\n", "initial_distension = 3\n").porosity);
}

TEST(ReadMaterial, RefusesWithReason) {
  EXPECT_EQ(problems_of([] {
              read_material("unobtainium", {"a", "b"});
            }),
            One{"material \"unobtainium\": no such file: searched a/unobtainium.toml and b/unobtainium.toml"});
  EXPECT_EQ(problems_of([] { read_material("basalt", {library}, parse_document("[eos]\nC = 3\n", "s.toml")); }),
            One{"s.toml:2: eos.C: unknown key"});
  EXPECT_EQ(problems_of_text("[eos]\nmodel = \"ideal_gas\"\ngamma = 1\ndensity = \"1 kg/m^3\"\n"),
            One{"m.toml:3: eos.gamma: expected a number such as 1.5, > 1, got 1"});
  EXPECT_EQ(problems_of_text("[eos]\nmodel = \"ideal_gas\"\ngamma = 1.4\n"),
            One{"m.toml:1: eos.density: missing: of a body whose density the scene does not give"});
  EXPECT_EQ(problems_of_text("[eos]\nmodel = \"jwk\"\ngamma = 1.4\n"),
            One{"m.toml:2: eos.model: expected one of ideal_gas, tillotson, mie_grueneisen, linear, "
                "equilibrium_air, jwl, got \"jwk\""});
  EXPECT_EQ(
      problems_of_text(tillotson + "[damage]\nmodel = \"grady_kipp\"\nweibull_m = 9\nweibull_k = \"5e34 1/m^3\"\n"),
      One{"m.toml:14: damage.model: needs section [elastic]"});
  EXPECT_EQ(problems_of_text(tillotson + "[strength]\nmodel = \"von_mises\"\nyield_stress = \"1 GPa\"\n"),
            One{"m.toml:14: strength.model: needs section [elastic]"});
  EXPECT_EQ(problems_of_text(tillotson + "[damage]\nweibull_m = 9\n"),
            One{"m.toml:13: damage.model: expected one of none, grady_kipp, grady_kipp_tensor, got nothing"});
  const std::string tensor = "[damage]\nmodel = \"grady_kipp_tensor\"\nweibull_m = 9\nweibull_k = \"5e34 1/m^3\"\n";
  EXPECT_EQ(problems_of_text(tillotson + tensor), One{"m.toml:14: damage.model: needs section [elastic]"});
  EXPECT_EQ(
      problems_of_text(tillotson + elastic + tensor),
      One{"m.toml:17: damage.model: grady_kipp_tensor needs section [strength]: cracks with a direction cut off a "
          "deviatoric stress, and nothing would bound the one that is left"});
  const std::string strong = tillotson + elastic + "[strength]\nmodel = \"von_mises\"\nyield_stress = \"1 GPa\"\n";
  EXPECT_EQ(problems_of_text(strong + tensor + "strain = \"benz_asphaug\"\n"), One{});
  EXPECT_EQ(problems_of_text(strong + tensor + "strain = \"plastic\"\n"),
            One{"m.toml:23: damage.strain: expected one of benz_asphaug, pseudo_plastic, strain_history, got "
                "\"plastic\""});
  EXPECT_EQ(problems_of_text(strong + "[damage]\nmodel = \"grady_kipp\"\nweibull_m = 9\nweibull_k = \"5e34 1/m^3\"\n"
                                      "strain = \"pseudo_plastic\"\n"),
            One{"m.toml:23: damage.strain: unknown key"});
  EXPECT_EQ(problems_of_text(tillotson + elastic +
                             "[strength]\nmodel = \"lundborg\"\ncohesion = \"2 GPa\"\nfriction = 1\n"
                             "limit = \"1 GPa\"\n"),
            One{"m.toml:20: strength.limit: expected more than the cohesion (2 GPa)"});
  EXPECT_EQ(
      problems_of_text("[eos]\nmodel = \"ideal_gas\"\ngamma = 1.4\ndensity = \"1 kg/m^3\"\n" + elastic + two_power),
      (One{"m.toml:5: elastic: a gas has no moduli", "m.toml:9: porosity.model: a gas has no pores"}));
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return problems_of_text(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(changed(tillotson, "18.2", "4"), One{"m.toml:10: eos.E_cv: expected more than E_iv (4.72 MJ/kg)"});
  EXPECT_EQ(changed(tillotson + two_power, "213", "0.5"),
            One{"m.toml:18: porosity.solid_pressure: expected more than elastic_pressure (1 MPa)"});
  EXPECT_EQ(changed(tillotson + two_power, "68", "300"),
            One{"m.toml:17: porosity.transition_pressure: expected a pressure between elastic_pressure (1 MPa) and "
                "solid_pressure (213 MPa)"});
  EXPECT_EQ(changed(tillotson + two_power, "= 1.9", "= 5"),
            One{"m.toml:20: porosity.transition_distension: expected less than reference_distension (4.64)"});
  EXPECT_EQ(changed(tillotson + two_power, "initial_distension = 3", "initial_distension = 0.9"),
            One{"m.toml:15: porosity.initial_distension: expected a number such as 1.5, >= 1, got 0.9"});
}

TEST(ReadMaterial, MetalsInSi) {
  const Material steel = read_material("steel_304", {library});
  const MieGrueneisen& eos = std::get<MieGrueneisen>(steel.eos);
  EXPECT_EQ(eos.c0, 4570);
  EXPECT_EQ(eos.melt_exponent, 1.4);
  EXPECT_EQ(std::get<SteinbergGuinan>(*steel.strength).stiffening, 0.0226e-9);
  EXPECT_TRUE(steel.variable_shear());
  EXPECT_FALSE(steel.yield_needs_temperature());
  EXPECT_EQ(steel.damage->weibull_k, 6.52e11);
  const Material fast = read_material("steel_4340", {library});
  EXPECT_EQ(std::get<JohnsonCook>(*fast.strength).hardening, 510e6);
  EXPECT_FALSE(fast.variable_shear());
  EXPECT_TRUE(fast.yield_needs_temperature());
  const Material tantalum = read_material("tantalum", {library});
  EXPECT_EQ(warmth(std::get<MieGrueneisen>(tantalum.eos), 16654, 1e9).rise, 0) << "no heat capacity: never warms";
  EXPECT_EQ(read_material("rubber", {library}).elastic->shear_modulus, 161.2959e6);
}

TEST(ReadMaterial, RefusesMetalsThatCannotBe) {
  const auto steel = [](const std::string& overrides) {
    return problems_of([&] { read_material("steel_304", {library}, parse_document(overrides, "s")); });
  };
  EXPECT_EQ(steel("[eos]\neta_max = 3.5\n"),
            One{"s:2: eos.eta_max: expected less than 3.05, where cold pressure no longer grows with density for "
                "these S1, S2, S3, gamma0 and b"});
  EXPECT_EQ(steel("[eos]\nmelt_temperature = \"200 K\"\n"),
            One{"s:2: eos.melt_temperature: expected more than reference_temperature (300 K)"});
  EXPECT_EQ(steel("[strength]\nyield_limit = \"0.25 GPa\"\n"),
            One{"s:2: strength.yield_limit: expected at least the yield stress (340 MPa)"});
  const auto tantalum = [](const std::string& strength) {
    return problems_of([&] { read_material("tantalum", {library}, parse_document("[strength]\n" + strength, "s")); });
  };
  EXPECT_EQ(tantalum("softening = \"1e-4 1/K\"\n").size(), 1u);
  EXPECT_EQ(tantalum("model = \"johnson_cook\"\nyield_stress = \"1 GPa\"\nhardening = \"1 GPa\"\n"
                     "hardening_exponent = 0.3\nrate_factor = 0.01\nsoftening_exponent = 1\n")
                .size(),
            2u);
  EXPECT_EQ(problems_of_text(tillotson + elastic +
                             "[strength]\nmodel = \"steinberg_guinan\"\nyield_stress = \"1 GPa\"\nyield_limit = "
                             "\"2 GPa\"\nhardening = 1\nhardening_exponent = 1\n"),
            One{"m.toml:17: strength.model: needs the temperature of eos.model = \"mie_grueneisen\""});
  EXPECT_EQ(problems_of_text("[eos]\nmodel = \"linear\"\ndensity = \"1 g/cm^3\"\n"),
            One{"m.toml:1: eos.c0: missing: sound speed"});
}

TEST(ReadMaterial, RefusesExplosivesThatMissTheirOwnDetonation) {
  const auto problem = [](const std::string& setting) {
    return problems_of(
        [&] { read_material("pbx_9501", {library}, parse_document("[eos]\n" + setting + "\n", "s.toml")); });
  };
  EXPECT_EQ(problem("detonation_speed = \"8.75 km/s\""), One{});
  EXPECT_EQ(problem("detonation_speed = \"9.0 km/s\""),
            One{"s.toml:2: eos.detonation_speed: expected 8.8 km/s within 1 %, which is what the constants of the "
                "products give (Chapman & Jouguet: D 8.8 km/s, 37 GPa, V 0.7403), got 9 km/s"});
  EXPECT_EQ(
      problem("cj_pressure = \"34 GPa\""),
      One{"s.toml:2: eos.cj_pressure: expected 37 GPa within 5 %, which is what the constants of the products give "
          "(Chapman & Jouguet: D 8.8 km/s, 37 GPa, V 0.7403), got 34 GPa"});
  // A mistyped constant shows in the speed.
  ASSERT_EQ(problem("A = \"582.4 GPa\"").size(), 2u);
  EXPECT_NE(problem("A = \"582.4 GPa\"")[0].find("eos.detonation_speed: expected "), std::string::npos);
  EXPECT_EQ(problem("E0 = 3").size(), 1u);
}

TEST(ReadMaterials, RefusesWhatBodiesCannotHave) {
  const auto problems = [](const std::string& numerics, const std::string& body) {
    return problems_of([&] { read_materials(parse_scene(scene_text(numerics, body), "s.toml"), library); });
  };
  EXPECT_EQ(problems("", ""), One{});
  EXPECT_EQ(problems("[numerics]\ndensity = \"summation\"\n", ""),
            One{"s.toml:9: bodies.target: numerics.density: expected continuity, got summation: pumice is no gas, and "
                "a summed "
                "density falls off at free surfaces"});
  EXPECT_EQ(problems("[numerics]\nscheme = \"gsph\"\n", ""),
            One{"s.toml:9: bodies.target: numerics.scheme: expected sph or asph, got gsph: pumice is no gas, and Riemann "
                "problems are of gases"});
  EXPECT_EQ(problems("", "pressure = \"1 Pa\"\n"),
            One{"s.toml:7: bodies.target: pressure: only a gas can be given one, and pumice is none"});
  EXPECT_EQ(problems("", "density = \"800 kg/m^3\"\n"),
            One{"s.toml:7: bodies.target: density: expected 700 kg/m^3, the "
                "bulk density of pumice, got 800 kg/m^3; to change it "
                "set materials.pumice.porosity.initial_distension"});
}

TEST(ReadMaterials, ExplosivesBurnAsParticles) {
  const auto problems = [](const std::string& more) {
    std::string text = scene_text("", more);
    text.replace(text.find("pumice"), 6, "lx_17");
    return problems_of([&] { read_materials(parse_scene(text, "s.toml"), library); });
  };
  EXPECT_EQ(problems("[numerics]\nscheme = \"asph\"\n"), One{});
  EXPECT_EQ(problems("[numerics]\nscheme = \"gsph\"\n"),
            One{"s.toml:7: bodies.target: numerics.scheme: expected sph or asph, got gsph: lx_17 is an explosive, which "
                "burns as particles"});
  EXPECT_EQ(problems("pressure = \"1 GPa\"\n"),
            One{"s.toml:7: bodies.target: pressure: only a gas can be given one, and lx_17 is none"});
}

TEST(ReadMaterials, CollectsTheProblemsOfAll) {
  const std::string second = "[[bodies]]\nname = \"b\"\nmaterial = \"unobtainium\"\nradius = \"1 cm\"\n";
  const Scene scene = parse_scene(scene_text("", second), "s.toml", {"materials.pumice.eos.A=3"});
  EXPECT_EQ(problems_of([&] { read_materials(scene, "lib"); }).size(), 2u);
  EXPECT_EQ(
      problems_of([&] { read_materials(parse_scene(scene_text(), "s.toml", {"materials.pumice.eos.A=3"}), library); }),
      One{"--set materials.pumice.eos.A: eos.A: expected a pressure such as \"26.7 GPa\", got 3 (the unit is "
          "missing)"});
}

TEST(ResolvedToml, RunsAgainWithoutTheMaterialFiles) {
  for (const auto& entry : fs::directory_iterator(fs::path(EJECTA_SOURCE_DIR) / "inputs")) {
    if (entry.path().extension() != ".toml") continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    if (text.str().find("\n[hybrid]") != std::string::npos) continue;  // its section is not known here
    const Scene scene = read_scene(entry.path().string());
    const Materials materials = read_materials(scene, library);
    const std::string resolved = resolved_toml(scene, materials);
    const Scene again = parse_scene(resolved, "resolved.toml");
    EXPECT_EQ(resolved_toml(again, read_materials(again, "no/library")), resolved) << entry.path();
  }
}

TEST(ShippedMaterials, AreAccepted) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(library)) {
    const std::string name = entry.path().stem().string();
    EXPECT_NO_THROW({ EXPECT_GT(read_material(name, {library}).bulk_density(), 0); }) << name;
    ++count;
  }
  EXPECT_GE(count, 28);
}

TEST(ShippedMaterials, EchoEveryConstantTheyWereGiven) {
  for (const auto& entry : fs::directory_iterator(library)) {
    const std::string name = entry.path().stem().string();
    std::string toml;
    read_material(name, {library}, {}, &toml);
    const Document echo = parse_document(toml, "echo");
    for (const auto& [path, item] : read_document(entry.path().string()).items)
      EXPECT_TRUE(echo.items.contains("materials." + name + "." + path)) << name << ": " << path;
  }
}

TEST(Reference, NamesEveryConstantAndEveryModel) {
  const std::string text = reference();
  for (const std::string key : {"gamma",
                                "E_iv",
                                "yield_stress",
                                "friction_angle",
                                "damaged_cohesion",
                                "limit",
                                "melt_energy",
                                "weibull_k",
                                "crack_speed_factor",
                                "transition_pressure",
                                "n2",
                                "crush_damage",
                                "shear_modulus",
                                "spacing",
                                "frames",
                                "melt_exponent",
                                "eta_max",
                                "stiffening",
                                "rate_factor",
                                "c0"})
    EXPECT_NE(text.find("\n  " + key + " "), std::string::npos) << key;
  for (const std::string model : {"collins", "two_power", "quadratic", "ideal_gas", "grady_kipp", "grady_kipp_tensor",
                                  "mie_grueneisen", "linear", "equilibrium_air", "jwl", "steinberg_guinan",
                                  "johnson_cook"})
    EXPECT_NE(text.find(": " + model), std::string::npos) << model;
}

TEST(Reference, OfOneSection) {
  EXPECT_NE(reference("strength").find("lundborg"), std::string::npos);
  EXPECT_EQ(reference("materials.strength"), reference("strength"));
  EXPECT_EQ(reference("strength").find("weibull"), std::string::npos);
  EXPECT_NE(reference("materials").find("weibull"), std::string::npos);
  EXPECT_EQ(problems_of([] { reference("nonsense"); }),
            One{"describe nonsense: no such section; without a name all are listed"});
}

TEST(MaterialReader, WhatStaysElasticBeyondATwentiethStretches) {
  for (const char* name : {"aluminium", "steel_304", "basalt", "pumice", "nylon", "ice", "air", "water"})
    EXPECT_FALSE(read_material(name, {library}).stretches()) << name;
  Material m = read_material("rubber", {library});
  EXPECT_TRUE(m.stretches());
  const double young = m.elastic->young();
  m.strength = VonMises{0.06 * young};
  EXPECT_TRUE(m.stretches());
  m.strength = VonMises{0.04 * young};
  EXPECT_FALSE(m.stretches());
  m.strength.reset();
  EXPECT_TRUE(m.stretches());
  m.damage = read_material("basalt", {library}).damage;
  EXPECT_FALSE(m.stretches()) << "what breaks needs no bonds";
}

}  // namespace
}  // namespace ejecta
