#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "sph/particle_state.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Magnitude of the curl [1/s].
template <int Dim>
double curl(const Mat<Dim>& L) {
  if constexpr (Dim == 2) return std::abs(L(1, 0) - L(0, 1));
  if constexpr (Dim == 3) return Vec<3>(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1)).norm();
}

/// Continuity drifts where neighbours change places, as in vapour and torn matter: a particle may become a thousand
/// times thinner than what its neighbours leave it, and the stress of the next one throws it away. Its density is held
/// within these shares of mass over spacing, known from the zeroth moment; intact matter stays well within. Only a
/// particle that has not had to widen its support has all its neighbours, and may be too dense.
constexpr double least_density_share = 0.6, most_density_share = 1.7;
constexpr double least_filling = 0.85, widest_support = 1.25;

/// Factor of the bounds: particles of a coarse body count the finer neighbours of another as their own.
double density_share(const Scene& scene, int dim) {
  double finest = std::numeric_limits<double>::infinity(), coarsest = 0;
  for (const Body& body : scene.bodies) {
    finest = std::min(finest, body.spacing_factor);
    coarsest = std::max(coarsest, body.spacing_factor);
  }
  return std::pow(finest / coarsest, dim);
}

/// Brings the density of particle i within its bounds; `share` accounts for bodies of different spacing.
template <int Dim>
void hold_density(Sph<Dim>& sph, const Material& material, double share, std::size_t i) {
  Particles<Dim>& p = sph.particles;
  const double sum = p.column(Field::zeroth_moment)[i], h = p.column(Field::smoothing_length)[i];
  if (!(sum > 0)) return;
  const double nodes = sph.support->effective_nodes_per_h(sum), per_spacing = nodes / h;
  const double by_spacing =
      p.column(Field::mass)[i] * (Dim == 2 ? per_spacing * per_spacing : per_spacing * per_spacing * per_spacing);
  const double least = least_density_share * share * by_spacing, most = most_density_share / share * by_spacing;
  double& density = p.column(Field::density)[i];
  const double target = sph.scene.numerics.nodes_per_h;
  if (material.gas()) {
    density = std::max(density, least);
    if (nodes > least_filling * target) density = std::min(density, most);
    return;
  }
  // Cold condensed matter stores energy on either side of its own density, about (c s)^2/2 at a compression of 1 + s:
  // nothing is brought further from that density than its own heat would do.
  const double whole = material.bulk_density();
  const double reach =
      1 + std::sqrt(2 * std::max(0.0, p.column(Field::specific_energy)[i])) / p.column(Field::sound_speed)[i];
  // Pores that are crushed beside it crowd the neighbours of a particle: what is not thin is let alone, or it would do
  // work again and again for which nobody has paid.
  density = std::max(density, std::min(least, whole * std::max(1.0, reach - 1)));
  const Body& body = sph.scene.bodies[static_cast<std::size_t>(p.label(Label::body)[i])];
  const double h0 = target * sph.scene.spacing * body.spacing_factor;
  // Whatever has compressed condensed matter, quasi-statically or by a shock, has left it the energy for that: what is
  // within its reach is not too dense, however few neighbours a surface has. Only vapour, which its heat would carry
  // anywhere, is held below its own density too.
  const double own = reach < 2 ? whole * reach : whole / reach;
  // A front that crushes pores brings planes of particles four times nearer along one axis alone: mass over spacing
  // means little there.
  if (!material.porosity && nodes > least_filling * target && h < widest_support * h0)
    density = std::min(density, std::max(most, own));
}

/// A volume by number smears a contact between particles of different sizes, as each takes all its neighbours for its
/// own kind. What the volumes fill together, each spread with its own kernel, tells, and moves them [c/h]. Not all the
/// way: only as far as volumes follow the number do equal pressures keep particles in order. Sod's contact is 0.54 and
/// 0.21 % off (L2) at 128 and 800 particles; with a restoring rate of 0.3 0.71 and 0.27 %, by number 1.32 and 0.56 %.
constexpr double filling_rate = 1, restoring_rate = 0.2;
/// A contact is where pressures are alike within h, h |grad P|/P, and entropies are not, h |grad rho/rho - grad P/(rho
/// c^2)|. In a shock densities would overshoot by a tenth; elsewhere volumes would pick up every disorder.
constexpr double alike_pressure = 0.25, other_entropy = 0.1;
/// Contacts need 0.1; a free surface, where less is filled for good, would go on.
constexpr double most_excess = 0.2, least_filled = 0.5;

/// How much of a contact a particle sees, from 0 to 1.
template <int Dim>
double contact_share(const Particles<Dim>& p, std::size_t i) {
  const double h = p.column(Field::smoothing_length)[i], pressure = p.column(Field::pressure)[i],
               density = p.column(Field::density)[i], c = p.column(Field::sound_speed)[i];
  if (!(pressure > 0) || !(c > 0)) return 0;
  const Vec<Dim> of_pressure = p.vector(Field::pressure_gradient, i), of_density = p.vector(Field::density_gradient, i);
  const double steep = h * of_pressure.norm() / (pressure * alike_pressure),
               other = h * (of_density / density - of_pressure / (density * c * c)).norm() / other_entropy;
  return (1 - 1 / (1 + other * other)) / (1 + steep * steep);
}

