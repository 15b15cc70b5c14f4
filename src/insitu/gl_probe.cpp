#include "insitu/gl_probe.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "insitu/headless_window.hpp"
#include "insitu/insitu_log.hpp"

namespace ejecta {

bool gl_works() {
  constexpr std::chrono::seconds patience{60};
  char program[] = "/proc/self/exe", argument[] = "gl-probe";
  char* arguments[] = {program, argument, nullptr};
  posix_spawn_file_actions_t silence;
  posix_spawn_file_actions_init(&silence);
  posix_spawn_file_actions_addopen(&silence, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&silence, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = posix_spawn(&child, program, &silence, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&silence);
  if (failure) return false;

  const auto deadline = std::chrono::steady_clock::now() + patience;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int run_gl_probe() {
  constexpr int side = 64;
  LogRedirection redirection("");
  use_headless_window();
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(side, side);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, side - 1, side - 1, 0, pixels);
  const unsigned char* first = pixels->GetPointer(0);
  const auto count = pixels->GetNumberOfValues();
  const bool lit = count > 0 && std::any_of(first, first + count, [](unsigned char v) { return v > 100; });
  return lit ? 0 : 1;
}

}  // namespace ejecta
