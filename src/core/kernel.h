/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Attributes of kernels. A core is written once and inlined with constant dimension and support. */
#ifndef GRIDCROSS_CORE_KERNEL_H
#define GRIDCROSS_CORE_KERNEL_H

/* An elementwise kernel compiled for several instruction sets; equal bits, since nothing contracts to FMA. */
#if GX_HAVE_CLONES > 1 /* AVX-512, whose vectors gcc makes 512 bits wide at this level */
#define GX_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#elif GX_HAVE_CLONES
#define GX_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define GX_CLONES
#endif

#define GX_CORE static inline __attribute__((always_inline))

/* Before a loop: its iterations do not touch each other's data, which pointers in an array cannot say. */
#if defined __clang__
#define GX_APART
#else
#define GX_APART _Pragma("GCC ivdep")
#endif

/* Runs statement with `dim` a constant. */
#define GX_FOR_DIM(value, statement)                                                                                             \
  switch (value) {                                                                                                               \
  case 1: {                                                                                                                      \
    enum { dim = 1 };                                                                                                            \
    statement;                                                                                                                   \
    break;                                                                                                                       \
  }                                                                                                                              \
  case 2: {                                                                                                                      \
    enum { dim = 2 };                                                                                                            \
    statement;                                                                                                                   \
    break;                                                                                                                       \
  }                                                                                                                              \
  default: {                                                                                                                     \
    enum { dim = 3 };                                                                                                            \
    statement;                                                                                                                   \
    break;                                                                                                                       \
  }                                                                                                                              \
  }

#endif
