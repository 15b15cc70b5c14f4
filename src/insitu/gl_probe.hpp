#pragma once
/// Does rendering work here? Tried in a child process, because OpenGL libraries abort the program where it does not.

namespace ejecta {

/// Runs this executable again with the single argument `gl-probe`, for which it must call run_gl_probe(). False if the
/// child reports failure, dies or takes longer than 60 s.
bool gl_works();

/// The child's side: draws one small off-screen image and checks that something is on it. Returns the exit code, 0 if
/// it is.
int run_gl_probe();

}  // namespace ejecta
