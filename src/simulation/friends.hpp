#pragma once
/// Who is linked to whom: the search behind the fragments.
#include <cstdint>
#include <vector>

#include "simulation/fragments.hpp"

namespace ejecta {

/// For every particle the lowest index among those it is linked to, directly or through others; its own index where it
/// has no friends. Only `members` (ascending) have any. find_groups says when two are friends. Linear in n however far
/// the particles fly apart, because cells are hashed and come in sizes: one grid per octave of a particle's reach.
std::vector<std::uint32_t> join_friends(const FragmentInput& in, const std::vector<std::uint32_t>& members,
                                        const FragmentSettings& settings);

}  // namespace ejecta
