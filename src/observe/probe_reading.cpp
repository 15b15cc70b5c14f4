#include "observe/probe_reading.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "observe/solvers.hpp"
#include "scene/shape_geometry.hpp"
#include "schemes/cracked_stress.hpp"
#include "schemes/kernels.hpp"
#include "sph/particle_state.hpp"

namespace ejecta {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// A point with less of a kernel filled around it is outside of matter; on a plane surface one half is.
constexpr double filled = 0.4;

/// In plane strain there is a stress along z too.
template <int Dim>
std::vector<CsvColumn> stress_columns() {
  std::vector<CsvColumn> list{{"stress xx", "Pa"}, {"stress yy", "Pa"}, {"stress zz", "Pa"}, {"stress xy", "Pa"}};
  if (Dim == 3) list.insert(list.end(), {{"stress xz", "Pa"}, {"stress yz", "Pa"}});
  return list;
}

template <int Dim>
std::vector<CsvColumn> columns_of(const Probe& probe, const Particles<Dim>* p) {
  std::vector<CsvColumn> list{{"density", "kg/m^3"}, {"pressure", "Pa"}};
  constexpr std::array<const char*, 3> velocity{"velocity x", "velocity y", "velocity z"};
  constexpr std::array<const char*, 3> place{"x", "y", "z"};
  for (std::size_t a = 0; a < Dim; ++a) list.push_back({velocity[a], "m/s"});
  list.push_back({"specific energy", "J/kg"});
  if (p && p->has(Field::deviatoric_stress)) {
    std::ranges::move(stress_columns<Dim>(), std::back_inserter(list));
    list.push_back({"plastic strain", "1"});
  }
  if (p && p->has(Field::damage)) list.push_back({"damage", "1"});
  if (probe.rides())
    for (std::size_t a = 0; a < Dim; ++a) list.push_back({place[a], "m"});
  return list;
}

/// Tension positive, in the order of stress_columns().
template <int Dim>
std::vector<double> cauchy_stress(const Particles<Dim>& p, std::size_t i) {
  Mat<3> s = full_tensor<Dim>(deviator(p, i));
  auto in_plane = s.template topLeftCorner<Dim, Dim>();
  if (p.has(Field::damage_tensor)) in_plane = transmitted<Dim>(in_plane, p.symmetric(Field::damage_tensor, i));
  if (p.has(Field::intact_share)) s *= p.column(Field::intact_share)[i];
  s -= p.column(Field::pressure)[i] * Mat<3>::Identity();
  std::vector<double> list{s(0, 0), s(1, 1), s(2, 2), s(0, 1)};
  if (Dim == 3) list.insert(list.end(), {s(0, 2), s(1, 2)});
  return list;
}

/// The columns of one particle, without the place.
template <int Dim>
std::vector<double> values_of(const Particles<Dim>& p, std::size_t i) {
  std::vector<double> values{p.column(Field::density)[i], p.column(Field::pressure)[i]};
  for (int a = 0; a < Dim; ++a) values.push_back(p.column(Field::velocity, a)[i]);
  values.push_back(p.column(Field::specific_energy)[i]);
  if (p.has(Field::deviatoric_stress)) {
    std::ranges::copy(cauchy_stress(p, i), std::back_inserter(values));
    values.push_back(p.has(Field::plastic_strain) ? p.column(Field::plastic_strain)[i] : 0);
  }
  if (p.has(Field::damage)) values.push_back(p.column(Field::damage)[i]);
  return values;
}

template <int Dim>
std::optional<std::int32_t> label_of(const Sph<Dim>& sph, const Probe& probe) {
  if (probe.body.empty()) return std::nullopt;
  const auto named = std::ranges::find(sph.scene.bodies, probe.body, &Body::name);
  return static_cast<std::int32_t>(named - sph.scene.bodies.begin());
}

template <int Dim>
std::optional<std::size_t> nearest_particle(const Particles<Dim>& p, const Vec<Dim>& x,
                                            const std::optional<std::int32_t>& body) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (body && p.label(Label::body)[i] != *body) continue;
    const double d2 = (p.vector(Field::position, i) - x).squaredNorm();
    if (d2 < least) {
      least = d2;
      nearest = i;
    }
  }
  return nearest;
}

