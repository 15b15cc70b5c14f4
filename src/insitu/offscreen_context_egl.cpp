#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "insitu/offscreen_context.hpp"

namespace ejecta {

struct OffscreenContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;  ///< small: VTK draws into buffers of its own, but asks this one for its depth
};

namespace {

/// A GPU where a driver offers one, else Mesa's software renderer without a surface.
EGLDisplay open_display() {
  const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!get_display) return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (query_devices) query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
  for (EGLint i = 0; i < count; ++i) {
    const EGLDisplay display = get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  const EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) ? display : EGL_NO_DISPLAY;
}

}  // namespace

OffscreenContext::OffscreenContext() : handles_(std::make_unique<Handles>()) {
  handles_->display = open_display();
  if (handles_->display == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API)) return;
  const std::array config_wish{EGL_RENDERABLE_TYPE,
                               EGL_OPENGL_BIT,
                               EGL_SURFACE_TYPE,
                               EGL_PBUFFER_BIT,
                               EGL_RED_SIZE,
                               8,
                               EGL_ALPHA_SIZE,
                               8,
                               EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(handles_->display, config_wish.data(), &config, 1, &count);
  const std::array wish{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  handles_->context = eglCreateContext(handles_->display, count ? config : nullptr, EGL_NO_CONTEXT, wish.data());
  const std::array small{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  if (count) handles_->surface = eglCreatePbufferSurface(handles_->display, config, small.data());
}

OffscreenContext::~OffscreenContext() {
  if (is_current()) release();
  if (handles_->surface != EGL_NO_SURFACE) eglDestroySurface(handles_->display, handles_->surface);
  if (is_valid()) eglDestroyContext(handles_->display, handles_->context);
}

bool OffscreenContext::is_valid() const { return handles_->context != EGL_NO_CONTEXT; }

void OffscreenContext::make_current() {
  eglMakeCurrent(handles_->display, handles_->surface, handles_->surface, handles_->context);
}

bool OffscreenContext::is_current() const { return is_valid() && eglGetCurrentContext() == handles_->context; }

void OffscreenContext::release() { eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

}  // namespace ejecta
