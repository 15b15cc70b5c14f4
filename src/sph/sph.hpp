#pragma once
/// The particle solver: smoothed particle hydrodynamics with lengths (SPH) or tensors (ASPH) of smoothing.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "material/material.hpp"
#include "model/package.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/support_size.hpp"
#include "sph/outset.hpp"

namespace ejecta {

template <int Dim>
struct Sph;

/// What a stage does. What it keeps for itself lives in here.
template <int Dim>
struct StageWork {
  std::function<void(Sph<Dim>&)> run;
  std::function<std::size_t()> bytes = [] { return std::size_t{0}; };  ///< of what it keeps
};

/// One line of the algorithm: what it reads, what it writes, what it does. A stage is in the list only if the scene
/// asks for it, and a column exists only if a stage names it.
template <int Dim>
struct Stage : StageWork<Dim> {
  std::string name;
  std::vector<Field> reads, writes;
};

/// Something that bounds the time step.
template <int Dim>
struct Criterion {
  std::string_view name;
  std::function<Vote(const Sph<Dim>&)> vote;  ///< the culprit is a particle's index
};

/// How often a particle voted on the shape of its H during a run, and how often a limit acted on the result.
struct ShapeReport {
  std::int64_t votes = 0;           ///< particles times votes
  std::int64_t few_neighbours = 0;  ///< kept the shape that moved with the flow
  std::int64_t limited_change = 0;  ///< moved only part of the way
  std::int64_t largest_aspect = 0;  ///< held at numerics.largest_aspect
  ShapeReport& operator+=(const ShapeReport& o) {
    votes += o.votes;
    few_neighbours += o.few_neighbours;
    limited_change += o.limited_change;
    largest_aspect += o.largest_aspect;
    return *this;
  }
};

template <int Dim>
struct Sph final : Package {
  std::string_view name() const override { return title; }
  Vote vote() override;
  void advance(double dt) override;
  void check_health() const override;
  Totals conserved() const override;
  Kept kept() const override;
  bool is_loaded() const override;
  void persist(Archive& archive) override;
  Quantities quantities() const override;
  std::string outline() const override;
  std::vector<Remark> remarks() const override;
  std::vector<Remark> remarks_at_start() const override;
  std::string describe(std::size_t particle) const override;
  Whereabouts whereabouts(std::size_t particle) const override;
  std::optional<BlastFront> blast() const override;
  std::string_view element() const override { return "particle"; }
  std::size_t elements() const override { return particles.size(); }
  std::size_t bytes() const override;

  /// Runs all stages on the present (predicted) state.
  void evaluate();

  std::string title = "particles";  ///< "gas" in a hybrid, where they are not all the particles there are, nor for long
  Scene scene;
  std::vector<Material> materials;  ///< by material number (Label::material)
  std::vector<int> body_material;   ///< material number of each body
  Particles<Dim> particles;
  std::vector<Stage<Dim>> stages;
  std::vector<Criterion<Dim>> criteria;
  PairLists<Dim> lists;
  std::unique_ptr<PairPass<Dim>> pass;
  std::unique_ptr<SupportSize> support;
  ShapeReport shape_report;
  double lists_built_at = 0;  ///< s
  std::int64_t list_builds = 0, sorts = 0;
  std::int64_t unconverged = 0;  ///< particle-steps in which the distension solver failed (plain Newton may)
  Outset outset;                 ///< of a fresh set-up; a restart makes it again
};

/// Sets a scene up: bodies filled, columns allocated, flaws drawn, stages chosen and evaluated once at t = 0.
/// Throws InputError if two bodies overlap or a body holds no particle, SimulationError if the first evaluation fails.
template <int Dim>
std::unique_ptr<Sph<Dim>> set_up(const Scene& scene, const std::vector<Material>& materials);

/// Highest pressure of particles that have neighbours of their own piece [Pa]: nothing relieves those that fly alone,
/// which keep what they had. Of all if there are no others.
template <int Dim>
double highest_pressure(const Sph<Dim>& sph);

/// Mean number of neighbours within the support, from the effective n_h of each particle.
template <int Dim>
double mean_neighbours(const Sph<Dim>& sph);

}  // namespace ejecta
