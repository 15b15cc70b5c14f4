#pragma once
/// The runs of the survival table: a ball of one material that hits a target of another, as a scene.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "hard_cases/shipped_materials.hpp"

namespace ejecta::survival {

inline constexpr std::array speeds{1, 3, 7, 10, 15, 20, 30};  // km/s
/// Discs with lengths, spheres, and discs with one numerical choice each.
inline constexpr std::array<std::string_view, 5> variants{"2d", "3d", "asph", "tensor", "mixed"};

struct Run {
  std::string ball, target;
  int speed;  ///< km/s
  std::string variant;

  int dimension() const { return variant == "3d" ? 3 : 2; }
  std::string name() const { return fmt::format("{} into {} {} {}", ball, target, speed, variant); }
};

/// Cracks with directions need a deviator, and a law that bounds it.
inline bool can_crack(const Material& material) { return material.damage && material.strength; }

inline const Material& material_named(const std::vector<Material>& materials, const std::string& name) {
  for (const Material& material : materials)
    if (material.name == name) return material;
  throw InputError(fmt::format("expected the name of a shipped material, got {}", name));
}

/// From "iron into ice 10 3d". Throws InputError.
inline Run parse_run(const std::string& text, const std::vector<Material>& materials) {
  std::array<char, 64> ball{}, target{}, variant{};
  Run run{};
  if (std::sscanf(text.c_str(), "%63s into %63s %d %63s", ball.data(), target.data(), &run.speed, variant.data()) !=
          4 ||
      run.speed <= 0 || !std::ranges::count(variants, std::string_view(variant.data())))
    throw InputError(
        fmt::format("expected BALL into TARGET SPEED VARIANT such as \"iron into ice 10 3d\", speeds in "
                    "km/s, variants 2d, 3d, asph, tensor, mixed; got \"{}\"",
                    text));
  run.ball = material_named(materials, ball.data()).name;
  run.target = material_named(materials, target.data()).name;
  run.variant = variant.data();
  return run;
}

/// The crack constants of a material again, with directions: a section that names a model replaces the file's.
inline std::string tensor_damage(const Material& material) {
  if (!can_crack(material)) return "";
  return fmt::format(
      "[materials.{}.damage]\nmodel = \"grady_kipp_tensor\"\nweibull_m = {}\nweibull_k = \"{} "
      "1/m^3\"\ncrack_speed_factor = {}\n",
      material.name, material.damage->weibull_m, material.damage->weibull_k, material.damage->crack_speed_factor);
}

/// The target is 18 spacings across (10 in 3D) and at rest, the ball 7 (4) and a spacing away. Enough time for the ball
/// to fly through the target four times if nothing stopped it. Gases start at 100 kPa.
inline std::string scene_of(const Run& run, const std::vector<Material>& materials) {
  const Material &ball = material_named(materials, run.ball), &target = material_named(materials, run.target);
  const bool flat = run.dimension() == 2;
  const double target_radius = flat ? 9 : 5, ball_radius = flat ? 3.5 : 2;  // mm, and spacings
  const double end = 8 * target_radius / run.speed;                         // us: mm/(km/s)
  const double distance = target_radius + ball_radius + 1;
  auto body = [&](std::string_view name, const Material& material, double radius) {
    return fmt::format("[[bodies]]\nname = \"{}\"\nmaterial = \"{}\"\nshape = \"{}\"\nradius = \"{} mm\"\n{}", name,
                       material.name, flat ? "disc" : "sphere", radius,
                       material.gas() ? "pressure = \"100 kPa\"\n" : "");
  };
  std::string text = fmt::format(
      "[scene]\nname = \"survival\"\ntitle = \"{}\"\ndimension = {}\n[resolution]\nspacing = \"1 mm\"\n"
      "[time]\nend = \"{} us\"\n",
      run.name(), run.dimension(), end);
  text += body("target", target, target_radius) + body("ball", ball, ball_radius);
  text += flat ? fmt::format("center = [0, \"{} mm\"]\nvelocity = [0, \"-{} km/s\"]\n", distance, run.speed)
               : fmt::format("center = [0, 0, \"{} mm\"]\nvelocity = [0, 0, \"-{} km/s\"]\n", distance, run.speed);
  if (run.variant == "tensor") text += tensor_damage(ball) + (ball.name == target.name ? "" : tensor_damage(target));
  if (run.variant == "asph") text += "[numerics]\nscheme = \"asph\"\n";
  if (run.variant == "mixed") text += "[numerics]\nprecision = \"mixed\"\n";
  return text + "[insitu]\nenabled = false\n";
}

/// Every material into every other, as discs.
inline std::vector<Run> every_pair(const std::vector<Material>& materials) {
  std::vector<Run> runs;
  for (const Material& ball : materials)
    for (const Material& target : materials)
      for (const int speed : speeds) runs.push_back({ball.name, target.name, speed, "2d"});
  return runs;
}

/// Every material into itself and into four common ones, in every variant but the plain one.
inline std::vector<Run> every_variant(const std::vector<Material>& materials) {
  std::vector<Run> runs;
  for (const std::string variant : {"3d", "asph", "tensor", "mixed"})
    for (const Material& ball : materials) {
      std::vector<std::string> targets{ball.name};
      for (const char* common : {"ice", "basalt", "water", "iron"})
        if (ball.name != common) targets.emplace_back(common);
      for (const std::string& target : targets) {
        if (variant == "tensor" && !can_crack(ball) && !can_crack(material_named(materials, target))) continue;
        for (const int speed : speeds) runs.push_back({ball.name, target, speed, variant});
      }
    }
  return runs;
}

/// A fixed spread for every test run: each material once as ball and once as target, and pairs that are known to be
/// hard. A material that came later has its pairs among these, so that those of the others stay as they are.
inline std::vector<Run> spread(const std::vector<Material>& all) {
  constexpr std::size_t step = 11;  // from a ball to its target, in the list
  std::vector<Material> materials;
  for (const Material& m : all)
    if (m.name != "air_equilibrium") materials.push_back(m);
  std::vector<Run> runs;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const Material &ball = materials[k], &target = materials[(k + step) % materials.size()];
    std::string variant(variants[k % variants.size()]);
    if (variant == "tensor" && !can_crack(ball) && !can_crack(target)) variant = "2d";
    runs.push_back({ball.name, target.name, speeds[k % speeds.size()], variant});
  }
  for (const char* hard : {"iron into ice 7 2d", "iron into ice 10 3d", "iron into ice 20 asph",
                           "aluminium into water 4 2d", "polycarbonate into polycarbonate 7 2d", "iron into nylon 7 2d",
                           "iron into dry_tuff 10 2d", "steel_304 into air 10 2d", "basalt into ice 15 tensor",
                           "ice into ice 30 mixed", "iron into water 30 3d", "pumice into pumice 20 2d",
                           "alluvium into alluvium 1 2d", "aermet_100 into anorthosite 1 2d",
                           "alluvium into rubber 1 2d", "iron into air_equilibrium 10 2d",
                           "air_equilibrium into basalt 10 3d"})
    runs.push_back(parse_run(hard, all));
  return runs;
}

}  // namespace ejecta::survival
