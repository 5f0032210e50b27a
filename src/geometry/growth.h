/* growth: the ranks of a distribution and its iterated brackets.
 *
 *     D^1 = D,   D^(j+1) = D^j + [D, D^j],   r_j = rank D^j            [BellaicheRisler1996, ch. 1]
 *
 * The ranks at generic points are the growth vector.  Where they stop growing D^j is involutive; it is the smallest
 * involutive distribution that contains D, and N - r_j independent functions are constant along D (Frobenius).
 *
 * The ranks are computed at random points modulo two primes (closure.h): lower bounds that almost every point reaches.
 * Where the last rank r is below N, exact elimination proves that nothing was missed: r of the brackets span an
 * involutive distribution that contains D, and every entry that must vanish is zero by normal form.  Where a normal
 * form is too large `proved` is false, unless as many functions are known to be constant (distribution.c).
 *
 * Functions without residues (velocities that are given implicitly, Bessel functions, ..): the ranks at the model's
 * probes decide, where the smallest singular value that counts is far above rounding; `by_numbers`. */
#ifndef NH_GROWTH_H
#define NH_GROWTH_H

#include "geometry/closure.h"

/* The space: the coordinates, with time before them, with the velocities of the chart after them. */
typedef enum { NH_ON_POSITIONS, NH_ON_EVENTS, NH_ON_STATES } nh_growth_space;

typedef struct {
    nh_growth_space space;
    size_t dimension;                    /* N */
    size_t length, rank[NH_MOST_GROWTH]; /* generic ranks, strictly increasing */
    bool proved, by_numbers;
    bool cut; /* formulas became too large: the ranks may grow further */
    /* at an examined place of the sampling domain the ranks grow differently */
    bool drops;
    nh_ex where; /* the coordinate that vanishes there; 0: all of them vanish */
    size_t length_there, rank_there[NH_MOST_GROWTH];
} nh_growth;

/* The growth of `count` fields with components field[i*N + j] along symbol[j].  `shift` is subtracted from all ranks
 * and N (directions that the user does not count).  Also examines special places: each coordinate, and all of them, at
 * zero, where the domain contains such places. */
nh_growth nh_growth_of(const nh_model *model, size_t count, size_t N, const nh_ex *symbol, const nh_ex *field,
                       size_t shift);

/* The bracket [a, b] of two fields on these symbols. */
void nh_growth_bracket(nh_dag *dag, size_t N, const nh_ex *symbol, const nh_ex *a, const nh_ex *b, nh_ex *out);

#endif
