/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_CLONES_H
#define ABUT_BASE_CLONES_H

/* Functions whose loops gain from wider vector instructions are compiled twice;
 * the processor decides at load time. The clones compute the same to the last
 * bit: AVX2 alone has no fused multiplication and addition. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__)         \
    && !defined(__clang__)
#define ABUT_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ABUT_CLONES
#endif

/* Functions that they call, or that are compiled once for each constant
 * argument. */
#define ABUT_INLINE static inline __attribute__((always_inline))

#endif
