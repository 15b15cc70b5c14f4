#include <GL/osmesa.h>

#include <array>

#include "insitu/offscreen_context.hpp"

namespace ejecta {

/// VTK draws into frame buffer objects of its own, so the context's buffer only has to exist.
struct OffscreenContext::Handles {
  static constexpr int side = 16;
  OSMesaContext context = nullptr;
  std::array<unsigned char, 4 * side * side> buffer{};
};

OffscreenContext::OffscreenContext() : handles_(std::make_unique<Handles>()) {
  const std::array attributes{OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              32,
                              OSMESA_STENCIL_BITS,
                              0,
                              OSMESA_ACCUM_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              2,
                              0};
  handles_->context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
}

OffscreenContext::~OffscreenContext() {
  if (is_current()) release();
  if (handles_->context) OSMesaDestroyContext(handles_->context);
}

bool OffscreenContext::is_valid() const { return handles_->context != nullptr; }

void OffscreenContext::make_current() {
  OSMesaMakeCurrent(handles_->context, handles_->buffer.data(), GL_UNSIGNED_BYTE, Handles::side, Handles::side);
}

bool OffscreenContext::is_current() const { return is_valid() && OSMesaGetCurrentContext() == handles_->context; }

void OffscreenContext::release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

}  // namespace ejecta
