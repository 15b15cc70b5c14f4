#pragma once
/// Flux axis of a scheme: what passes between two neighbours beside the stress of each. The pair loop takes it as a
/// policy, a struct `Flux` with
///   static constexpr bool whole               whether it stands for the stresses too (below)
///   static constexpr bool uneven              whether it heats one side more than the other
///   static constexpr bool closing_only        whether it is 0 where v.x >= 0: the loop leaves it out there
///   Flux::Record<Dim, Strained>               what it adds to the record of a particle (Strained: with the velocity
///                                             gradient of the evaluation before): `size` places from R::flux on,
///     Record(particles, scales)               filled in by
///     pack(i, places), mirror(places, axis)   for a particle, and for its image behind a face normal to an axis
///   Flux::Lanes<V, Dim, R, Strained>          the lanes i of a cluster against one partner j:
///     Lanes(load, settings)
///     jump(dx, along, j)                      what of v.x = `along` it acts on (Jump)
///     between(support, partner, closing, share)    what passes (PairFlux)
/// The loop adds p_ij to both stresses and -p_ij v_ji.g_ij/2 to the heat of either side, so that momentum and energy
/// are exact whatever the flux, as long as p_ij is the same number seen from i and from j.
///
/// A flux that is `whole` is all that passes, and the loop that it goes through is that of pair_fluxes.hpp. Of the
/// above it has `whole`, Record, the constructor of Lanes, and
///     across(partner, along)                  what passes (WholeFlux); `along` is v.x
/// The force on i is -p_ij a_ij; the loop takes the heat of either side from the work of that force.

namespace ejecta {

/// What a flux acts on. Between pieces in contact the loop puts other values here.
template <class V>
struct Jump {
  V closing;  ///< of v.x [m/s length_unit]
  V share;    ///< of the flux that acts, 0 to 1
};

template <class V>
struct PairFlux {
  V pressure;  ///< p_ij beyond both stresses, times `share` and r_i r_j, as those of the records are [Pa]
  V approach;  ///< signal: at most 0; what votes on the time step [m/s]
};
/// With `uneven`.
template <class V>
struct UnevenPairFlux : PairFlux<V> {
  V uneven;  ///< heat of i beyond that of j, as p_ij v_ji.g_ij; the negative, seen from j
};

template <class V, int Dim>
struct WholeFlux {
  V pressure;   ///< p_ij = 2 r_i r_j p*; the same number from either side [Pa]
  V face[Dim];  ///< a_ij = -a_ji: twice V0_i V0_j r_i r_j a_ij is the face through which p* acts
  V drift;      ///< (v* - (v_i + v_j)/2).a_ij; the same number from either side
  V approach;   ///< as above
};

}  // namespace ejecta
