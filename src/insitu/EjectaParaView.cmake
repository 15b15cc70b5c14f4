# ParaView with Catalyst and the way it reaches OpenGL. Defines the targets
#   ejecta_insitu    the in-situ layer (src/insitu), the only code that sees VTK
#   ejecta_gl_entry  objects every executable that renders must carry: link both to it
# EJECTA_GL chooses the OpenGL: osmesa (software, no display, no GPU), egl (no display, GPU where there is one) or
# x11 (what the ParaView at hand does by itself: a display, or a ParaView built for off-screen rendering).
set(EJECTA_GL osmesa CACHE STRING "OpenGL for in-situ images: osmesa, egl or x11")
set_property(CACHE EJECTA_GL PROPERTY STRINGS osmesa egl x11)

# ParaView's own modules use the system's Python, not one that happens to come first in PATH.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(ParaView 5.11 REQUIRED COMPONENTS Catalyst PythonCatalyst)
find_package(pybind11 REQUIRED)

# The exported libraries of ParaView name imported targets (X11::X11, GLEW::GLEW, hdf5::hdf5, ...) of development packages
# that only a build of ParaView itself needs: the shared libraries find theirs at run time. Names that nobody defined
# are dropped, so that none of those packages has to be installed.
get_property(imported_targets DIRECTORY PROPERTY IMPORTED_TARGETS)
foreach(library IN LISTS imported_targets)
  get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
  if(NOT links)
    continue()
  endif()
  set(known_links)
  foreach(link IN LISTS links)
    string(REGEX MATCH "[A-Za-z0-9_.-]+::[A-Za-z0-9_.-]+" name "${link}")
    if(NOT name OR TARGET ${name})
      list(APPEND known_links "${link}")
    endif()
  endforeach()
  set_property(TARGET ${library} PROPERTY INTERFACE_LINK_LIBRARIES "${known_links}")
endforeach()

get_filename_component(ejecta_root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
set(insitu ${ejecta_root}/src/insitu)
add_library(ejecta_insitu STATIC
  ${insitu}/catalyst_bridge.cpp ${insitu}/gl_probe.cpp ${insitu}/image_index.cpp ${insitu}/insitu_log.cpp
  ${insitu}/paint_module.cpp ${insitu}/pipelines.cpp ${insitu}/vtk_channels.cpp ${insitu}/vtk_files.cpp)
target_compile_definitions(ejecta_insitu PRIVATE OMPI_SKIP_MPICXX)
# pybind11's types are hidden, as they must be; the rest of the layer is not compiled otherwise.
set_source_files_properties(${insitu}/paint_module.cpp PROPERTIES COMPILE_OPTIONS -fvisibility=hidden)
target_link_libraries(ejecta_insitu PUBLIC ejecta_render
  PRIVATE ParaView::Catalyst ParaView::PythonCatalyst ParaView::RemotingServerManager VTK::RenderingOpenGL2 VTK::FiltersSources VTK::IOXML VTK::IOXdmf2 VTK::PythonInterpreter pybind11::headers VTK::Python)

if(EJECTA_GL STREQUAL "osmesa")
  find_library(OSMESA_LIBRARY OSMesa REQUIRED)
  target_sources(ejecta_insitu PRIVATE ${insitu}/headless_window.cpp ${insitu}/offscreen_context_osmesa.cpp)
  add_library(ejecta_gl_entry OBJECT ${insitu}/gl_entry.cpp ${insitu}/gl_entry_osmesa.cpp)
  # OSMesa brings gl* functions of its own: it must come before libOpenGL, and the entry points be visible to VTK.
  target_link_options(ejecta_gl_entry INTERFACE -rdynamic LINKER:--no-as-needed,${OSMESA_LIBRARY},--as-needed)
  target_link_libraries(ejecta_gl_entry INTERFACE ${CMAKE_DL_LIBS})
elseif(EJECTA_GL STREQUAL "egl")
  find_library(EGL_LIBRARY EGL REQUIRED)
  target_sources(ejecta_insitu PRIVATE ${insitu}/headless_window.cpp ${insitu}/offscreen_context_egl.cpp)
  target_link_libraries(ejecta_insitu PRIVATE ${EGL_LIBRARY})
  add_library(ejecta_gl_entry OBJECT ${insitu}/gl_entry.cpp)
  target_link_options(ejecta_gl_entry INTERFACE -rdynamic)
  target_link_libraries(ejecta_gl_entry INTERFACE ${CMAKE_DL_LIBS})
elseif(EJECTA_GL STREQUAL "x11")
  target_sources(ejecta_insitu PRIVATE ${insitu}/headless_window_x11.cpp)
  add_library(ejecta_gl_entry INTERFACE)
else()
  message(FATAL_ERROR "EJECTA_GL: expected osmesa, egl or x11, got ${EJECTA_GL}")
endif()