/// Values and gradient of the velocity at x by a linear fit to the particles of one body around it; their mean where
/// they are too few, or stand in a row. `fill`: what of a kernel they fill.
template <int Dim>
struct Fit {
  std::vector<double> values;
  Mat<Dim> gradient = Mat<Dim>::Zero();
  double fill = 0;

  Fit(const Particles<Dim>& p, const Vec<Dim>& x, std::int32_t body) {
    using Moments = Eigen::Matrix<double, Dim + 1, Dim + 1>;
    Moments moments = Moments::Zero();
    Eigen::MatrixXd sums;
    double unit = 0;  // m; the largest h
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.label(Label::body)[i] != body) continue;
      const double h = p.column(Field::smoothing_length)[i];
      const Vec<Dim> d = p.vector(Field::position, i) - x;
      const double q = d.norm() / h;
      if (q >= WendlandC2::support) continue;
      const double weight = p.column(Field::mass)[i] / p.column(Field::density)[i] * WendlandC2::norm<Dim> *
                            WendlandC2::value(q) / std::pow(h, Dim);
      const std::vector<double> of_particle = values_of(p, i);
      if (sums.size() == 0) sums = Eigen::MatrixXd::Zero(Dim + 1, static_cast<Eigen::Index>(of_particle.size()));
      Eigen::Matrix<double, Dim + 1, 1> basis;
      basis << 1, d;
      moments += weight * basis * basis.transpose();
      sums += weight * basis *
              Eigen::Map<const Eigen::RowVectorXd>(of_particle.data(), static_cast<Eigen::Index>(of_particle.size()));
      fill += weight;
      unit = std::max(unit, h);
    }
    if (sums.size() == 0) return;
    values.assign(static_cast<std::size_t>(sums.cols()), 0);
    // In units of the smoothing length all moments are alike, and a small pivot tells a row from a cloud.
    Eigen::Matrix<double, Dim + 1, 1> scale;
    scale << 1, Vec<Dim>::Constant(1 / unit);
    const Moments scaled = scale.asDiagonal() * moments * scale.asDiagonal();
    const Eigen::LDLT<Moments> solver(scaled);
    constexpr double least_pivot = 1e-2;
    const bool cloud = solver.vectorD().minCoeff() > least_pivot * scaled(0, 0);
    Eigen::MatrixXd fit = sums / fill;
    if (cloud) {
      sums.bottomRows(Dim) /= unit;
      fit = solver.solve(sums);
      fit.bottomRows(Dim) /= unit;
    }
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = fit(0, static_cast<Eigen::Index>(k));
    if (cloud) gradient = fit.template block<Dim, Dim>(1, 2).transpose();  // the velocity follows density and pressure
  }
};

template <int Dim>
std::optional<ProbeReading> read_particles(const Sph<Dim>& sph, const Probe& probe, std::int32_t id) {
  const Particles<Dim>& p = sph.particles;
  Vec<Dim> x = first_components<Dim>(probe.at);
  std::optional<std::size_t> near;
  if (probe.rides()) {
    const auto ids = p.label(Label::id);
    near = static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin());
    if (*near == p.size()) return std::nullopt;
    x = p.vector(Field::position, *near);
  } else {
    near = nearest_particle(p, x, label_of(sph, probe));
  }
  if (!near) return std::nullopt;
  Fit<Dim> fit(p, x, p.label(Label::body)[*near]);
  if (fit.values.empty() || (probe.kind == ProbeKind::point && fit.fill < filled)) return std::nullopt;
  ProbeReading reading{std::move(fit.values)};
  reading.gradient.template topLeftCorner<Dim, Dim>() = fit.gradient;
  if (probe.rides())
    for (int a = 0; a < Dim; ++a) reading.values.push_back(x[a]);
  return reading;
}

/// A particle of the surface that a beam meets.
struct Met {
  std::size_t particle;
  double distance;  ///< from the beginning of the beam to the front of the particle, along it [m]
  double aside;     ///< of its centre from the axis of the beam [m]
};

