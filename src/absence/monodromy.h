/* monodromy: how far the monodromy of linear equations moves a general vector, in ball arithmetic.
 * [docs/method.md, "No other integral"] */
#ifndef NH_MONODROMY_H
#define NH_MONODROMY_H

#include <stdint.h>

#include "absence/linear_equation.h"

typedef struct {
    size_t size, rank;    /* of the direct sum; certified: an orbit of the group has at least this dimension */
    const char *obstacle; /* rank < size: the first, in words; else NULL */
    long bits;
    size_t blocks;
    size_t singular, steps, words; /* points, Taylor steps, elements of the Lie algebra used */
    uint64_t work;                 /* products of complex numbers, times their words of 64 bits */
    /* loops are closed paths in the x-plane without the singular points: regular or irregular, the rank is that of the
     * monodromy group alone */
    const char **trace; /* per block and loop: of the monodromy, "re + im i" as balls of 20 digits; blocks x singular,
                         * row by row; NULL: the loops were not all followed */
} nh_monodromy;

/* The direct sum of `blocks` equations, continued along the same loops; in the arena.  Blocks of size 1 are allowed,
 * and equal ones.  Work is counted, and has a limit. */
nh_monodromy *nh_monodromy_of(nh_arena *arena, size_t blocks, const nh_linear_equation *block, long bits);
/* The same with 256 bits, and with 512 and 1024, until the rank is full or more bits cannot help. */
nh_monodromy *nh_monodromy_try(nh_arena *arena, size_t blocks, const nh_linear_equation *block);

#endif
