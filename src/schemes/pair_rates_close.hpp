#pragma once
/// Rates of the particles of a cluster from the sums over their partners.
#include "schemes/pair_pass_impl.hpp"

namespace ejecta {

template <class T, int Dim, PassKind Kind, class K, class Flux>
template <bool Contacts, class ContactLanes>
void PairPassOf<T, Dim, Kind, K, Flux>::close(const RateColumns<Dim>& columns, const Cluster& c, const RateSums& sums,
                                              const V (&v)[Dim], const V (&stress)[R::stresses],
                                              [[maybe_unused]] const V (&shear)[R::stresses],
                                              [[maybe_unused]] const ContactLanes& contact) const {
  const double per_unit = 1 / settings_.length_unit, unit_volume = std::pow(settings_.length_unit, Dim);
  for (std::size_t i = c.begin; i < c.end; ++i) {
    const int k = static_cast<int>(i - c.begin);
    // V0/m of the record, not 1/rho0: both sides of a pair must use the same two volumes.
    const double specific_volume =
        static_cast<double>(records_[i * R::size + R::volume]) * unit_volume / columns.mass(0, i);
    for (int a = 0; a < Dim; ++a)
      columns.acceleration(a, i) = specific_volume * per_unit * sums.acceleration[a].lane(k);
    const double expanded = static_cast<double>(records_[i * R::size + R::expansion]);
    [[maybe_unused]] double work = 0;  // of the stress, sigma : L
    if constexpr (Kind.gradient) {
      const Mat<Dim> raw = sums.gradient.of_lane(k);
      work = pair_detail::double_contract<Kind.stress, Dim>(stress, k, raw);
      Mat<Dim> L = expanded * raw, of_contact = Mat<Dim>::Zero();
      if constexpr (Kind.stress) {
        const auto& around = around_.sums[i];
        L = around_.own(around).gradient(expanded * raw);
        if constexpr (Contacts)
          if (!around.contact.isZero(0)) {
            const Mat<Dim> others = sums.contact_gradient.of_lane(k);
            const Mat<Dim> all = around_.all(around).gradient(expanded * (raw + others));
            of_contact = contact_gradient<Dim>(L, all, around.normal(), contact.pressed(k)) - L;
            L += of_contact;
            work += pair_detail::double_contract<true, Dim>(contact.press, k, others);
          }
      }
      columns.velocity_gradient.set(i, Mat<Dim>(per_unit * L));
      if constexpr (Kind.cracked) {
        const Mat<Dim> cut = sums.cut.of_lane(k),
                       uncut = around_.uncut(i).gradient(expanded * (raw - cut)) + of_contact;
        columns.uncut_gradient.set(i, Mat<Dim>(per_unit * uncut));
        work -= pair_detail::double_contract<true, Dim>(shear, k, cut);
      }
    } else if constexpr (!R::split) {
      work = static_cast<double>(stress[0][k]) * static_cast<double>(sums.divergence[k]);
    }
    double pairs = sums.heat.lane(k);
    if constexpr (R::split)
      for (int a = 0; a < Dim; ++a) pairs -= static_cast<double>(v[a][k]) * sums.acceleration[a].lane(k);
    double heating = 0.5 * pairs + sums.friction_heat.lane(k);
    if constexpr (!R::split) heating += work;
    heating *= specific_volume * per_unit;
    if constexpr (R::split)  // the work above is that of rounded velocities, and the rest belongs to the particle alone
      for (int a = 0; a < Dim; ++a)
        heating -= columns.acceleration(a, i) * (columns.velocity(a, i) - static_cast<double>(v[a][k]));
    columns.specific_energy_rate(0, i) = heating;
    columns.zeroth_moment(0, i) = Support::moment_scale * static_cast<double>(sums.moment[k]);
    columns.largest_mu(0, i) = -static_cast<double>(sums.fastest[k]);
  }
}

}  // namespace ejecta
