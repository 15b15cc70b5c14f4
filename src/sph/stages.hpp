#pragma once
/// Which stages a scene needs, in order. To add physics: write the stage, name its fields, add one line here.
#include "sph/sph.hpp"

namespace ejecta {

template <int Dim>
std::vector<Stage<Dim>> choose_stages(const Scene& scene, const std::vector<Material>& materials);

/// Whether gradients are corrected: by default wherever there is more than gas.
bool corrects_gradients(const Scene& scene, const std::vector<Material>& materials);

/// Every field a stage list names, in catalogue order.
template <int Dim>
std::vector<Field> fields_of(const std::vector<Stage<Dim>>& stages);

// --- burn_stage.cpp --------------------------------------------------------------------------------------------------
/// Burnt fraction of explosives: by the time since the detonation has reached a particle, or by its compression.
template <int Dim>
void burn(Sph<Dim>& sph);

// --- material_stages.cpp ---------------------------------------------------------------------------------------------
/// Pressure and sound speed of every particle; with porosity the distension that goes with them.
template <int Dim>
void equation_of_state(Sph<Dim>& sph);
/// Brings the stress deviator back to the yield surface.
template <int Dim>
void strength(Sph<Dim>& sph);

/// Bonds end where matter has yielded, and where it is stretched or compressed out of all proportion.
template <int Dim>
void bonds(Sph<Dim>& sph);

// --- damage_stage.cpp ------------------------------------------------------------------------------------------------
/// Growth of cracks from the local strain, total damage, and what it leaves of tension. Tensor damage and the strain it
/// remembers are brought to the end of the step with the velocity gradient of the pair pass before. Driven bodies stay
/// whole.
template <int Dim>
void damage(Sph<Dim>& sph);

// --- smoothing_stages.cpp --------------------------------------------------------------------------------------------
/// Carries smoothing tensors along with the flow over the last step.
template <int Dim>
void carry_smoothing(Sph<Dim>& sph);
/// Smoothing lengths (the size of smoothing tensors) for the next step, from the number of neighbours.
template <int Dim>
void smoothing_lengths(Sph<Dim>& sph);
/// Those of a pilot density, which is summed over a kernel numerics.pilot_width times as wide: h = n_h (m/rho)^(1/Dim)
/// [Sigalotti et al. 2006, J. Comput. Phys. 212, 124; Puri & Ramachandran 2014, ibid. 256, 308]. Neighbours count by
/// number, as in the density itself, which is overwritten.
template <int Dim>
void pilot_lengths(Sph<Dim>& sph);

// --- driven_stage.cpp ------------------------------------------------------------------------------------------------
/// Takes the acceleration of driven bodies away; the force that does so, and its power, are noted in sph.external.
template <int Dim>
void driven_bodies(Sph<Dim>& sph);

// --- pair_stages.cpp -------------------------------------------------------------------------------------------------
/// Density by summation, with smoothing lengths that belong to it.
template <int Dim>
void summation_density(Sph<Dim>& sph);
/// Gradients of density, pressure and velocity, from which Godunov fluxes are reconstructed, and what corrects them.
template <int Dim>
void slopes(Sph<Dim>& sph);
/// Accelerations, rates of specific energy and velocity gradients.
template <int Dim>
void pair_rates(Sph<Dim>& sph);
/// Rates of density and stress from the velocity gradient.
template <int Dim>
void strain_rates(Sph<Dim>& sph);
/// Factors of the viscosity of the next step: where matter shears, and where no shock has come by.
template <int Dim>
void viscosity_switches(Sph<Dim>& sph);

// --- shape_stage.cpp -------------------------------------------------------------------------------------------------
/// Shapes of H by the votes of the neighbours, every numerics.shape_interval steps. At the start votes and sizes are
/// repeated until they settle.
template <int Dim>
StageWork<Dim> vote_shapes();

// --- peaks_stage.cpp -------------------------------------------------------------------------------------------------
/// What each particle has seen so far: highest pressure and energy, lowest density; and where it was at the start.
template <int Dim>
void peaks(Sph<Dim>& sph);

// --- neighbour_stage.cpp ---------------------------------------------------------------------------------------------
/// Renews the pair lists if somebody has left its margin, and the order of the particles if it has worn out.
template <int Dim>
StageWork<Dim> neighbours();
/// How far lists reach [h]: as far as the kernel, or that of the pilot density.
double list_reach(const Numerics& numerics);
/// Renews the pair lists alone, if need be: after smoothing lengths have changed within a step.
template <int Dim>
void renew_lists(Sph<Dim>& sph);

}  // namespace ejecta
