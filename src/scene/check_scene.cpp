#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "scene/every.hpp"
#include "scene/formula.hpp"
#include "scene/names.hpp"
#include "scene/scene_reader.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

/// Reports against one document, and stays silent about a value that has already been refused.
struct Report {
  const Document& document;
  Problems& problems;
  void operator()(const std::string& path, const std::string& message) const {
    if (!problems.has(path)) problems.add(document.origin(path), path, message);
  }
};

/// "sphere, box or cylinder"
std::string shapes_in(int dimension) {
  std::vector<std::string_view> words;
  for (const ShapeInfo& shape : body_shapes)
    if (shape.dimension == dimension) words.push_back(shape.word);
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

void check_body(const Scene& scene, const Body& body, const std::string& path, const Report& report) {
  const ShapeInfo& shape = info(body.shape);
  if (shape.dimension != scene.dimension) {
    report(path + ".shape",
           fmt::format("expected {} in {}D, got \"{}\"", shapes_in(scene.dimension), scene.dimension, shape.word));
    return;
  }
  const auto check_size = [&](const char* key, bool needed, bool given) {
    if (needed && !given) report(path + "." + key, fmt::format("missing: a {} needs it", shape.word));
    if (!needed && given) report(path + "." + key, fmt::format("a {} has none", shape.word));
  };
  check_size("radius", shape.radius, is_set(body.radius));
  check_size("length", shape.length, is_set(body.length));
  check_size("size", shape.size, is_set(body.size[0]));
  if (shape.size && is_set(body.size[0]) &&
      !std::all_of(body.size.begin(), body.size.begin() + scene.dimension, [](double edge) { return edge > 0; }))
    report(path + ".size", fmt::format("expected {} lengths > 0", scene.dimension));
  double narrowest = std::numeric_limits<double>::infinity();
  for (const double width : widths(body, scene.dimension))
    if (width < narrowest) narrowest = width;
  if (body.inner_radius > 0 && !shape.radius)
    report(path + ".inner_radius", fmt::format("a {} has none", shape.word));
  else if (is_set(body.radius) && body.inner_radius >= body.radius)
    report(path + ".inner_radius",
           fmt::format("expected less than the radius {}, got {}", format_quantity(body.radius, "m"),
                       format_quantity(body.inner_radius, "m")));
  const bool shells = body.lattice == BodyLattice::shells;
  if (shells && !shape.radius)
    report(path + ".lattice", fmt::format("expected cubic, hexagonal or glass of a {}, got shells", shape.word));
  if (shells && scene.numerics.on_grid()) report(path + ".lattice", "expected particles alone with shells");
  if (!shells && body.aspect != 1) report(path + ".aspect", "expected 1 without lattice = \"shells\"");
  if (body.axis == Triple{0, 0, 0}) report(path + ".axis", "expected a direction, got [0, 0, 0]");
  // A body made to measure may be thinner than the spacing by rounding.
  const double spacing = scene.spacing * body.spacing_factor;
  if (is_set(spacing) && narrowest < spacing * (1 - 1e-9))
    report(path + (shape.size ? ".size" : ".radius"),
           fmt::format("expected at least one particle across, got {} at a spacing of {}",
                       format_quantity(narrowest, "m"), format_quantity(spacing, "m")));
  if (scene.dimension == 2 && (body.velocity[2] != 0 || body.center[2] != 0))
    report(path + (body.velocity[2] != 0 ? ".velocity" : ".center"), "expected no z component in 2D");
  constexpr double fastest = 1e150;  // m/s; squares of more overflow
  if (const auto& [x, y, z] = body.velocity; !(std::hypot(x, y, z) < fastest))
    report(path + ".velocity",
           fmt::format("expected less than {:.0e} m/s, so that energies are numbers, got {:.3g} m/s", fastest,
                       std::hypot(x, y, z)));
  if (is_set(body.pressure) && body.specific_energy != 0)
    report(path + ".pressure", "expected either pressure or specific_energy, got both");
}

void check_profile(const Scene& scene, const Body& body, const std::string& path, const Report& report) {
  const Profile& profile = body.profile;
  const auto compiles = [&](const std::string& key, const std::string& text) {
    try {
      Formula{text};
    } catch (const InputError& error) {
      report(path + "." + key, error.what());
    }
  };
  const auto check_list = [&](const std::string& key, const std::vector<std::string>& texts, int components) {
    if (!texts.empty() && texts.size() != static_cast<std::size_t>(components))
      report(path + "." + key,
             fmt::format("expected {} formulas in {}D, got {}", components, scene.dimension, texts.size()));
    for (const std::string& text : texts) compiles(key, text);
  };
  check_list("displacement", profile.displacement, scene.dimension);
  check_list("velocity", profile.velocity, scene.dimension);
  check_list("deviatoric_stress", profile.deviatoric_stress, scene.dimension == 2 ? 3 : 5);
  if (!profile.density.empty()) compiles("density", profile.density);
  if (!profile.pressure.empty()) compiles("pressure", profile.pressure);
  if (!profile.specific_energy.empty()) compiles("specific_energy", profile.specific_energy);
  if (!profile.pressure.empty() && !profile.specific_energy.empty())
    report(path + ".pressure", "expected either pressure or specific_energy, got both");
}

void check_detonator(const Scene& scene, const Detonator& detonator, const std::string& path, const Report& report) {
  const auto check_key = [&](const char* key, const Triple& value, bool needed) {
    if (needed != is_set(value[0]))
      report(path + "." + key,
             fmt::format(fmt::runtime(needed ? "missing: a {} needs it" : "a {} has none"), name_of(detonator.shape)));
    const bool along_z = key == std::string_view("normal") && value[0] == 0 && value[1] == 0;
    if (scene.dimension == 2 && is_set(value[0]) && value[2] != 0 && !along_z)
      report(path + "." + key, "expected no z component in 2D");
  };
  check_key("position", detonator.position, true);
  check_key("end", detonator.end, detonator.shape == DetonatorShape::line);
  check_key("normal", detonator.normal, detonator.shape == DetonatorShape::plane);
  if (detonator.normal == Triple{0, 0, 0}) report(path + ".normal", "expected a direction, got [0, 0, 0]");
  if (is_set(detonator.end[0]) && detonator.end == detonator.position)
    report(path + ".end", "expected another place than position");
}

/// A body that stands for [charge] or [gas].
void check_implied(const Scene& scene, const Body& body, const Report& report) {
  const bool grid = scene.numerics.on_grid();
  const bool as_it_is = scene.charge && (!scene.gas || scene.charge->start == 0);  // else it is wider at the start
  if (body.name == Charge::name && as_it_is && !grid && is_set(scene.spacing) && 2 * body.radius < scene.spacing)
    report("charge.radius", fmt::format("expected at least one particle across, got {} at a spacing of {}",
                                        format_quantity(body.radius, "m"), format_quantity(scene.spacing, "m")));
  if (body.name != Gas::name || grid || report.problems.has("numerics.scheme")) return;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
    if (!is_set(body.size[a]))
      return report("gas", "needs boundary.min and boundary.max along every axis, so that particles can fill the box");
}

void check_boundary(const Scene& scene, const Report& report) {
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const BoundaryKind lower = scene.boundary.lower[k], upper = scene.boundary.upper[k];
    const bool bounded = lower != BoundaryKind::open || upper != BoundaryKind::open;
    if (!bounded) continue;
    std::string path = std::string("boundary.") + axes[k];
    if (!report.document.items.contains(path)) path += lower != BoundaryKind::open ? "_min" : "_max";
    const double min = scene.boundary.min[k], max = scene.boundary.max[k];
    if (k == 2 && scene.dimension == 2)
      report(path, "expected open in 2D");
    else if ((lower == BoundaryKind::periodic) != (upper == BoundaryKind::periodic))
      report(path,
             fmt::format("expected both faces to be periodic or none, got {} and {}", name_of(lower), name_of(upper)));
    else if (lower != BoundaryKind::open && !is_set(min))
      report(path, fmt::format("needs boundary.min along {}", axes[k]));
    else if (upper != BoundaryKind::open && !is_set(max))
      report(path, fmt::format("needs boundary.max along {}", axes[k]));
    else if (lower != BoundaryKind::open && upper != BoundaryKind::open && !(min < max))
      report(path, fmt::format("expected boundary.min < boundary.max along {}, got {} and {}", axes[k],
                               format_quantity(min, "m"), format_quantity(max, "m")));
  }
}

