/* residues: y' = a(x) y with a in Q(x): is the group of its solutions infinite? */
#ifndef NH_RESIDUES_H
#define NH_RESIDUES_H

#include "absence/linear_equation.h"

/* NH_RESIDUE_MEROMORPHIC: some residue is not rational, so a loop multiplies y by no root of unity.
 * NH_RESIDUE_RATIONAL: only a pole of higher order, or at infinity, makes the group infinite.
 * NH_RESIDUE_OPEN: it is finite. */
typedef enum { NH_RESIDUE_MEROMORPHIC, NH_RESIDUE_RATIONAL, NH_RESIDUE_OPEN } nh_residue_verdict;

typedef struct {
    nh_residue_verdict verdict;
    /* The factor of the denominator that decides, "x^2 + 2", irreducible over Q; "1/x": the point at infinity.  NULL:
     * the verdict is NH_RESIDUE_OPEN. */
    const char *factor;
    const char *residue; /* there: a polynomial in x modulo the factor; at infinity a number */
    slong order;         /* of the pole there, in the coefficient a; at infinity of a(1/u)/u^2 at u = 0 */
} nh_residues;

/* Of an equation of size 1; in the arena. */
nh_residues *nh_residues_of(nh_arena *arena, const nh_linear_equation *equation);

#endif
