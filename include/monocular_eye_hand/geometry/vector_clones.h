#pragma once

// A function marked so is compiled for AVX2 as well and chosen at run time. Both do the same operations in
// the same order (no fused multiply-add), so their results are equal; the plain one is the reference, and all
// there is where MONOCULAR_EYE_HAND_PLAIN is defined.
#if !defined(MONOCULAR_EYE_HAND_PLAIN) && defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    defined(__linux__)
#define MONOCULAR_EYE_HAND_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
// What such a function calls has to become part of it.
#define MONOCULAR_EYE_HAND_INLINE inline __attribute__((always_inline))
#define MONOCULAR_EYE_HAND_LAMBDA __attribute__((always_inline))
#else
#define MONOCULAR_EYE_HAND_INLINE inline
#define MONOCULAR_EYE_HAND_LAMBDA
#define MONOCULAR_EYE_HAND_VECTOR_CLONES
#endif