/// What of the beam's particles is nearest, to half a particle.
template <int Dim>
std::vector<Met> surface_met(const Sph<Dim>& sph, const Probe& probe) {
  const Particles<Dim>& p = sph.particles;
  const Vec<Dim> begin = first_components<Dim>(probe.at);
  const Vec<Dim> along = first_components<Dim>(probe.direction).normalized();
  const double spot = is_set(probe.spot) ? probe.spot : sph.scene.spacing;
  const double range = is_set(probe.range) ? probe.range : std::numeric_limits<double>::infinity();
  const auto body = label_of(sph, probe);
  const auto size = [&](std::size_t i) {
    return std::pow(p.column(Field::mass)[i] / p.column(Field::density)[i], 1.0 / Dim);
  };
  std::vector<Met> in_beam;
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (body && p.label(Label::body)[i] != *body) continue;
    const Vec<Dim> d = p.vector(Field::position, i) - begin;
    const double ahead = d.dot(along), aside = (d - ahead * along).norm();
    if (ahead < 0 || ahead > range || aside > spot) continue;
    in_beam.push_back({i, ahead - 0.5 * size(i), aside});
    first = std::min(first, in_beam.back().distance);
  }
  std::erase_if(in_beam, [&](const Met& met) { return met.distance > first + 0.5 * size(met.particle); });
  return in_beam;
}

template <int Dim>
ProbeReading read_beam(const Sph<Dim>& sph, const Probe& probe) {
  const Particles<Dim>& p = sph.particles;
  const Vec<Dim> along = first_components<Dim>(probe.direction).normalized();
  double mass = 0, velocity = 0, distance = 0;
  for (const Met& met : surface_met(sph, probe)) {
    const double m = p.column(Field::mass)[met.particle];
    mass += m;
    velocity -= m * p.vector(Field::velocity, met.particle).dot(along);
    distance += m * met.distance;
  }
  if (mass == 0) return {{nothing, nothing}};
  return {{velocity / mass, distance / mass}};
}

}  // namespace

std::optional<Mount> mount(const Simulation& sim, const Probe& probe) {
  std::optional<Mount> found;
  with_particles(sim, [&]<int Dim>(const Sph<Dim>& sph) {
    if (probe.kind == ProbeKind::surface) {
      const std::vector<Met> met = surface_met(sph, probe);
      const auto middle = std::ranges::min_element(met, {}, &Met::aside);
      if (middle != met.end()) found = {sph.particles.label(Label::id)[middle->particle], middle->distance};
      return;
    }
    const Vec<Dim> x = first_components<Dim>(probe.at);
    if (const auto near = nearest_particle(sph.particles, x, label_of(sph, probe)))
      found = {sph.particles.label(Label::id)[*near], (sph.particles.vector(Field::position, *near) - x).norm()};
  });
  return found;
}

std::vector<CsvColumn> reading_columns(const Simulation& sim, const Probe& probe) {
  if (probe.kind == ProbeKind::velocimeter) return {{"velocity", "m/s"}, {"distance", "m"}};
  std::vector<CsvColumn> columns;
  with_particles(sim, [&]<int Dim>(const Sph<Dim>& sph) { columns = columns_of<Dim>(probe, &sph.particles); });
  if (columns.empty())
    columns = sim.scene.dimension == 2 ? columns_of<2>(probe, nullptr) : columns_of<3>(probe, nullptr);
  return columns;
}

ProbeReading read_probe(const Simulation& sim, const Probe& probe, std::int32_t id) {
  std::optional<ProbeReading> reading;
  with_particles(sim, [&](const auto& sph) {
    if (probe.kind == ProbeKind::velocimeter)
      reading = read_beam(sph, probe);
    else
      reading = read_particles(sph, probe, id);
  });
  const std::size_t size = reading_columns(sim, probe).size();
  if (!reading)
    with_grid(sim, [&]<int Dim>(const Grid<Dim>& grid) {
      const auto cell = grid.at(first_components<Dim>(probe.at));
      if (!cell) return;
      reading = ProbeReading{{cell->density, cell->pressure}};
      for (int a = 0; a < Dim; ++a) reading->values.push_back(cell->velocity[a]);
      reading->values.push_back(cell->specific_energy);
    });
  if (!reading) reading.emplace();
  reading->values.resize(size, nothing);
  return *reading;
}

}  // namespace ejecta