/// When something is to be drawn.
void check_triggers(const Scene& scene, const Report& report) {
  const auto check_every = [&](const std::string& path, const std::string& text) {
    try {
      parse_every(text);
    } catch (const InputError& error) {
      report(path, error.what());
    }
  };
  for (const std::string& text : scene.insitu.every) check_every("insitu.every", text);
  for (std::size_t k = 0; k < scene.insitu.pipelines.size(); ++k)
    if (const std::string& text = scene.insitu.pipelines[k].every; !text.empty())
      check_every(element_path("insitu.pipelines", k) + ".every", text);
  for (const std::string& word : scene.insitu.events) {
    const auto known = std::ranges::find(event_words, word);
    if (known == event_words.end())
      report("insitu.events",
             fmt::format("expected some of \"{}\", got \"{}\"", fmt::join(event_words, "\", \""), word));
    else if (word == event_words[0] && scene.numerics.on_grid())
      report("insitu.events", fmt::format("\"{}\" needs particles alone, without a grid", word));
    else if (word.find("fragment") != std::string::npos && !scene.fragments.enabled)
      report("insitu.events", fmt::format("\"{}\" needs fragments.enabled = true", word));
  }
}

void check_probe(const Scene& scene, const Probe& probe, const std::string& path, const Report& report) {
  if (scene.dimension == 2 && ((is_set(probe.at[2]) && probe.at[2] != 0) || probe.direction[2] != 0))
    report(path + (probe.direction[2] != 0 ? ".direction" : ".at"), "expected no z component in 2D");
  const bool beam = probe.beam();
  if (beam && !probe.directed())
    report(path + ".direction", fmt::format("missing: a {} needs it", name_of(probe.kind)));
  if (!beam && is_set(probe.spot)) report(path + ".spot", fmt::format("a {} has none", name_of(probe.kind)));
  if (!beam && is_set(probe.range)) report(path + ".range", fmt::format("a {} has none", name_of(probe.kind)));
  if (probe.kind != ProbeKind::point && scene.numerics.scheme == SchemeKind::fvm)
    report(path + ".kind", fmt::format("expected point on a grid, got {}", name_of(probe.kind)));
  std::vector<std::string> names;
  for (const Body& body : scene.bodies) names.push_back(body.name);
  if (!probe.body.empty() && std::ranges::find(names, probe.body) == names.end())
    report(path + ".body",
           fmt::format("expected the name of a body ({}), got \"{}\"", fmt::join(names, ", "), probe.body));
  const double between = is_set(probe.interval) ? probe.interval : scene.row_interval();
  if (probe.window > between * (1 + 1e-9))
    report(path + ".window", fmt::format("expected no more than the interval between rows, {}, got {}",
                                         format_quantity(between, "s"), format_quantity(probe.window, "s")));
}