template <int Dim>
void fill_space(Particles<Dim>& p, double dt) {
  parallel_for(0, p.size(), [&](std::size_t i) {
    double& excess = p.column(Field::volume_excess)[i];
    const double filled = std::log(std::clamp(p.column(Field::filling)[i], least_filled, 1 / least_filled));
    const double crossings = std::min(1.0, dt * p.column(Field::sound_speed)[i] / p.column(Field::smoothing_length)[i]);
    excess -= crossings * (filling_rate * contact_share(p, i) * filled + restoring_rate * excess);
    excess = std::clamp(excess, -most_excess, most_excess);
    p.column(Field::density)[i] *= std::exp(-excess);
  });
}

}  // namespace

template <int Dim>
void summation_density(Sph<Dim>& sph) {
  // At the start the smoothing lengths are iterated to their fixed point; later one update a step keeps them there.
  const int iterations = sph.clock.step == 0 ? 8 : 1;
  const bool pilot = is_set(sph.scene.numerics.pilot_width);
  for (int k = 0; k < iterations; ++k) {
    if (pilot) {
      pilot_lengths(sph);
    } else {
      sph.pass->density(sph.particles, sph.lists);
      smoothing_lengths(sph);
    }
    renew_lists(sph);  // h may have outgrown the margin of the lists, and a missed pair has a force on one side only
  }
  if (pilot || sph.clock.step == 0) sph.pass->density(sph.particles, sph.lists);
  if (sph.particles.has(Field::volume_excess)) fill_space(sph.particles, sph.clock.step == 0 ? 0 : sph.clock.dt);
}

template <int Dim>
void slopes(Sph<Dim>& sph) {
  sph.pass->slopes(sph.particles, sph.lists);
}

template <int Dim>
void pair_rates(Sph<Dim>& sph) {
  sph.pass->rates(sph.particles, sph.lists);
}

template <int Dim>
void strain_rates(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const bool continuity = p.has(Field::compression_rate), variable_shear = p.has(Field::shear_modulus);
  const double share = density_share(sph.scene, Dim);
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Material& material = sph.materials[m];
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      const Mat<Dim> L = p.tensor(Field::velocity_gradient, i);
      const double compression = -L.trace();  // (1/rho) drho/dt
      if (continuity) {
        p.column(Field::compression_rate)[i] = compression;
        hold_density(sph, material, share, i);
      }
      if (!material.solid()) return;
      double shear = variable_shear ? p.column(Field::shear_modulus)[i] : material.elastic->shear_modulus;
      const Deviator<Dim> s = deviator<Dim>(p, i);
      const Mat<Dim> straining = straining_gradient(p, material, i);
      double distension_rate = 0;
      if (material.porosity) {
        // S = S_s/alpha, and the solid sees the share f of the strain rate, with f = 1 + (rho/alpha) d(alpha)/d(rho):
        // dS/dt = f 2G e'/alpha + (W S - S W) - S (d(alpha)/dt)/alpha   [Jutzi, Benz & Michel 2008, eqs 29-31]
        // What f leaves out crushes pores, which takes work: shear that gives work back unloads the solid in full, or
        // the stress would give more than was put in.
        const double f = p.column(Field::stress_factor)[i];
        const bool loads = full_tensor<Dim>(s).template topLeftCorner<Dim, Dim>().cwiseProduct(straining).sum() >= 0;
        shear *= (loads ? f : 1) / p.column(Field::distension)[i];
        distension_rate = std::min(0.0, (f - 1) * compression);  // (1/alpha) d(alpha)/dt
      }
      const Deviator<Dim> rate = stress_rate<Dim>(straining, s, shear) - distension_rate * s;
      for (int k = 0; k < deviator_size<Dim>; ++k) p.column(Field::stress_rate, k)[i] = rate[k];
    });
  }
}

template <int Dim>
void viscosity_switches(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const bool shear = p.has(Field::viscosity_factor), shocks = p.has(Field::shock_switch);
  // A shock of compression rho2/rho1 brings the switch to 1 - (rho1/rho2)^rise: to 0.9 for 12 %, where the published 1
  // would leave shocks in rock at 0.1. It fades in five sound crossings of h.
  constexpr double rise = 20, decay = 0.2;
  parallel_for(0, p.size(), [&](std::size_t i) {
    const Mat<Dim> L = p.tensor(Field::velocity_gradient, i);
    const double divergence = L.trace(),
                 crossing = p.column(Field::sound_speed)[i] / p.column(Field::smoothing_length)[i];
    if (shear)  // Balsara (1995): |div v| / (|div v| + |curl v| + 1e-4 c/h)
      p.column(Field::viscosity_factor)[i] =
          std::abs(divergence) / (std::abs(divergence) + curl<Dim>(L) + 1e-4 * crossing);
    if (shocks) {  // Morris & Monaghan (1997), with the source of Rosswog et al. (2000)
      double& a = p.column(Field::shock_switch)[i];
      const double dt = sph.clock.dt, source = rise * std::max(0.0, -divergence);
      a = (a + dt * source) / (1 + dt * (decay * crossing + source));
    }
  });
}

template void summation_density<2>(Sph<2>&);
template void summation_density<3>(Sph<3>&);
template void slopes<2>(Sph<2>&);
template void slopes<3>(Sph<3>&);
template void pair_rates<2>(Sph<2>&);
template void pair_rates<3>(Sph<3>&);
template void strain_rates<2>(Sph<2>&);
template void strain_rates<3>(Sph<3>&);
template void viscosity_switches<2>(Sph<2>&);
template void viscosity_switches<3>(Sph<3>&);

}  // namespace ejecta
