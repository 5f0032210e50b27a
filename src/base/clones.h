/* clones: a loop marked by NH_CLONES is compiled for several instruction sets; the loader chooses the one that the
 * processor has.  Not in sanitized builds: the sanitizer is not initialised yet when the loader chooses. */
#ifndef NH_CLONES_H
#define NH_CLONES_H

#if defined __x86_64__ && defined __GNUC__ && !defined __clang__ && !defined __SANITIZE_ADDRESS__ &&                   \
    !defined __SANITIZE_THREAD__
#define NH_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define NH_CLONES
#endif

#endif