void check_theory(const FragmentTheory& theory, const std::string& path, const Report& report) {
  for (const auto& [key, range] :
       {std::pair("fracture_energy", &theory.fracture_energy), std::pair("flow_stress", &theory.flow_stress),
        std::pair("mott_gamma", &theory.mott_gamma)})
    if (range->size() > 2 || !std::ranges::is_sorted(*range))
      report(fmt::format("{}.{}", path, key),
             fmt::format("expected one number, or the lower and the upper end of a range, got {}",
                         fmt::join(*range, ", ")));
  if (theory.flow_stress.empty() != theory.mott_gamma.empty())
    report(path + (theory.flow_stress.empty() ? ".flow_stress" : ".mott_gamma"), "missing: Mott's prediction needs it");
  if (theory.any() && !is_set(theory.strain_rate)) report(path + ".strain_rate", "missing: the predictions need it");
  if (theory.any() && !is_set(theory.thickness)) report(path + ".thickness", "missing: the predictions need it");
}

/// What Riemann problems between particles cannot do, and what nothing else can.
void check_godunov(const Numerics& n, const Report& report) {
  const std::string scheme{name_of(n.scheme)};
  const auto refuse_if = [&](bool wrong, const char* key, const char* expected) {
    if (wrong) report(key, fmt::format("expected {}, got {}", expected, scheme));
  };
  refuse_if(n.kernel == Kernel::gaussian && !n.godunov() && n.scheme != SchemeKind::fvm, "numerics.kernel",
            "scheme gsph, agsph or hybrid with gaussian");
  refuse_if(is_set(n.pilot_width) && n.scheme != SchemeKind::gsph, "numerics.pilot_width", "scheme gsph with it");
  refuse_if(n.fill_space == Switch::on && n.scheme != SchemeKind::gsph && n.scheme != SchemeKind::agsph,
            "numerics.fill_space", "scheme gsph or agsph with it");
  refuse_if(n.linear_conduction > 0 && !n.godunov(), "numerics.linear_conduction",
            "scheme gsph, agsph or hybrid with it");
  refuse_if(n.quadratic_conduction > 0 && !n.godunov(), "numerics.quadratic_conduction",
            "scheme gsph, agsph or hybrid with it");
  if (is_set(n.pilot_width) && n.density != DensityMethod::summation)
    report("numerics.pilot_width", fmt::format("expected density summation with it, got {}", name_of(n.density)));
  if (n.fill_space == Switch::on && n.density != DensityMethod::summation)
    report("numerics.fill_space", fmt::format("expected density summation with it, got {}", name_of(n.density)));
  if (!n.godunov()) return;
  if (n.precision == Precision::mixed)
    report("numerics.precision", fmt::format("expected double with scheme {}, got mixed", scheme));
  const auto refuse = [&](const char* key, Switch choice) {
    if (choice == Switch::on) report(fmt::format("numerics.{}", key), fmt::format("scheme {} has none", scheme));
  };
  refuse("gradient_correction", n.gradient_correction);
  refuse("balsara", n.balsara);
  refuse("shock_switch", n.shock_switch);
  refuse("bonds", n.bonds);
}

}  // namespace

