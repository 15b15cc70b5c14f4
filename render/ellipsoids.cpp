#include "render/ellipsoids.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "base/parallel.hpp"
#include "particles/smoothing_metric.hpp"

namespace ejecta {

namespace {

/// Eigenvalues, ascending, and unit eigenvectors, turned towards positive x.
template <int Dim>
struct Eigensystem {
  Vec<Dim> values;
  Mat<Dim> vectors;

  explicit Eigensystem(const Mat<Dim>& m) {
    Eigen::SelfAdjointEigenSolver<Mat<Dim>> solver;
    solver.computeDirect(m);
    values = solver.eigenvalues();
    vectors = solver.eigenvectors();
    for (int k = 0; k < Dim; ++k)
      if (vectors(0, k) < 0) vectors.col(k) *= -1;
  }
};

template <int Dim>
Mat<Dim> smoothing_metric(const Particles<Dim>& p, std::size_t i) {
  if (p.has(Field::smoothing_metric)) return p.symmetric(Field::smoothing_metric, i);
  return round_metric<Dim>(p.column(Field::smoothing_length)[i]);
}

std::string numbered(std::string_view name, int k) { return std::string(name) + "_" + std::to_string(k + 1); }

OwnedField scalar(std::string name, std::string unit, std::size_t n) {
  return {std::move(name), std::move(unit), {std::vector<double>(n, 0.0)}};
}
OwnedField vector(std::string name, std::string unit, std::size_t n) {
  return {std::move(name), std::move(unit), std::vector<std::vector<double>>(3, std::vector<double>(n, 0.0))};
}

template <int Dim>
void set(OwnedField& field, std::size_t i, const Vec<Dim>& v) {
  for (int a = 0; a < Dim; ++a) field.components[static_cast<std::size_t>(a)][i] = v[a];
}

template <int Dim>
double aspect(const Vec<Dim>& metric_eigenvalues) {
  return std::sqrt(metric_eigenvalues[Dim - 1] / metric_eigenvalues[0]);
}

OwnedField gathered(const std::string& name, const std::string& unit, std::span<const std::span<const double>> columns,
                    std::span<const std::size_t> chosen) {
  OwnedField field{name, unit, {}};
  for (const std::span<const double> column : columns) {
    std::vector<double>& target = field.components.emplace_back();
    target.reserve(chosen.size());
    for (const std::size_t i : chosen) target.push_back(column[i]);
  }
  return field;
}

/// Of a lattice symmetric about the plane one layer falls in, whether particles lie on the plane or beside it.
template <int Dim>
bool in_layer(const Particles<Dim>& p, std::size_t i, const Mat<Dim>& metric, double plane_y, double nodes_per_h) {
  if (Dim == 2) return true;
  const double spacing = std::sqrt(metric.inverse()(1, 1)) / nodes_per_h;
  const double y = p.column(Field::position, 1)[i] - plane_y;
  return y >= -0.25 * spacing && y < 0.75 * spacing;
}

}  // namespace

Channel Ellipsoids::channel(std::string name) const {
  Channel channel;
  channel.name = std::move(name);
  channel.count = id.size();
  for (std::size_t a = 0; a < 3; ++a) channel.position[a] = position[a];
  for (const OwnedField& field : fields) channel.fields.push_back(field.view());
  channel.indices = {{"id", id}};
  return channel;
}

template <int Dim>
std::vector<OwnedField> tensor_fields(const Particles<Dim>& p) {
  std::vector<OwnedField> fields;
  const std::size_t n = p.size();
  if (p.has(Field::smoothing_metric)) {
    fields.push_back(scalar("aspect", "1", n));
    std::vector<double>& values = fields.back().components[0];
    parallel_for(0, n, [&](std::size_t i) {
      values[i] = aspect<Dim>(Eigensystem<Dim>(p.symmetric(Field::smoothing_metric, i)).values);
    });
  }
  if (!p.has(Field::damage_tensor)) return fields;
  const std::size_t first = fields.size();
  for (int k = 0; k < Dim; ++k) fields.push_back(scalar(numbered("damage", k), "1", n));
  for (int k = 0; k < Dim; ++k) fields.push_back(vector(numbered("damage_axis", k), "1", n));
  parallel_for(0, n, [&](std::size_t i) {
    const Eigensystem<Dim> d(p.symmetric(Field::damage_tensor, i));
    for (int k = 0; k < Dim; ++k) {
      const int largest_first = Dim - 1 - k;
      const double value = d.values[largest_first];
      fields[first + static_cast<std::size_t>(k)].components[0][i] = value;
      set<Dim>(fields[first + static_cast<std::size_t>(Dim + k)], i, value * d.vectors.col(largest_first));
    }
  });
  return fields;
}

template <int Dim>
Ellipsoids find_ellipsoids(const Particles<Dim>& p, double plane_y, double nodes_per_h) {
  std::vector<std::size_t> chosen;
  std::vector<Eigensystem<Dim>> systems;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Mat<Dim> metric = smoothing_metric(p, i);
    if (!in_layer(p, i, metric, plane_y, nodes_per_h)) continue;
    const Eigensystem<Dim> system(metric);
    if (!(system.values[0] > 0)) continue;
    chosen.push_back(i);
    systems.push_back(system);
  }

  Ellipsoids e;
  const std::size_t n = chosen.size();
  for (int k = 0; k < Dim; ++k) e.fields.push_back(vector(numbered("axis", k), "m", n));
  e.fields.push_back(scalar("aspect", "1", n));
  if (Dim == 2) e.fields.push_back(scalar("orientation", "rad", n));
  for (std::size_t j = 0; j < n; ++j) {
    const auto& [values, vectors] = systems[j];
    for (int k = 0; k < Dim; ++k)
      set<Dim>(e.fields[static_cast<std::size_t>(k)], j, vectors.col(k) / std::sqrt(values[k]));
    e.fields[Dim].components[0][j] = aspect<Dim>(values);
    if (Dim == 2) e.fields[Dim + 1].components[0][j] = std::atan2(vectors(1, 0), vectors(0, 0));
  }
  for (const OwnedField& field : tensor_fields(p))
    if (field.name != "aspect") e.fields.push_back(gathered(field.name, field.unit, field.view().components, chosen));
  for (const Field f : p.fields())
    if (info(f).shape == Shape::scalar && info(f).role != Role::rate)
      e.fields.push_back(
          gathered(std::string(info(f).name), std::string(info(f).unit), std::array{p.column(f)}, chosen));
  for (int a = 0; a < Dim; ++a)
    for (const std::size_t i : chosen)
      e.position[static_cast<std::size_t>(a)].push_back(p.column(Field::position, a)[i]);
  if (Dim == 2) e.position[2].assign(n, 0.0);
  for (const std::size_t i : chosen) e.id.push_back(p.label(Label::id)[i]);
  return e;
}

template std::vector<OwnedField> tensor_fields<2>(const Particles<2>&);
template std::vector<OwnedField> tensor_fields<3>(const Particles<3>&);
template Ellipsoids find_ellipsoids<2>(const Particles<2>&, double, double);
template Ellipsoids find_ellipsoids<3>(const Particles<3>&, double, double);

}  // namespace ejecta
