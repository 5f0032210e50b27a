/* function: the functions of expressions, and calls of them. */
#ifndef NH_FUNCTION_H
#define NH_FUNCTION_H

#include "graph/node.h"

/* Elementary functions of one argument, which have the names of the C library: identifier, name, parity (-1 odd, 1
 * even, 0 neither), values at 0 and at 1 where these are whole numbers (-1: no such rule).  Their evaluation at a point
 * and in a batch, their declarations in machine code and the lists in messages are made from these rows. */
#define NH_ELEMENTARY_TABLE(X)                                                                                         \
    X(SIN, sin, -1, 0, -1)                                                                                             \
    X(COS, cos, 1, 1, -1)                                                                                              \
    X(TAN, tan, -1, 0, -1)                                                                                             \
    X(ASIN, asin, -1, 0, -1)                                                                                           \
    X(ACOS, acos, 0, -1, 0)                                                                                            \
    X(ATAN, atan, -1, 0, -1)                                                                                           \
    X(SINH, sinh, -1, 0, -1)                                                                                           \
    X(COSH, cosh, 1, 1, -1)                                                                                            \
    X(TANH, tanh, -1, 0, -1)                                                                                           \
    X(ASINH, asinh, -1, 0, -1)                                                                                         \
    X(ACOSH, acosh, 0, -1, 0)                                                                                          \
    X(ATANH, atanh, -1, 0, -1)                                                                                         \
    X(EXP, exp, 0, 1, -1)                                                                                              \
    X(LOG, log, 0, -1, 0)
/* "sin cos ... log " */
#define NH_ELEMENTARY_WORD(id, name, parity, at_zero, at_one) #name " "
#define NH_ELEMENTARY_WORDS NH_ELEMENTARY_TABLE(NH_ELEMENTARY_WORD)

#define X(id, name, parity, at_zero, at_one) NH_##id,
typedef enum {
    NH_ELEMENTARY_TABLE(X) NH_ABS,
    NH_SIGN,
    NH_ATAN2,
    NH_PI,
    /* Named functions (named_function.h): solutions of a linear equation of second order, each followed by its
       derivative; */
    NH_LEGENDRE_P,
    NH_LEGENDRE_P_PRIME,
    NH_LEGENDRE_Q,
    NH_LEGENDRE_Q_PRIME,
    NH_HYP2F1,
    NH_HYP2F1_PRIME,
    NH_GAUSS_F,
    NH_GAUSS_F_PRIME,
    NH_RIEMANN_C,
    NH_RIEMANN_C_PRIME,
    NH_RIEMANN_S,
    NH_RIEMANN_S_PRIME,
    NH_HYP1F1,
    NH_HYP1F1_PRIME,
    NH_HYPERU,
    NH_HYPERU_PRIME,
    NH_BESSEL_J,
    NH_BESSEL_J_PRIME,
    NH_BESSEL_Y,
    NH_BESSEL_Y_PRIME,
    NH_BESSEL_I,
    NH_BESSEL_I_PRIME,
    NH_BESSEL_K,
    NH_BESSEL_K_PRIME,
    NH_AIRY_AI,
    NH_AIRY_AI_PRIME,
    NH_AIRY_BI,
    NH_AIRY_BI_PRIME,
    NH_ELLIPTIC_K,
    NH_ELLIPTIC_E,
    NH_ELLIPTIC_F,
    NH_ELLIPTIC_EINC,
    NH_ELLIPTIC_PI, /* elliptic integrals */
    NH_UNSPECIFIED, /* a function that a file declares without a value (declared.h) */
    NH_TABLE,       /* one that interpolates a table of values (declared.h) */
    NH_FUNCTION_COUNT
} nh_function;
#undef X

enum { NH_MOST_ARGUMENTS = 4 }; /* of a function */

nh_ex nh_call(nh_dag *dag, nh_function f, nh_ex a);
nh_ex nh_call2(nh_dag *dag, nh_function f, nh_ex a, nh_ex b);
nh_ex nh_call_any(nh_dag *dag, nh_function f, const nh_ex *argument); /* with nh_function_arity(f) arguments */
nh_ex nh_pi(nh_dag *dag);

/* Of a function. */
static inline nh_function nh_function_of(const nh_dag *dag, nh_ex e) { return (nh_function)nh_node_of(dag, e)->op; }

const char *nh_function_name(nh_function f);
size_t nh_function_arity(nh_function f);
/* what to write in place of a function's name in other languages: "write 1/tan(...)"; or NULL */
const char *nh_function_elsewhere(const char *name);
/* The function whose name is nearest to `word`; NULL: none is near. */
const char *nh_function_nearest(const char *word);
bool nh_is_named_function(nh_function f);
/* The letters that stand for the arguments of a named function: "n, x"; NULL for the others. */
const char *nh_function_arguments(nh_function f);
/* How many of its first arguments must be constant: derivatives with respect to orders have no closed form. */
size_t nh_function_constants(nh_function f);
/* Of an amplitude and a parameter, the last two arguments: F, E, and Pi with a number before them. */
bool nh_is_incomplete_elliptic(nh_function f);

#endif
