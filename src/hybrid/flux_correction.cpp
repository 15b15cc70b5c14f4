#include "hybrid/flux_correction.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace ejecta {

namespace {

/// Corrections below this share of what a cell holds are round-off: gas at rest stays as it is, bit for bit.
constexpr double round_off = 1e-14;
/// Of what there is, how much a correction may take at most from a cell beside the zone.
constexpr double most_taken = 0.5;
constexpr int most_shrinks = 8;

/// Gas with less than this share of the largest pressure times sound speed is quiet.
constexpr double quiet = 0.05;

/// s^2 within a solid.
constexpr double through_solids = 1e4;

struct Face {
  std::int32_t from, to;  ///< places among all cells concerned
  double weight;          ///< s^2
};

/// The numbers phi of the active cells, for what each is given [a column for each quantity].
Eigen::MatrixXd potentials(const std::vector<Face>& faces, const Eigen::MatrixXd& given) {
  const Eigen::Index n = given.rows();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  for (const Face& f : faces) {
    diagonal[f.from] += f.weight;
    if (f.to >= n) continue;
    diagonal[f.to] += f.weight;
    entries.emplace_back(std::max(f.from, f.to), std::min(f.from, f.to), -f.weight);
  }
  // A zone without a cell beside it could not give anything away: what it wants is then met as nearly as can be.
  for (Eigen::Index k = 0; k < n; ++k) entries.emplace_back(k, k, diagonal[k] * (1 + 1e-12));
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw SimulationError("hybrid: no fluxes lead the grid to what the particles say");
  return solver.solve(given);
}

}  // namespace

template <int Dim>
CellChanges<Dim> correct_by_fluxes(const Grid<Dim>& grid, const std::vector<std::size_t>& active,
                                   const std::vector<std::int32_t>& place, const std::vector<SolidShare<Dim>>& solids,
                                   const std::vector<std::array<double, Dim + 2>>& wanted) {
  constexpr std::size_t C = Dim + 2;
  const Box<Dim>& box = grid.box();
  CellChanges<Dim> changes;
  changes.cells = active;  // and those beside them, after these
  std::vector<std::int32_t> beside(box.size(), -1);
  std::vector<Face> faces;
  const auto strength = [&](std::size_t cell) {
    const CellState<Dim> s = grid.state(cell);
    return s.pressure * s.sound_speed;
  };
  for (std::size_t k = 0; k < active.size(); ++k) {
    const std::array<int, Dim> cell = box.cell(active[k]);
    for (std::size_t a = 0; a < Dim; ++a)
      for (const int side : {-1, 1}) {
        std::array<int, Dim> next = cell;
        next[a] += side;
        if (next[a] < 0 || next[a] >= box.cells[a]) {
          if (box.lower[a] != BoundaryKind::periodic) continue;  // faces of the box pass what the grid says
          next[a] = (next[a] + box.cells[a]) % box.cells[a];
        }
        const std::size_t j = box.index(next);
        std::int32_t other = place[j];
        if (other >= 0 && other <= static_cast<std::int32_t>(k)) continue;  // seen from there
        if (other < 0) {
          if (beside[j] < 0) {
            beside[j] = static_cast<std::int32_t>(changes.cells.size());
            changes.cells.push_back(j);
          }
          other = beside[j];
        }
        faces.push_back({static_cast<std::int32_t>(k), other, std::min(strength(active[k]), strength(j))});
      }
  }
  const std::size_t n = active.size(), all = changes.cells.size();
  changes.values.resize(all);
  for (std::size_t k = 0; k < all; ++k)
    for (std::size_t c = 0; c < C; ++c)
      changes.values[k][c] = grid.cells()[c][changes.cells[k]] - (k < n ? solids[k].taken[c] : 0);

  double largest = 0;
  for (const Face& f : faces) largest = std::max(largest, f.weight);
  for (Face& f : faces) {
    const double share = std::clamp(f.weight / (quiet * largest), 1e-12, 1.0);
    const auto in_solid = [&](std::int32_t cell) {
      return cell < static_cast<std::int32_t>(n) && solids[static_cast<std::size_t>(cell)].there;
    };
    f.weight = in_solid(f.from) || in_solid(f.to) ? through_solids : share * share;
  }
  Eigen::MatrixXd given(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(C));
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < C; ++c)
      given(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = changes.values[k][c] - wanted[k][c];
  const Eigen::MatrixXd phi = potentials(faces, given);
  std::vector<std::array<double, C>> flux(faces.size());  // times area and time, over the volume of a cell
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t c = 0; c < C; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      const double behind = faces[f].to < static_cast<std::int32_t>(n) ? phi(faces[f].to, column) : 0;
      flux[f][c] = faces[f].weight * (phi(faces[f].from, column) - behind);
    }
  // Momentum is measured by what a sound wave has.
  const auto measure = [&](std::size_t k) {
    const CellState<Dim> s = grid.state(changes.cells[k]);
    std::array<double, C> m;
    m.fill(s.density * (s.sound_speed + s.velocity.norm()));
    m[0] = s.density;
    m[C - 1] = s.density * (s.specific_energy + 0.5 * s.velocity.squaredNorm());
    return m;
  };
  std::vector<std::array<double, C>> measures(all);
  for (std::size_t k = 0; k < all; ++k) measures[k] = measure(k);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto &from = measures[static_cast<std::size_t>(faces[f].from)],
               &to = measures[static_cast<std::size_t>(faces[f].to)];
    for (std::size_t c = 0; c < C; ++c)
      if (std::abs(flux[f][c]) < round_off * std::max(from[c], to[c])) flux[f][c] = 0;
  }
  std::vector<double> share(all, 1);
  const std::vector<std::array<double, C>> before = changes.values;
  for (int shrinks = 0;; ++shrinks) {
    changes.values = before;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto from = static_cast<std::size_t>(faces[f].from), to = static_cast<std::size_t>(faces[f].to);
      const double part = std::min(share[from], share[to]);
      for (std::size_t c = 0; c < C; ++c) {
        changes.values[from][c] -= part * flux[f][c];
        changes.values[to][c] += part * flux[f][c];
      }
    }
    bool good = true;
    for (std::size_t k = 0; k < all; ++k) {
      const auto inner = [&](const std::array<double, C>& u) {
        double squares = 0;
        for (std::size_t a = 1; a <= Dim; ++a) squares += u[a] * u[a];
        return u[C - 1] - 0.5 * squares / u[0];
      };
      const auto &u = changes.values[k], &was = before[k];
      // Active cells follow their particles, whose states are possible ones, unless a neighbour's fluxes had to shrink.
      const double least = k < n ? 0 : 1 - most_taken;
      if (u[0] > least * was[0] && inner(u) > least * inner(was)) continue;
      good = false;
      share[k] = shrinks + 1 < most_shrinks ? 0.5 * share[k] : 0;
    }
    if (good) break;
    if (shrinks > 2 * most_shrinks)
      throw SimulationError("hybrid: what the particles say leaves a cell without density or energy");
  }
  return changes;
}

template CellChanges<2> correct_by_fluxes<2>(const Grid<2>&, const std::vector<std::size_t>&,
                                             const std::vector<std::int32_t>&, const std::vector<SolidShare<2>>&,
                                             const std::vector<std::array<double, 4>>&);
template CellChanges<3> correct_by_fluxes<3>(const Grid<3>&, const std::vector<std::size_t>&,
                                             const std::vector<std::int32_t>&, const std::vector<SolidShare<3>>&,
                                             const std::vector<std::array<double, 5>>&);

}  // namespace ejecta