void check_scene(const Scene& scene, const Document& document, Problems& problems) {
  const Report report{document, problems};
  check_triggers(scene, report);
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  const auto check_name = [&](const std::string& path, const std::string& name) {
    if (!name.empty() && name.find_first_not_of(plain) == std::string::npos) return;
    if (document.items.contains(path)) report(path, fmt::format("expected letters, digits, _ and -, got \"{}\"", name));
  };
  check_name("scene.name", scene.name);
  std::set<std::string> names, used_materials;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const Body& body = scene.bodies[k];
    if (body.implied) {
      used_materials.insert(body.material);
      names.insert(body.name);
      check_implied(scene, body, report);
      continue;
    }
    const std::string path = fmt::format("bodies[{}]", k - (scene.charge ? 1 : 0));  // as in the file
    check_name(path + ".name", body.name);
    check_name(path + ".material", body.material);
    if (!body.name.empty() && !names.insert(body.name).second)
      report(path + ".name", fmt::format("expected a name of its own, got \"{}\" again", body.name));
    used_materials.insert(body.material);
    check_body(scene, body, path, report);
    const auto named = [&](const Body& other) { return &other != &body && other.name == body.weld; };
    if (body.weld != "auto" && body.weld != "none" && std::none_of(scene.bodies.begin(), scene.bodies.end(), named))
      report(path + ".weld", fmt::format("expected the name of another body, none or auto, got \"{}\"", body.weld));
    check_profile(scene, body, path + ".profile", report);
  }
  for (const auto& [name, values] : scene.materials)
    if (!used_materials.contains(name)) {
      const Origin origin = values.items.empty() ? Origin{document.file, 0} : values.items.begin()->second.origin;
      problems.add(origin, "materials." + name, "no body is made of it");
    }
  std::set<std::string> probe_names;
  for (std::size_t k = 0; k < scene.probes.size(); ++k) {
    const std::string path = element_path("probes", k);
    check_name(path + ".name", scene.probes[k].name);
    if (!probe_names.insert(scene.probes[k].name).second)
      report(path + ".name", fmt::format("expected a name of its own, got \"{}\" again", scene.probes[k].name));
    check_probe(scene, scene.probes[k], path, report);
  }
  for (std::size_t k = 0; k < scene.detonators.size(); ++k)
    check_detonator(scene, scene.detonators[k], element_path("detonators", k), report);
  check_boundary(scene, report);
  check_godunov(scene.numerics, report);
  check_theory(scene.fragments.theory, "fragments.theory", report);
  if (!scene.fragments.measured.empty() && scene.dimension == 2)
    report("fragments.measured", "expected none in 2D, where masses are per metre");
  if (const std::string& target = scene.fragments.target; !target.empty() && !names.contains(target))
    report("fragments.target",
           fmt::format("expected the name of a body ({}), got \"{}\"", fmt::join(names, ", "), target));
}

}  // namespace ejecta
