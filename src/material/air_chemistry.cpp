#include "material/air_chemistry.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace ejecta {

namespace {

// CODATA 2018, SI.
constexpr double boltzmann = 1.380649e-23, planck = 6.62607015e-34, dalton = 1.66053906660e-27;
constexpr double electron_mass = 9.1093837015e-31;
constexpr double kelvin_per_eV = 11604.51812, kelvin_per_wavenumber = 1.438776877;  // h c/k [K cm]

/// A term of an atom or ion.
struct Term {
  double weight, wavenumber;  // 1/cm
};

/// An atom or ion: its terms of the shell n = 2 (fine structure averaged) and what it takes to remove one electron.
struct Ion {
  std::vector<Term> terms;
  double ionisation_energy = 0;  // eV
};

/// An element, from the neutral atom to the bare nucleus.
struct Element {
  double mass;  // of the atom [u]
  std::vector<Ion> ions;
};

/// An electronic state of a molecule: weight, T_e, omega_e, B_e [1/cm].
struct MolecularState {
  double weight, wavenumber, vibration, rotation;
};

struct Molecule {
  double mass;                 // u
  double symmetry;             // rotations that look the same
  double dissociation_energy;  // from the lowest level to neutral atoms [eV]
  std::vector<MolecularState> states;
};

// Levels and ionisation energies: NIST Atomic Spectra Database (2023), DOI 10.18434/T4W30F.
const Element nitrogen{
    14.007,
    {{{{4, 0}, {10, 19228}, {6, 28839}, {12, 88132}}, 14.53413},
     {{{9, 89},
       {5, 15316},
       {1, 32689},
       {5, 46785},
       {15, 92244},
       {9, 109218},
       {5, 144188},
       {3, 155127},
       {3, 166766},
       {9, 220296}},
      29.60125},
     {{{6, 116}, {12, 57277}, {10, 101027}, {2, 131004}, {6, 145949}, {4, 186797}, {10, 203080}, {6, 230407}}, 47.4453},
     {{{1, 0}, {9, 67345}, {3, 130694}, {9, 175669}, {5, 188882}, {1, 235369}}, 77.4735},
     {{{2, 0}, {6, 80636}}, 97.8901},
     {{{1, 0}}, 552.06733},
     {{{2, 0}}, 667.0461377},
     {{{1, 0}}, 0}}};
const Element oxygen{
    15.999,
    {{{{9, 78}, {5, 15868}, {1, 33793}}, 13.618055},
     {{{4, 0}, {10, 26819}, {6, 40469}, {12, 119933}, {10, 165992}, {2, 195710}, {6, 212650}}, 35.12112},
     {{{9, 208},
       {5, 20273},
       {1, 43186},
       {5, 60325},
       {15, 120041},
       {9, 142383},
       {5, 187054},
       {3, 197088},
       {3, 210462},
       {9, 283867},
       {5, 298294},
       {1, 343306}},
      54.93554},
     {{{6, 257}, {12, 71641}, {10, 126942}, {2, 164366}, {6, 180643}, {4, 231538}, {10, 255168}, {6, 289021}}, 77.4135},
     {{{1, 0}, {9, 82234}, {3, 158798}, {9, 213750}, {5, 231721}, {1, 287910}}, 113.899},
     {{{2, 0}, {6, 96730}}, 138.1189},
     {{{1, 0}}, 739.32683},
     {{{2, 0}}, 871.4099138},
     {{{1, 0}}, 0}}};

// States: Huber & Herzberg 1979, Constants of Diatomic Molecules (NIST Chemistry WebBook). Dissociation energies:
// heats of formation at 0 K of McBride, Zehe & Gordon 2002, NASA/TP-2002-211556.
const Molecule molecular_nitrogen{28.014,
                                  2,
                                  9.7594,
                                  {{1, 0, 2358.57, 1.998},
                                   {3, 50204, 1460.9, 1.454},
                                   {6, 59619, 1734.0, 1.638},
                                   {6, 59808, 1501.4, 1.47},
                                   {3, 66273, 1516.9, 1.473},
                                   {1, 68153, 1530.3, 1.480},
                                   {2, 69283, 1694.2, 1.617},
                                   {2, 72097, 1559.3, 1.498}}};
const Molecule molecular_oxygen{31.998,
                                2,
                                5.1156,
                                {{3, 0, 1580.19, 1.4456},
                                 {2, 7918, 1509.8, 1.426},
                                 {1, 13195, 1432.8, 1.400},
                                 {1, 33057, 794.3, 0.916},
                                 {6, 34690, 850.0, 0.96},
                                 {3, 35397, 798.7, 0.911}}};
const Molecule nitric_oxide{
    30.006, 1, 6.4968, {{4, 61, 1904.14, 1.695}, {8, 38440, 1017.0, 1.0}, {2, 43966, 2374.3, 1.997}}};

constexpr double share_of_nitrogen = 0.79;  // of the molecules of cold air; argon is counted with it

/// A partition function without translation, and the energy per particle in it over k [K].
struct Partition {
  double sum = 0, energy = 0;
};

Partition partition(const std::vector<Term>& terms, double temperature) {
  Partition p;
  for (const Term& term : terms) {
    const double energy = kelvin_per_wavenumber * term.wavenumber;
    const double population = term.weight * std::exp(-energy / temperature);
    p.sum += population;
    p.energy += population * energy;
  }
  p.energy /= p.sum;
  return p;
}

Partition partition(const Molecule& molecule, double temperature) {
  Partition p;
  for (const MolecularState& state : molecule.states) {
    const double zero_point = (state.vibration - molecule.states.front().vibration) / 2;
    const double electronic = kelvin_per_wavenumber * (state.wavenumber + zero_point);
    const double quantum = kelvin_per_wavenumber * state.vibration, x = quantum / temperature;
    const double rotations = temperature / (molecule.symmetry * kelvin_per_wavenumber * state.rotation);
    const double population = state.weight * rotations * std::exp(-electronic / temperature) / -std::expm1(-x);
    p.sum += population;
    p.energy += population * (electronic + temperature + quantum / std::expm1(x));
  }
  p.energy /= p.sum;
  return p;
}

/// States per volume of the translation of a particle [1/m^3]: (2 pi m k T/h^2)^(3/2).
double translation(double mass, double temperature) {
  return std::pow(2 * std::numbers::pi * mass * boltzmann * temperature / (planck * planck), 1.5);
}

/// The particles that the nuclei of one element make, per neutral atom.
struct Particles {
  double number = 0, charge = 0, energy = 0;  // energy over k, above neutral atoms in the ground state [K]
};

/// The ions of an element at one temperature. Saha: n(z+1) n_e/n(z) = factor(z).
class Ladder {
 public:
  Ladder(const Element& element, double temperature) {
    const double electrons = 2 * translation(electron_mass, temperature);
    double removed = 0;
    Partition below;
    for (std::size_t z = 0; z < element.ions.size(); ++z) {
      const Partition here = partition(element.ions[z].terms, temperature);
      if (z == 0) {
        atoms_ = translation(element.mass * dalton, temperature) * here.sum;
      } else {
        const double energy = kelvin_per_eV * element.ions[z - 1].ionisation_energy;
        factors_.push_back(electrons * here.sum / below.sum * std::exp(-energy / temperature));
        removed += energy;
      }
      energies_.push_back(removed + here.energy);
      below = here;
    }
  }

