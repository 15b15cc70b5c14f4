#pragma once
/// Into how many pieces a stretching wall breaks, and how their masses spread: what runs are drawn beside.
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace ejecta {

/// Mott's distance between cracks [m]: how far the release from a crack runs before the strains at which matter breaks
/// are used up, x0 = (2 Y/(rho gamma))^(1/2) / strain rate. Mott, N. F. 1947, Proc. R. Soc. A 189, 300 (recalled).
/// `flow_stress` Y [Pa], `gamma` [1], `density` [kg/m^3], `strain_rate` [1/s].
double mott_spacing(double flow_stress, double gamma, double density, double strain_rate);

/// Grady's size of a piece [m], whose kinetic energy about its own centre is that of its new cracks:
/// s = (24 Gamma/(rho rate^2))^(1/3). Grady, D. E. 1982, J. Appl. Phys. 53, 322; Grady, D. E. & Kipp, M. E. 1985, ibid.
/// 58, 1210. `fracture_energy` Gamma [J/m^2], of a crack, not of each of its faces.
double grady_spacing(double fracture_energy, double density, double strain_rate);

/// How many pieces of at least a mass m there are, if cracks lie at random: N(m) = (M/mean) exp(-(d! m/mean)^(1/d)),
/// with d = 1 for a ring, cut across (Lineau 1936, J. Franklin Inst. 221, 485), and d = 2 for a shell, cut both ways
/// (Mott & Linfoot 1943, whose mu is mean/2; both recalled). All masses in one unit.
double pieces_at_least(double mass, double mean, double whole, int cuts);

/// What one theory says of a body: between two mean masses of its pieces.
struct FragmentPrediction {
  std::string who;            ///< "Mott"
  double lightest, heaviest;  ///< mean mass of a piece [kg; kg/m in plane strain]
};
/// Least and most pieces of at least a mass m, whatever the mean between those of a prediction.
struct PieceRange {
  double fewest, most;
};
PieceRange pieces_at_least(double mass, const FragmentPrediction& prediction, double whole, int dimension);

/// Predictions for a wall of this density [kg/m^3]: cut across in plane strain, both ways in space, where a piece is as
/// wide as it is long. Empty where the scene asks for none.
std::vector<FragmentPrediction> predict_fragments(const FragmentTheory& theory, double density, int dimension);

}  // namespace ejecta
