#pragma once
/// Who is linked to whom: the search behind the fragments.
#include <cstdint>
#include <vector>

#include "analysis/fragments.hpp"

namespace ejecta {

struct Friends {
  /// The lowest index among those a particle is linked to, directly or through others; its own where it has no friends.
  std::vector<std::uint32_t> root;
  std::vector<BoxShift> shift;  ///< as in Groups
};
/// Only `members` (ascending) have friends. find_groups says when two are friends. Linear in n however far the
/// particles fly apart, because cells are hashed and come in sizes: one grid per octave of a particle's reach.
Friends join_friends(const FragmentInput& in, const std::vector<std::uint32_t>& members,
                     const FragmentSettings& settings);

}  // namespace ejecta
