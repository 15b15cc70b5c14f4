#include "insitu/headless_window.hpp"

#include <vtkObjectFactory.h>
#include <vtkObjectFactoryCollection.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRendererCollection.h>
#include <vtkSmartPointer.h>
#include <vtkVersion.h>

#include <optional>
#include <string_view>

#include "insitu/offscreen_context.hpp"

namespace ejecta {
namespace {

class HeadlessWindow : public vtkOpenGLRenderWindow {
 public:
  static HeadlessWindow* New();
  vtkTypeMacro(HeadlessWindow, vtkOpenGLRenderWindow);

  void Initialize() override {
    if (context_) return;
    CreateAWindow();
    OpenGLInit();
  }
  void Finalize() override { DestroyWindow(); }
  void MakeCurrent() override {
    if (context_) context_->make_current();
  }
  bool IsCurrent() override { return context_ && context_->is_current(); }
  vtkTypeBool IsDirect() override { return 0; }
  int SupportsOpenGL() override { return 1; }
  void* GetGenericContext() override { return context_ ? &*context_ : nullptr; }
  int* GetScreenSize() override { return screen_size_; }

 protected:
  HeadlessWindow() {
    SetUseOffScreenBuffers(true);
    SetShowWindow(false);
    SetMultiSamples(0);
    SetStencilCapable(1);
  }
  ~HeadlessWindow() override {
    Finalize();
    vtkRenderer* renderer;
    vtkCollectionSimpleIterator it;
    for (Renderers->InitTraversal(it); (renderer = Renderers->GetNextRenderer(it));) renderer->SetRenderWindow(nullptr);
  }
  void CreateAWindow() override {
    context_.emplace();
    if (!context_->is_valid()) context_.reset();
    MakeCurrent();
    Mapped = 0;
    if (Size[0] <= 0 || Size[1] <= 0) SetSize(300, 300);
  }
  void DestroyWindow() override {
    if (!context_) return;
    MakeCurrent();
    ReleaseGraphicsResources(this);
    context_.reset();
  }

 private:
  std::optional<OffscreenContext> context_;
  int screen_size_[2] = {8192, 8192};
};

vtkStandardNewMacro(HeadlessWindow);

class HeadlessFactory : public vtkObjectFactory {
 public:
  static HeadlessFactory* New();
  vtkTypeMacro(HeadlessFactory, vtkObjectFactory);
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return description; }

  static constexpr const char* description = "Ejecta off-screen windows";

 protected:
  HeadlessFactory() {
    RegisterOverride("vtkRenderWindow", "HeadlessWindow", description, 1,
                     []() -> vtkObject* { return HeadlessWindow::New(); });
  }
};

vtkStandardNewMacro(HeadlessFactory);

bool is_registered() {
  vtkObjectFactoryCollection* factories = vtkObjectFactory::GetRegisteredFactories();
  vtkCollectionSimpleIterator it;
  factories->InitTraversal(it);
  while (vtkObjectFactory* factory = factories->GetNextObjectFactory(it))
    if (std::string_view(factory->GetDescription()) == HeadlessFactory::description) return true;
  return false;
}

}  // namespace

void use_headless_window() {
  if (is_registered()) return;
  vtkObjectFactory::RegisterFactory(vtkSmartPointer<HeadlessFactory>::New());
  // The first enabled factory that knows a class wins, and VTK's own came first.
  vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindow", "vtkXOpenGLRenderWindow");
}

}  // namespace ejecta
