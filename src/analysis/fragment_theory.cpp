#include "analysis/fragment_theory.hpp"

#include <algorithm>
#include <cmath>

namespace ejecta {

double mott_spacing(double flow_stress, double gamma, double density, double strain_rate) {
  return std::sqrt(2 * flow_stress / (density * gamma)) / strain_rate;
}

double grady_spacing(double fracture_energy, double density, double strain_rate) {
  return std::cbrt(24 * fracture_energy / (density * strain_rate * strain_rate));
}

double pieces_at_least(double mass, double mean, double whole, int cuts) {
  return whole / mean * std::exp(-std::pow(std::tgamma(cuts + 1) * mass / mean, 1.0 / cuts));
}

PieceRange pieces_at_least(double mass, const FragmentPrediction& prediction, double whole, int dimension) {
  const int cuts = dimension - 1;
  const auto with = [&](double mean) { return pieces_at_least(mass, mean, whole, cuts); };
  const auto [fewest, most] = std::minmax({with(prediction.lightest), with(prediction.heaviest)});
  // As a function of the mean N(m) has one maximum, where (d! m/mean)^(1/d) = d.
  const double best = std::tgamma(cuts + 1) * mass / std::pow(cuts, cuts);
  return {fewest, std::max(most, with(std::clamp(best, prediction.lightest, prediction.heaviest)))};
}

std::vector<FragmentPrediction> predict_fragments(const FragmentTheory& theory, double density, int dimension) {
  const auto mass = [&](double spacing) { return density * theory.thickness * std::pow(spacing, dimension - 1); };
  std::vector<FragmentPrediction> list;
  if (!theory.flow_stress.empty()) {
    const auto spacing = [&](double stress, double gamma) {
      return mott_spacing(stress, gamma, density, theory.strain_rate);
    };
    list.push_back({"Mott", mass(spacing(theory.flow_stress.front(), theory.mott_gamma.back())),
                    mass(spacing(theory.flow_stress.back(), theory.mott_gamma.front()))});
  }
  if (!theory.fracture_energy.empty()) {
    const auto spacing = [&](double energy) { return grady_spacing(energy, density, theory.strain_rate); };
    list.push_back({"Grady and Kipp", mass(spacing(theory.fracture_energy.front())),
                    mass(spacing(theory.fracture_energy.back()))});
  }
  return list;
}

}  // namespace ejecta
