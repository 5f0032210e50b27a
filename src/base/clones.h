/* clones: loops compiled for several processors; the loader takes the one that suits.  Not under sanitizers, which are
   not ready when it does. */
#ifndef NH_CLONES_H
#define NH_CLONES_H

#if defined __x86_64__ && defined __GNUC__ && !defined __clang__ && \
    !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define NH_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define NH_CLONES
#endif

#endif
