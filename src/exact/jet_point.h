/* jet_point: values modulo a prime for the functions in expressions, at a point that stands for a generic one.
 *
 * Expressions are rational functions of symbols and kernels: sin and cos of an atom, exp of an atom, roots, logarithms
 * and other primitives.  A choice of residues for these is a point when it satisfies the relations between them:
 *
 *     sin, cos     of an atom: a rational point of the circle; of its rational multiples: multiples of one angle
 *     sin, cos     of pi/n: a point of the circle that is a root of 1 of order 2 n, such that square roots of whole
 *                  numbers are the sums of cosines that they are (Gauss)
 *     exp          of an atom: any residue; of its rational multiples: powers of one residue
 *     roots        of one radicand: powers of one root; square roots are squares themselves, so that sqrt(a b) =
 *                  sqrt(a) sqrt(b)
 *     |u|          u or -u, whichever is a square; only one such kernel
 *     log, asin, atan, atan2, asinh, ..    any residue each
 *     f, f' where f'' = P f' + Q f         any residue each, where `solutions` is set: they stand for any solution of
 *                                          the equation, not for f
 *     f where f' = P + Q f                 any residue, the same
 *
 * Arguments have to be canonical (nh_form_rewrite).  Whether there are other relations, nh_jet_point_related says
 * (jet_independent.h): ask it before values at points are taken for those of the functions. */
#ifndef NH_JET_POINT_H
#define NH_JET_POINT_H

#include "exact/residue.h"
#include "graph/expr.h"

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
    nh_ex key;      /* an atom, a radicand, or the expression that is a kernel by itself */
    uint64_t order; /* the kernel is a function of key/order, or the root of key of this order */
    bool chosen;
    nh_residue value, sine; /* residue of exp, root or primitive; or of cos and sin, or of f and f' */
    /* of f; P of asin, acos, asinh, acosh: the derivative by the argument, which has a root; of a square root that is
     * a function of other kernels: this function */
    nh_ex P, Q;
    bool dependent; /* such a root */
    size_t place;   /* the index of the argument of f that varies */
} nh_jet_kernel;

/* For each node of a graph: the memory of its series, and what is known of it; all empty between two evaluations. */
typedef struct {
    size_t nodes;
    nh_residue **value;
    uint8_t *state;
} nh_jet_table;

typedef struct {
    nh_dag *dag;
    nh_prime field;
    uint64_t random;    /* the seed of this point */
    nh_jet_table spare; /* of an evaluation that ended: graphs are large, and few of their nodes are needed */
    nh_jet_kernel *kernel;
    size_t kernels, capacity;
    size_t pieces; /* number of kernels |u| */
    /* roots may have any sign: each choice is another homomorphism where they are independent */
    bool conjugates;
    /* the sign of a function where the roots have their values, 0 where it is not known; NULL */
    int (*sign)(void *context, nh_ex e);
    void *context;
    bool solutions;       /* named functions are accepted (graph/named_function.h) */
    const char *obstacle; /* why an expression cannot be evaluated at points, or NULL */
} nh_jet_point;

/* Borrows the graph; nh_jet_point_free. */
nh_jet_point *nh_jet_point_create(nh_dag *dag);
void nh_jet_point_free(nh_jet_point *point);

/* Registers the kernels of these expressions.  False, with an obstacle, when one cannot be evaluated at points. */
bool nh_jet_point_register(nh_jet_point *point, size_t n, const nh_ex *e);

/* The index-th of the primes modulo which the numbers that stand below roots have these roots; when there are few such
 * primes, of the first primes. */
nh_prime nh_jet_point_prime(const nh_jet_point *point, size_t index);

/* The order of the root of 1 that e^(i pi/n) is for the multiples of pi that occur; 1: there are none.  The circle has
 * such points where it divides p + 1. */
uint64_t nh_jet_point_unity(const nh_jet_point *point);
/* Is the root of this number a sum of cosines of the multiples of pi that occur? */
bool nh_jet_point_is_in_unity(const nh_jet_point *point, nh_ex radicand);
/* The kernel of asin, acos, asinh or acosh; NULL for other functions. */
const nh_jet_kernel *nh_jet_point_inverse(nh_jet_point *point, nh_ex e);

/* Is e the number pi?  Its sine and cosine are no free residues. */
bool nh_jet_point_is_pi(const nh_jet_point *point, nh_ex e);

/* Forgets all values; the next ones follow from prime and seed. */
void nh_jet_point_choose(nh_jet_point *point, nh_prime field, uint64_t seed);

/* Gives functions of these symbols the values that they have where the symbols vanish; the others stay random.  False
 * where one has no value there that is known: sin(x y + z) at x = 0 is related to other kernels. */
bool nh_jet_point_vanish(nh_jet_point *point, size_t n, const nh_ex *symbol);

/* Residues of a number and of kernels, for evaluation.  False where this point has no such value: take another
 * point. */
bool nh_jet_point_number(const nh_jet_point *point, nh_num a, nh_residue *out);
/* The kernel of a root that is a function of others; NULL for every other root. */
const nh_jet_kernel *nh_jet_point_dependent(nh_jet_point *point, nh_ex radicand);
/* value^exponent */
bool nh_jet_point_root(nh_jet_point *point, nh_ex radicand, nh_residue value, nh_num exponent, nh_residue *out);
bool nh_jet_point_circle(nh_jet_point *point, nh_ex argument, nh_residue *sine, nh_residue *cosine);
bool nh_jet_point_exponential(nh_jet_point *point, nh_ex argument, nh_residue *out);
nh_residue nh_jet_point_free_value(nh_jet_point *point, nh_ex primitive);
/* The kernel of f, for f and for f' where its equation is of second order, with its residues chosen. */
const nh_jet_kernel *nh_jet_point_solution(nh_jet_point *point, nh_ex f);
/* A random residue for the derivative of this order of the unspecified function number f at the residue `at`. */
nh_residue nh_jet_point_derivative(const nh_jet_point *point, int64_t f, int64_t order, nh_residue at);

#endif
