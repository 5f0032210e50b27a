/* jet_point: values modulo a prime for the functions in expressions, at a point that stands for a generic one.
 *
 * Expressions are rational functions of symbols and kernels: sin and cos of an atom, exp of an atom, roots, logarithms
 * and other primitives.  A choice of residues for these is a point when it keeps the relations between them:
 *
 *     sin, cos     of an atom: a rational point of the circle; of its rational multiples: multiples of one angle
 *     exp          of an atom: any residue; of its rational multiples: powers of one residue
 *     roots        of one radicand: powers of one root; square roots are squares themselves, so that sqrt(a b) =
 *                  sqrt(a) sqrt(b)
 *     |u|          u or -u, whichever is a square; only one such kernel
 *     log, asin, atan, atan2, asinh, ..    any residue each
 *     f, f' where f'' = P f' + Q f         any residue each, where `solutions` is set: they stand for any solution of
 *                                          the equation, not for f
 *     f where f' = P + Q f                 any residue, the same
 *
 * Arguments have to be canonical (nh_form_rewrite).  There are no other relations when the atoms of exp and the
 * logarithms have derivatives that are linearly independent over Q, and so have the atoms of sin and cos with the
 * inverse trigonometric functions [Ax1971]: nh_jet_equations_related looks for the contrary. */
#ifndef NH_JET_POINT_H
#define NH_JET_POINT_H

#include "graph/dag.h"
#include "exact/residue.h"

typedef enum {
    NH_JET_CIRCLE,
    NH_JET_EXPONENTIAL,
    NH_JET_ROOT,
    NH_JET_FREE,
    NH_JET_SOLUTION,
    NH_JET_FIRST_ORDER
} nh_jet_kernel_kind;

typedef struct {
    nh_jet_kernel_kind kind;
    nh_ex key;             /* atom, radicand, or the primitive itself */
    uint64_t order;        /* the kernel is of key/order, or the order of the root */
    bool chosen;
    nh_residue value, sine; /* of exp, the root, the primitive, or cos and sin, or f and f' */
    nh_ex P, Q;            /* of f */
    size_t place;          /* by which argument of f */
} nh_jet_kernel;

typedef struct {
    nh_dag *dag;
    nh_prime field;
    uint64_t random;
    nh_jet_kernel *kernel;
    size_t kernels, capacity;
    size_t pieces;          /* kernels |u| */
    /* roots of numbers have any sign: another homomorphism from the numbers, for every choice */
    bool conjugates;
    bool solutions;         /* named functions may be noted (graph/named_function.h) */
    const char *obstacle;   /* why expressions cannot be followed, or NULL */
} nh_jet_point;

/* Borrows the graph. */
nh_jet_point *nh_jet_point_create(nh_dag *dag);
void nh_jet_point_free(nh_jet_point *point);

/* Note the kernels of these expressions.  False, with an obstacle, when one cannot be followed. */
bool nh_jet_point_register(nh_jet_point *point, size_t n, const nh_ex *e);

/* The index-th of the primes modulo which the numbers that stand below roots have these roots; of the first primes when
   there are few. */
nh_prime nh_jet_point_prime(const nh_jet_point *point, size_t index);

/* Forget all values; the next ones follow from prime and seed. */
void nh_jet_point_choose(nh_jet_point *point, nh_prime field, uint64_t seed);

/* For evaluation.  False where this point has no such value: take another one. */
bool nh_jet_point_number(const nh_jet_point *point, nh_num a, nh_residue *out);
/* value^exponent */
bool nh_jet_point_root(nh_jet_point *point, nh_ex radicand, nh_residue value, nh_num exponent, nh_residue *out);
bool nh_jet_point_circle(nh_jet_point *point, nh_ex argument, nh_residue *sine, nh_residue *cosine);
bool nh_jet_point_exponential(nh_jet_point *point, nh_ex argument, nh_residue *out);
nh_residue nh_jet_point_free_value(nh_jet_point *point, nh_ex primitive);
/* The kernel of f, for f and for f' where the equation is of second order, with its residues chosen. */
const nh_jet_kernel *nh_jet_point_solution(nh_jet_point *point, nh_ex f);

#endif