  /// States per volume of the neutral atom [1/m^3].
  double atoms() const { return atoms_; }

  /// At an electron density [1/m^3].
  Particles particles(double electron_density) const {
    Particles p{1, 0, energies_[0]};
    double population = 1;
    for (std::size_t z = 0; z < factors_.size(); ++z) {
      population *= factors_[z] / electron_density;
      p.number += population;
      p.charge += static_cast<double>(z + 1) * population;
      p.energy += population * energies_[z + 1];
    }
    return p;
  }

 private:
  double atoms_ = 0;
  std::vector<double> factors_, energies_;
};

/// A molecule at one temperature: its density over those of its neutral atoms, and its energy over k above them [K].
struct Bond {
  double constant, energy;

  Bond(const Molecule& molecule, double atoms, double more_atoms, double temperature) {
    const Partition p = partition(molecule, temperature);
    const double depth = kelvin_per_eV * molecule.dissociation_energy;
    const double states = translation(molecule.mass * dalton, temperature) * p.sum;
    constant = states / atoms / more_atoms * std::exp(depth / temperature);
    energy = p.energy - depth;
  }
};

/// Air below the temperature at which anything dissociates.
AirState cold_air(double molecules, double mass_density, double temperature) {
  const double n = partition(molecular_nitrogen, temperature).energy,
               o = partition(molecular_oxygen, temperature).energy;
  const double energy = 1.5 * temperature + share_of_nitrogen * n + (1 - share_of_nitrogen) * o;
  return {molecules * boltzmann * temperature, molecules * boltzmann * energy / mass_density};
}

}  // namespace

