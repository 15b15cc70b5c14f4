#pragma once
/// The two directions of an Archive. What the package "particles" persists stands at the top of a checkpoint, names of
/// other packages begin with theirs and a dot: "grid.pressure".
#include "model/archive.hpp"
#include "model/package.hpp"
#include "output/checkpoint.hpp"

namespace ejecta {

/// Adds views of all that a package persists to a checkpoint that is to be written. They are valid while the package is
/// untouched.
void save(Package& package, CheckpointView& view);

/// Puts a freshly set-up package of the same scene into the state of the checkpoint. Throws InputError, naming the file,
/// if it does not hold that.
void load(Package& package, const Checkpoint& checkpoint);

}  // namespace ejecta
