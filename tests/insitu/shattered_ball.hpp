#pragma once
/// A made-up frame for the in-situ tests: a ball of rock struck from above, damaged around the point of impact and
/// broken into pieces that fly apart.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "insitu/pipelines.hpp"
#include "model/channel.hpp"

namespace ejecta {

struct ShatteredBall {
  static constexpr double radius = 0.035;  // m
  double spacing;                          // m
  std::vector<double> x, y, z, zero, vx, vy, vz, pressure, distension, damage, smoothing_length, mass;
  std::vector<std::int32_t> fragment, body;
  std::vector<double> filling, bodies_of_volume;
  std::vector<double> slice_pressure, slice_distension, slice_damage, slice_filling;
  std::vector<double> fx, fy, fz, fragment_mass;
  std::vector<std::int32_t> fragment_ids;
  int pixels;

  /// `age` goes from 0 (whole) to 1 (pieces one tenth of a radius apart).
  ShatteredBall(std::size_t particles, int fragment_count, int slice_pixels, double age)
      : spacing(radius * std::cbrt(4.18879 / static_cast<double>(particles))), pixels(slice_pixels) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-radius, radius);
    for (int f = 0; f < fragment_count; ++f) {
      fx.push_back(uniform(random));
      fy.push_back(uniform(random));
      fz.push_back(uniform(random));
      fragment_mass.push_back(0);
      fragment_ids.push_back(f + 1);
    }
    const int cells = static_cast<int>(radius / spacing) + 1;
    for (int k = -cells; k <= cells; ++k)
      for (int j = -cells; j <= cells; ++j)
        for (int i = -cells; i <= cells; ++i) add_particle(i * spacing, j * spacing, k * spacing, age);
    zero.assign(x.size(), 0.0);
    mass.assign(x.size(), 700 * spacing * spacing * spacing);
    body.assign(x.size(), 0);
    fill_volume();
    fill_slice(age);
  }

  std::size_t count() const { return x.size(); }

  Channel particles() const {
    Channel c;
    c.name = "particles";
    c.count = count();
    c.position = {x, y, z};
    c.fields = {{"velocity", "m/s", {vx, vy, vz}},
                {"pressure", "Pa", {pressure}},
                {"distension", "1", {distension}},
                {"damage", "1", {damage}},
                {"mass", "kg", {mass}},
                {"smoothing_length", "m", {smoothing_length}}};
    c.indices = {{"body", body}, {"fragment_number", fragment}};
    return c;
  }
  Channel slice() const {
    Channel c;
    c.name = "slice";
    c.kind = ChannelKind::image;
    c.count = slice_pressure.size();
    c.extent = {pixels, 1, pixels};
    c.origin = {-slice_half(), 0, -slice_half()};
    c.spacing = {2 * slice_half() / (pixels - 1), 1, 2 * slice_half() / (pixels - 1)};
    c.fields = {{"pressure", "Pa", {slice_pressure}},
                {"distension", "1", {slice_distension}},
                {"damage", "1", {slice_damage}},
                {"filling", "1", {slice_filling}}};
    return c;
  }
  Channel volume() const {
    Channel c;
    c.name = "volume";
    c.kind = ChannelKind::image;
    c.count = filling.size();
    c.extent = {volume_points, volume_points, volume_points};
    c.origin = {-slice_half(), 0, -slice_half()};
    const double step = 2 * slice_half() / (volume_points - 1);
    c.spacing = {step, step, step};
    c.fields = {{"filling", "1", {filling}}, {"body", "1", {bodies_of_volume}}};
    return c;
  }
  std::vector<Channel> channels() const { return {particles(), slice(), volume(), fragments()}; }
  Channel fragments() const {
    Channel c;
    c.name = "fragments";
    c.count = fx.size();
    c.position = {fx, fy, fz};
    c.fields = {{"mass", "kg", {fragment_mass}}, {"target_mass", "kg", {fragment_mass}}};
    c.indices = {{"number", fragment_ids}};
    return c;
  }
  PipelineSettings settings(const std::string& run_folder) const {
    PipelineSettings s;
    s.run_folder = run_folder;
    s.channels = {"particles", "slice", "ellipsoids", "volume", "fragments"};
    s.bodies = {{"ball", true}};
    s.fragment_target = "ball";
    s.image_width = 960;
    s.image_height = 720;
    s.scene_title = "Shattered ball";
    s.view_width = s.view_height = 3.2 * radius;
    s.time_end = 100e-6;
    s.particle_radius = 0.6 * spacing;
    s.slice_fields = {"pressure", "distension", "damage"};
    s.styles = {{"pressure", {"pressure", ColourMap::cool_warm, ColourRange{-50e6, 200e6}}},
                {"distension", {"distension", ColourMap::viridis, ColourRange{1, 3.3}}},
                {"damage", {"damage", ColourMap::plasma, ColourRange{0, 1}}}};
    return s;
  }

 private:
  static constexpr double slice_half() { return 1.5 * radius; }

  static double damage_at(double px, double py, double pz, double age) {
    const double distance = std::hypot(px, py, pz - radius) / radius;
    return std::clamp(2.2 * age + 0.6 - distance + 0.15 * std::sin(9 * std::atan2(py, px)), 0.0, 1.0);
  }
  static double pressure_at(double px, double py, double pz, double age) {
    const double distance = std::hypot(px, py, pz - radius) / radius, front = 2 * age;
    const double s = (distance - front) / 0.25;
    return 180e6 * std::exp(-s * s) - 40e6 * std::exp(-(s + 2) * (s + 2));
  }
  void add_particle(double px, double py, double pz, double age) {
    if (std::hypot(px, py, pz) > radius) return;
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (std::size_t f = 0; f < fx.size(); ++f) {
      const double d = std::hypot(px - fx[f], py - fy[f], pz - fz[f]) * (f == 0 ? 0.35 : 1);
      if (d < least) least = d, nearest = f;
    }
    const double d = damage_at(px, py, pz, age);
    const bool dust = d > 0.999;
    const double push = dust ? 0.5 * age : 0.15 * age;
    const double ax = dust ? px : fx[nearest], ay = dust ? py : fy[nearest], az = dust ? pz : fz[nearest];
    x.push_back(px + push * ax);
    y.push_back(py + push * ay);
    z.push_back(pz + push * az);
    vx.push_back(10 * ax / radius);
    vy.push_back(10 * ay / radius);
    vz.push_back(10 * az / radius);
    pressure.push_back(pressure_at(px, py, pz, age));
    damage.push_back(d);
    distension.push_back(3.3 - 2.3 * d);
    smoothing_length.push_back(1.3 * spacing);
    fragment.push_back(dust ? 0 : static_cast<std::int32_t>(nearest) + 1);
    if (!dust) fragment_mass[nearest] += 700 * spacing * spacing * spacing;
  }
  static constexpr int volume_points = 40;
  void fill_volume() {
    const double step = 2 * slice_half() / (volume_points - 1);
    for (int k = 0; k < volume_points; ++k)
      for (int j = 0; j < volume_points; ++j)
        for (int i = 0; i < volume_points; ++i) {
          const double r = std::hypot(i * step - slice_half(), j * step, k * step - slice_half());
          filling.push_back(std::clamp(0.5 + (radius - r) / (2 * step), 0.0, 1.0));
          bodies_of_volume.push_back(r < radius + step ? 0 : -1);
        }
  }
  void fill_slice(double age) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < pixels; ++k)
      for (int i = 0; i < pixels; ++i) {
        const double px = slice_half() * (2.0 * i / (pixels - 1) - 1), pz = slice_half() * (2.0 * k / (pixels - 1) - 1);
        const bool inside = std::hypot(px, pz) < radius;
        slice_filling.push_back(inside ? 1 : 0);
        slice_pressure.push_back(inside ? pressure_at(px, 0, pz, age) : nothing);
        slice_damage.push_back(inside ? damage_at(px, 0, pz, age) : nothing);
        slice_distension.push_back(inside ? 3.3 - 2.3 * damage_at(px, 0, pz, age) : nothing);
      }
  }
};

}  // namespace ejecta
