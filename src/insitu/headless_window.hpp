#pragma once
/// VTK windows without a display. Debian's VTK knows X windows only, and those abort the program where there is none.

namespace ejecta {

/// From now on every vtkRenderWindow this process makes draws off screen through an OffscreenContext. May be called
/// more than once. Does nothing in a build for an X display (EJECTA_GL=x11).
void use_headless_window();

}  // namespace ejecta
