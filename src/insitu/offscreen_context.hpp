#pragma once
/// An OpenGL context that needs no display. One implementation is linked: offscreen_context_osmesa.cpp (software, the
/// default) or offscreen_context_egl.cpp (surfaceless, or a GPU's device).
#include <memory>

namespace ejecta {

class OffscreenContext {
 public:
  /// Creates a core-profile 3.2 context with RGBA colour and depth; `is_valid()` is false where that is impossible.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  bool is_valid() const;
  void make_current();
  bool is_current() const;
  /// Leaves no context current.
  void release();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ejecta
