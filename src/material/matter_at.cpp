#include "material/matter_at.hpp"

#include <algorithm>
#include <cmath>

#include "material/material_reader.hpp"
#include "scene/shape_geometry.hpp"

namespace ejecta {

template <int Dim>
MatterAt<Dim>::MatterAt(const Scene& scene, const std::vector<Material>& materials, double spacing,
                        const RadialState* around)
    : scene_(scene), spacing_(spacing), around_(around), formulas_(scene.bodies.size()) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    material_.push_back(&*std::ranges::find(materials, body.material, &Material::name));
    const auto compile = [](const std::string& text) {
      return text.empty() ? std::nullopt : std::optional<Formula>(text);
    };
    const Profile& profile = body.profile;
    formulas_[b].density = compile(profile.density);
    formulas_[b].pressure = compile(profile.pressure);
    formulas_[b].specific_energy = compile(profile.specific_energy);
    for (const std::string& text : profile.velocity) formulas_[b].velocity.emplace_back(text);
  }
}

template <int Dim>
bool MatterAt<Dim>::varies() const {
  return std::ranges::any_of(formulas_, &Formulas::any);
}

template <int Dim>
bool MatterAt<Dim>::is_around(const Vec<Dim>& x, double distance) const {
  return around_ && (x - first_components<Dim>(around_->center)).norm() < around_->radius() + distance;
}

template <int Dim>
Matter<Dim> MatterAt<Dim>::of_body(std::size_t b, const Vec<Dim>& x) const {
  const Body& body = scene_.bodies[b];
  const Material& material = *material_[b];
  const Formulas& formulas = formulas_[b];
  const FormulaPoint point = formula_point<Dim>(body, x, spacing_);
  const auto value = [&](const Formula& formula, const char* key, bool positive) {
    const double v = formula(point);
    if (!std::isfinite(v) || (positive && !(v > 0)))
      refuse_value(body, key, positive ? "a number > 0" : "a finite number", v, point);
    return v;
  };
  Matter<Dim> m;
  m.body = b;
  m.density = is_set(body.density) ? body.density : material.bulk_density();
  if (formulas.density) m.density = value(*formulas.density, "density", true);
  m.specific_energy = initial_energy(body, material, m.density);
  if (formulas.specific_energy) m.specific_energy = value(*formulas.specific_energy, "specific_energy", false);
  if (formulas.pressure)
    m.specific_energy =
        specific_energy_at(material.eos, m.density, value(*formulas.pressure, "pressure", false)).value();
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    m.velocity[a] = formulas.velocity.empty() ? body.velocity[k] : value(formulas.velocity[k], "velocity", false);
  }
  return m;
}

template <int Dim>
void MatterAt<Dim>::set_around(Matter<Dim>& m, const Vec<Dim>& x) const {
  const Vec<Dim> d = x - first_components<Dim>(around_->center);
  const double r = d.norm();
  const auto cell = static_cast<std::size_t>(r / around_->spacing);
  if (cell >= around_->density.size()) return;
  m.density = around_->density[cell];
  m.specific_energy = around_->specific_energy[cell];
  m.velocity = r > 0 ? Vec<Dim>(around_->velocity[cell] / r * d) : Vec<Dim>::Zero();
}

template <int Dim>
std::optional<Matter<Dim>> MatterAt<Dim>::operator()(const Vec<Dim>& x) const {
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const Body& body = scene_.bodies[b];
    const bool background = body.implied && body.name == Gas::name;
    const Vec<Dim> image = nearest_image<Dim>(scene_.boundary, body, x), d = image - first_components<Dim>(body.center);
    if (!background && !with_shape<Dim>(body, [&](const auto& shape) { return shape.contains(d); })) continue;
    Matter<Dim> m = of_body(b, image);
    if (around_) set_around(m, x);
    return m;
  }
  return std::nullopt;
}

template <int Dim>
std::optional<std::array<double, Dim + 2>> MatterAt<Dim>::mean(const Vec<Dim>& x, double edge, int n) const {
  std::array<double, Dim + 2> sum{};
  int count = 0;
  bool filled = true;
  for_points<Dim>(x, edge, n, [&](const Vec<Dim>& point) {
    const auto found = (*this)(point);
    if (!found) return void(filled = false);
    const auto u = found->conserved();
    for (std::size_t c = 0; c < u.size(); ++c) sum[c] += u[c];
    ++count;
  });
  if (!filled) return std::nullopt;
  for (double& value : sum) value /= count;
  return sum;
}

template class MatterAt<2>;
template class MatterAt<3>;

}  // namespace ejecta
