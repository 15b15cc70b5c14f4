#include "scene/blast.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/scene.hpp"
#include "scene/settings_io.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

Body body_of(const Charge& charge, const Scene& scene, const Document& document) {
  Body body;
  const bool plane = scene.dimension == 2;
  body.name = Charge::name;
  body.material = charge.material.empty() && scene.gas ? scene.gas->material : charge.material;
  body.shape = plane ? BodyShape::disc : BodyShape::sphere;
  body.center = charge.center;
  body.radius = charge.radius;
  body.density = charge.density;
  const double r = charge.radius, volume = std::numbers::pi * r * r * (plane ? 1 : 4 * r / 3);
  body.specific_energy = charge.energy_in(scene.dimension) / (charge.density * volume);
  body.origin = document.origin("charge").text;
  body.implied = true;
  return body;
}

Body body_of(const Gas& gas, const Scene& scene, const Document& document) {
  Body body;
  body.name = Gas::name;
  body.material = gas.material;
  body.shape = scene.dimension == 2 ? BodyShape::rectangle : BodyShape::box;
  const Boundary& box = scene.boundary;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool known = is_set(box.min[a]) && is_set(box.max[a]);
    body.size[a] = known ? box.length(a) : unset;
    body.center[a] = known ? 0.5 * (box.min[a] + box.max[a]) : 0;
  }
  if (scene.dimension == 2) body.center[2] = 0;
  body.density = gas.density;
  body.pressure = gas.pressure;
  body.origin = document.origin("gas").text;
  body.implied = true;
  return body;
}

}  // namespace

void add_blast(Scene& scene, const Document& document, Problems& problems) {
  const auto report = [&](const std::string& path, const std::string& message) {
    if (!problems.has(path)) problems.add(document.origin(path), path, message);
  };
  for (const Body& body : scene.bodies)
    if ((scene.charge && body.name == Charge::name) || (scene.gas && body.name == Gas::name))
      report("bodies", fmt::format("expected another name than \"{}\", which is that of [{}]", body.name, body.name));
  if (scene.charge) {
    const bool plane = scene.dimension == 2;
    if (!is_set(scene.charge->energy_in(scene.dimension)))
      report(plane ? "charge.energy_per_length" : "charge.energy",
             fmt::format("missing: a charge in {}D needs it", scene.dimension));
    if (is_set(plane ? scene.charge->energy : scene.charge->energy_per_length))
      report(plane ? "charge.energy" : "charge.energy_per_length",
             fmt::format("a charge in {}D has {}", scene.dimension, plane ? "an energy per length" : "an energy"));
    if (scene.charge->material.empty() && !scene.gas)
      report("charge.material", "missing: there is no [gas] whose material it could share");
    scene.bodies.insert(scene.bodies.begin(), body_of(*scene.charge, scene, document));
  }
  if (!scene.gas) return;
  scene.bodies.push_back(body_of(*scene.gas, scene, document));
  if (!is_set(scene.gas->gamma)) return;
  Document& values = scene.materials[scene.gas->material];
  const auto given = values.items.find("eos.gamma");
  const Item item{{scene.gas->gamma}, document.origin("gas.gamma")};
  if (given != values.items.end() && std::get_if<double>(&given->second.literal.value) &&
      std::get<double>(given->second.literal.value) != scene.gas->gamma)
    report("gas.gamma", fmt::format("expected the value of materials.{}.eos.gamma, {}, got {}", scene.gas->material,
                                    to_text(given->second.literal), scene.gas->gamma));
  values.items["eos.gamma"] = item;
}

}  // namespace ejecta
