/* kernel: the functions of which an expression is a rational function.
 *
 *     e in Q(k1, k2, ...),   k: symbols, sin(a), cos(a), exp(a), b^(1/n), b^x, |a|, log(a), ...
 *
 * An argument a = sum_i c_i t_i (rational c_i, "atoms" t_i) of sin, cos, exp is split into its atoms, and the rational
 * multiples of one atom share a kernel: sin(t/2) and cos(t/3) are polynomials in sin(t/6), cos(t/6).  "Literal" tables
 * do not split arguments: they keep sin(a + b) and sinh as they are, for forms that are printed.
 *
 * Arguments must be canonical already (form.h): equal ones must have equal indices. */
#ifndef NH_KERNEL_H
#define NH_KERNEL_H

#include "graph/index.h"

typedef enum {
    NH_KERNEL_PLAIN,
    NH_KERNEL_SIN,
    NH_KERNEL_COS,
    NH_KERNEL_SINH,
    NH_KERNEL_COSH,
    NH_KERNEL_EXP,
    NH_KERNEL_POWER,
    NH_KERNEL_ROOT,
    NH_KERNEL_ABS
} nh_kernel_kind;

typedef struct {
    nh_kernel_kind kind;
    nh_ex base;  /* power: its base; otherwise 0 */
    nh_ex atom;  /* argument / unit; root: the radicand; plain: the expression itself */
    nh_num unit; /* root: 1/order */
    /* a shorter expression that is equal to the plain expression, radicand or argument, for display; 0: none */
    nh_ex shown;
    size_t length; /* complexity, for display */
    size_t discovered;
    size_t partner; /* the cosine of a sine and vice versa */
} nh_kernel;

/* One c*t of a linear form. */
typedef struct {
    nh_ex atom;
    nh_num coefficient;
} nh_part;

typedef struct {
    nh_part *item;
    size_t count, capacity;
} nh_parts;

/* What family(coefficient * atom) is in terms of a kernel. */
typedef struct {
    nh_kernel_kind family; /* NH_KERNEL_SIN and _SINH stand for their partners too */
    nh_ex base, atom;
    nh_num coefficient; /* positive; root: 1/q */
    nh_num unit;
    size_t kernel; /* with argument unit * atom */
    bool settled;
} nh_kernel_use;

typedef struct {
    nh_dag *dag; /* borrowed */
    bool literal;
    /* sin(3 x) without sin(x) beside it is a kernel, and no polynomial of degree 3: for expressions that are compared
     * with no others */
    bool coarse;
    bool opaque;     /* inexact numbers are kernels of their own, not dyadic rationals */
    bool broken;     /* an expression was not a number */
    bool too_deep;   /* an expression was nested deeper than the stack bears */
    nh_kernel *item; /* kernels in an order that does not depend on other kernels */
    size_t count, capacity;
    size_t *order; /* the kernels in an order in which radicands come before their roots */
    nh_kernel_use *use;
    size_t uses, use_capacity;
    nh_index seen, plain;
} nh_kernels;

void nh_kernels_init(nh_kernels *kernels, nh_dag *dag, bool literal, bool opaque);
void nh_kernels_clear(nh_kernels *kernels);
void nh_kernels_collect(nh_kernels *kernels, nh_ex e); /* collects what e needs */
void nh_kernels_settle(nh_kernels *kernels);           /* chooses the units and numbers the kernels */

/* The kernel of a symbol, an opaque function or number. */
size_t nh_kernel_plain(const nh_kernels *kernels, nh_ex e);
/* The kernel of family(c*atom), c > 0, with c = *multiple * unit. */
size_t nh_kernel_find(const nh_kernels *kernels, nh_kernel_kind family, nh_ex base, nh_ex atom, nh_num c,
                      int64_t *multiple);
/* The product to which (kernel)^power is equal. */
nh_ex nh_kernel_power(const nh_kernels *kernels, size_t kernel, int64_t power);
/* unit * atom, as shown */
nh_ex nh_kernel_argument(const nh_kernels *kernels, size_t kernel);

/* The linear form of an argument, or with `whole` its rational content and the rest; the caller frees parts->item. */
void nh_parts_make(nh_dag *dag, bool whole, nh_ex argument, nh_parts *parts);
/* The same for the argument of a family's functions. */
void nh_kernel_parts(const nh_kernels *kernels, nh_kernel_kind family, nh_ex argument, nh_parts *parts);
/* Is c*atom a whole number of quarter turns, that is atom = pi and 2 c whole?  *turns: their number. */
bool nh_quarter_turns(const nh_dag *dag, nh_part part, int64_t *turns);

/* How an exponent is treated: whole powers are polynomial, fractions with small denominators are roots, powers with any
 * other number are kernels by themselves; what is not a number is symbolic. */
typedef enum { NH_EXPONENT_WHOLE, NH_EXPONENT_ROOT, NH_EXPONENT_OPAQUE, NH_EXPONENT_SYMBOLIC } nh_exponent_kind;
nh_exponent_kind nh_exponent_kind_of(const nh_dag *dag, nh_ex exponent);

/* b^(n + x) = b^n b^x: the number n of an exponent, and x in *rest.  (-1 (x - 1) counts as such a sum, too.) */
nh_ex nh_exponent_number(nh_dag *dag, nh_ex exponent, nh_ex *rest);

#endif
