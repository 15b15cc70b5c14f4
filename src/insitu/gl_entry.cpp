/// Linked into every executable that renders without a display, so that VTK's libraries find this definition first.
#include <dlfcn.h>

/// GLEW loads every OpenGL function and then reports that there is no GLX display (its error 4). VTK takes any error
/// for the end of the world; without a display this one is expected.
extern "C" unsigned int glewInit() {
  constexpr unsigned int no_error = 0, no_glx_display = 4;
  using Init = unsigned int (*)();
  const auto next = reinterpret_cast<Init>(dlsym(RTLD_NEXT, "glewInit"));
  if (!next) return 1;
  const unsigned int error = next();
  return error == no_glx_display ? no_error : error;
}
