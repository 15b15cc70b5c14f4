# One source for the passes of each kernel, dimension and kind of neighbourhood, so that they compile side by side. The words
# are the structs of kernels.hpp, and the schemes those of pair_pass_kinds.hpp.
foreach(KERNEL CubicSpline QuinticSpline WendlandC2 WendlandC4)
  foreach(DIM 2 3)
    foreach(SCHEME isotropic anisotropic)
      set(source ${PROJECT_BINARY_DIR}/passes/${SCHEME}_${KERNEL}_${DIM}d.cpp)
      configure_file(${CMAKE_CURRENT_LIST_DIR}/pair_pass.cpp.in ${source} @ONLY)
      target_sources(ejecta_schemes PRIVATE ${source})
    endforeach()
  endforeach()
endforeach()