AirState air_in_equilibrium(double rho, double temperature) {
  const double molecules =
      rho / (dalton * (share_of_nitrogen * molecular_nitrogen.mass + (1 - share_of_nitrogen) * molecular_oxygen.mass));
  // At 600 K 1e-8 of the molecules are not N2 or O2; further down the exponentials leave the numbers of the machine.
  if (temperature < 600) return cold_air(molecules, rho, temperature);

  const double nitrogen_nuclei = 2 * share_of_nitrogen * molecules;
  const double oxygen_nuclei = 2 * (1 - share_of_nitrogen) * molecules;
  const Ladder n(nitrogen, temperature), o(oxygen, temperature);
  const Bond nn(molecular_nitrogen, n.atoms(), n.atoms(), temperature);
  const Bond oo(molecular_oxygen, o.atoms(), o.atoms(), temperature);
  const Bond no(nitric_oxide, n.atoms(), o.atoms(), temperature);

  // Densities of neutral atoms from the conservation of nuclei, in turn until they agree: each is the positive root of
  // 2 K a^2 + (S + K_NO b) a = nuclei, K of the molecule of two equal atoms, S all ions of the element per neutral
  // atom.
  double a = 0, b = 0;
  Particles of_n, of_o;
  const auto neutral = [](double bond, double linear, double nuclei) {
    return 2 * nuclei / (linear + std::sqrt(linear * linear + 8 * bond * nuclei));
  };
  const auto compose = [&](double electron_density) {
    of_n = n.particles(electron_density);
    of_o = o.particles(electron_density);
    b = neutral(oo.constant, of_o.number, oxygen_nuclei);
    for (int k = 0; k < 200; ++k) {
      const double before = b;
      a = neutral(nn.constant, of_n.number + no.constant * b, nitrogen_nuclei);
      b = neutral(oo.constant, of_o.number + no.constant * a, oxygen_nuclei);
      if (std::abs(b - before) <= 1e-13 * b) break;
    }
    return a * of_n.charge + b * of_o.charge;
  };

  // Electrons as many as charges. Fewer electrons leave more charges, so that there is one root.
  const auto excess = [&](double log_electrons) { return std::log(compose(std::exp(log_electrons))) - log_electrons; };
  double high = std::log(16 * molecules), low = high - 10;
  while (excess(low) < 0) {
    high = low;
    low -= 10;
  }
  std::uintmax_t steps = 200;
  const auto root =
      boost::math::tools::toms748_solve(excess, low, high, boost::math::tools::eps_tolerance<double>(50), steps);
  const double electrons = std::exp((root.first + root.second) / 2);
  compose(electrons);

  const double n2 = nn.constant * a * a, o2 = oo.constant * b * b, n_o = no.constant * a * b;
  const double particles = a * of_n.number + b * of_o.number + n2 + o2 + n_o + electrons;
  const double energy = 1.5 * temperature * particles + a * of_n.energy + b * of_o.energy + n2 * nn.energy +
                        o2 * oo.energy + n_o * no.energy +
                        kelvin_per_eV / 2 *
                            (nitrogen_nuclei * molecular_nitrogen.dissociation_energy +
                             oxygen_nuclei * molecular_oxygen.dissociation_energy);
  return {particles * boltzmann * temperature, boltzmann * energy / rho};
}

}  // namespace ejecta
