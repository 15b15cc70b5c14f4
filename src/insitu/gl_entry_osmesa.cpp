/// Linked, with gl_entry.cpp, into every executable that renders by OSMesa.
#include <GL/osmesa.h>

/// GLEW asks GLX for the address of each OpenGL function; OSMesa brings functions of its own.
extern "C" OSMESAproc glXGetProcAddressARB(const unsigned char* name) {
  return OSMesaGetProcAddress(reinterpret_cast<const char*>(name));
}
