#pragma once
/// Included before everything else (CMakeLists.txt), so that Eigen finds the intrinsics included already: those of GCC
/// 12 for AVX-512 begin with undefined vectors, and warnings about these say nothing about our code.
#if defined(__AVX512F__) || defined(__AVX2__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif
