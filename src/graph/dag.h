/* dag: hash-consed expressions in a light canonical form.
 *
 * An expression is an index into its graph; equal indices mean equal expressions, so common subexpressions are
 * shared for free and every memo table is an array.  The form is canonical under commutativity, associativity,
 * collection of like terms and like factors, exact rational arithmetic, and the signs of odd and even functions:
 *
 *     number    exact rational p/q (64 bit) or, when inexact, a double
 *     symbol    parameter, coordinate, velocity, ...
 *     sum       c0 + c1 e1 + c2 e2 + ...         content 1, first coefficient positive
 *     product   c * b1^x1 * b2^x2 * ...          (powers and quotients too: 1/b = b^-1, sqrt(b) = b^(1/2);
 *                                                 roots of numbers are split into roots of primes)
 *     function  sin, cos, ..., atan2, pi, bessel_j, ...
 *
 * Nothing deeper is done here (no trigonometric identities, no expansion): see normal.h. */
#ifndef NH_DAG_H
#define NH_DAG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef uint32_t nh_ex; /* an expression of one graph */
typedef struct nh_dag nh_dag;

typedef enum { NH_NUMBER, NH_SYMBOL, NH_SUM, NH_PRODUCT, NH_FUNCTION } nh_kind;

/* Elementary functions of one argument, which have the names of the C library: identifier, name, parity (-1 odd, 1
 * even, 0 neither), values at 0 and at 1 where these are whole numbers (-1: no such rule).  Their evaluation at a point
 * and in a batch, their declarations in machine code and the lists in messages are made from these rows. */
#define NH_ELEMENTARY_TABLE(X)   \
    X(SIN, sin, -1, 0, -1)       \
    X(COS, cos, 1, 1, -1)        \
    X(TAN, tan, -1, 0, -1)       \
    X(ASIN, asin, -1, 0, -1)     \
    X(ACOS, acos, 0, -1, 0)      \
    X(ATAN, atan, -1, 0, -1)     \
    X(SINH, sinh, -1, 0, -1)     \
    X(COSH, cosh, 1, 1, -1)      \
    X(TANH, tanh, -1, 0, -1)     \
    X(ASINH, asinh, -1, 0, -1)   \
    X(ACOSH, acosh, 0, -1, 0)    \
    X(ATANH, atanh, -1, 0, -1)   \
    X(EXP, exp, 0, 1, -1)        \
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
    NH_FUNCTION_COUNT
} nh_function;
#undef X

enum { NH_MOST_ARGUMENTS = 4 }; /* of a function */

/* An exact rational p/q with q > 0 in lowest terms; or (q == NH_LONG) one too long for 64 bits, which num_long.h keeps
 * under the index p, with d the nearest double; or (q == 0) the double d. */
typedef struct {
    int64_t p, q;
    double d;
} nh_num;

enum { NH_LONG = -1 };

nh_num nh_num_int(int64_t value);
nh_num nh_num_ratio(int64_t p, int64_t q);
nh_num nh_num_real(double value); /* exact when the double is a whole number below 2^53 */
/* The shortest decimal that rounds to the double: 0.1 is 1/10; or, where that has 14 digits or more, a ratio with a
   denominator up to 1000 that does: 1/3. */
nh_num nh_num_decimal(double value);
nh_num nh_num_add(nh_num a, nh_num b);
nh_num nh_num_mul(nh_num a, nh_num b);
nh_num nh_num_inv(nh_num a); /* of the rational 0: not-a-number */
nh_num nh_num_pow(nh_num a, int64_t n);
double nh_num_value(nh_num a);
static inline bool nh_num_is(nh_num a, int64_t p) { return a.q == 1 && a.p == p; }
bool nh_num_exact(nh_num a); /* is it a rational? */
/* is it a rational of 64 bits?  Then p and q can be used */
static inline bool nh_num_short(nh_num a) { return a.q > 0; }
bool nh_num_equal(nh_num a, nh_num b);
int64_t nh_gcd(int64_t a, int64_t b); /* not negative; the arguments are not INT64_MIN, as no p or q of a number is */

/* A graph with the numbers 0 and 1; nh_dag_free frees it with all its nodes. */
nh_dag *nh_dag_create(void);
/* A graph with the same expressions under the same numbers, in which other ones can be made without a change of `dag`:
 * so threads derive further expressions at the same time, each in a copy.  `dag` has to outlive it; the caller frees
 * it. */
nh_dag *nh_dag_copy(const nh_dag *dag);
/* Replaces n expressions of a copy of `dag` by the same ones in `dag`.  Symbols that were made in the copy are new
 * ones. */
void nh_dag_bring(nh_dag *dag, const nh_dag *copy, size_t n, nh_ex *e);
void nh_dag_free(nh_dag *dag);
size_t nh_dag_size(const nh_dag *dag); /* number of nodes made so far; indices are below it */

/* Constructors.  Equal results have equal indices; the graph owns all nodes until nh_dag_free. */
nh_ex nh_number(nh_dag *dag, nh_num value);
nh_ex nh_int(nh_dag *dag, int64_t value);
nh_ex nh_ratio(nh_dag *dag, int64_t p, int64_t q);
nh_ex nh_real(nh_dag *dag, double value);
nh_ex nh_symbol(nh_dag *dag, const char *name); /* the symbol of that name, made when new */
/* A symbol of its own that prints as `name` but is not found by that name (implicit velocities, names of currents). */
nh_ex nh_symbol_fresh(nh_dag *dag, const char *name);
bool nh_symbol_find(const nh_dag *dag, const char *name, nh_ex *out);
nh_ex nh_add(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_sub(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_mul(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_div(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_neg(nh_dag *dag, nh_ex a);
nh_ex nh_pow(nh_dag *dag, nh_ex base, nh_ex exponent);
nh_ex nh_powi(nh_dag *dag, nh_ex base, int64_t exponent);
nh_ex nh_sqrt(nh_dag *dag, nh_ex a);
nh_ex nh_call(nh_dag *dag, nh_function f, nh_ex a);
nh_ex nh_call2(nh_dag *dag, nh_function f, nh_ex a, nh_ex b);
nh_ex nh_call_any(nh_dag *dag, nh_function f, const nh_ex *argument); /* with nh_function_arity(f) arguments */
nh_ex nh_pi(nh_dag *dag);
/* Is it tan((2 k + 1) pi/2), which has no value, but whose reciprocal is 0? */
bool nh_is_infinite_tangent(nh_dag *dag, nh_ex e);
/* Is a = rest + c pi, where sin(c pi) and cos(c pi) are numbers or half a root? */
bool nh_split_turn(nh_dag *dag, nh_ex a, nh_ex *rest, nh_ex *sine, nh_ex *cosine);
/* sum_i coefficient[i] * term[i] */
nh_ex nh_linear(nh_dag *dag, size_t n, const nh_num *coefficient, const nh_ex *term);
nh_ex nh_product(nh_dag *dag, size_t n, const nh_ex *factor);

/* The nodes of a graph, for the functions below, which are called so often that they are inline. */
typedef struct {
    uint8_t kind, op; /* op: the function */
    uint32_t count, first; /* arguments: arg[first .. first+count-1] */
    uint32_t next;    /* hash chain: index + 1 */
    uint64_t hash, mask;
} nh_node;

typedef struct {
    nh_node *node;
    uint32_t *arg; /* sums: constant, term, coefficient, ...; products: coefficient, base, exponent, ... */
} nh_dag_nodes; /* a graph begins with it */

static inline const nh_node *nh_node_of(const nh_dag *dag, nh_ex e) { return ((const nh_dag_nodes *)dag)->node + e; }

/* The i-th of its arguments. */
static inline nh_ex nh_argument_of(const nh_dag *dag, nh_ex e, size_t i)
{
    const nh_dag_nodes *all = (const nh_dag_nodes *)dag;
    return all->arg[all->node[e].first + i];
}

/* Properties of a node. */
static inline nh_kind nh_kind_of(const nh_dag *dag, nh_ex e) { return (nh_kind)nh_node_of(dag, e)->kind; }

/* Of a number. */
static inline nh_num nh_number_of(const nh_dag *dag, nh_ex e)
{
    const uint32_t *word = ((const nh_dag_nodes *)dag)->arg + nh_node_of(dag, e)->first;
    nh_num value;
    memcpy(&value.p, word, 8);
    memcpy(&value.q, word + 2, 8);
    memcpy(&value.d, word + 4, 8);
    return value;
}

const char *nh_name_of(const nh_dag *dag, nh_ex e); /* of a symbol */

/* Of a function. */
static inline nh_function nh_function_of(const nh_dag *dag, nh_ex e) { return (nh_function)nh_node_of(dag, e)->op; }

/* Sum: number of terms besides the constant; product: number of factors; function: number of arguments. */
static inline size_t nh_arity(const nh_dag *dag, nh_ex e)
{
    const nh_node *n = nh_node_of(dag, e);
    if (n->kind == NH_FUNCTION) return n->count;
    return n->kind == NH_SUM || n->kind == NH_PRODUCT ? n->count / 2 : 0;
}

/* The constant of a sum, the coefficient of a product. */
static inline nh_num nh_constant_of(const nh_dag *dag, nh_ex e)
{
    return nh_number_of(dag, nh_argument_of(dag, e, 0));
}

/* Term, base of a factor, or argument. */
static inline nh_ex nh_child(const nh_dag *dag, nh_ex e, size_t i)
{
    return nh_argument_of(dag, e, nh_kind_of(dag, e) == NH_FUNCTION ? i : 1 + 2 * i);
}

/* Of the i-th term of a sum. */
static inline nh_num nh_coefficient_of(const nh_dag *dag, nh_ex e, size_t i)
{
    return nh_number_of(dag, nh_argument_of(dag, e, 2 + 2 * i));
}

/* Of the i-th factor of a product. */
static inline nh_ex nh_exponent_of(const nh_dag *dag, nh_ex e, size_t i)
{
    return nh_argument_of(dag, e, 2 + 2 * i);
}

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
/* The numbers 0 and 1 are the first nodes of every graph. */
static inline bool nh_is_zero(const nh_dag *dag, nh_ex e)
{
    (void)dag;
    return e == 0;
}
bool nh_is_number(const nh_dag *dag, nh_ex e, int64_t value);
/* Does `symbol` occur in `e`? (not through rules of implicit symbols, see diff.h) */
bool nh_depends(const nh_dag *dag, nh_ex e, nh_ex symbol);
/* Declares a list of expressions, `nh_ex *name`, which is freed where its scope ends.  It is empty, and as long as what
 * the functions below put into it. */
#define NH_LIST(name) __attribute__((cleanup(nh_nodes_free))) nh_ex *name = NULL
void nh_nodes_free(nh_ex **list);
/* All symbols that occur in e, ascending; returns their number.  *list is a list, or NULL at first; what was in it is
 * gone. */
size_t nh_symbols_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The function calls that occur in e, likewise. */
size_t nh_functions_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The products that occur in e, likewise; powers are products as well. */
size_t nh_products_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The bases of half powers likewise, each once: u of sqrt(u), of u^(-1/2), of u^(3/2). */
size_t nh_radicands_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The nodes below n expressions and these themselves, each once, ascending: children first.  The caller frees them. */
size_t nh_nodes_in(const nh_dag *dag, size_t n, const nh_ex *e, nh_ex **out);
/* Their number for one expression. */
size_t nh_node_count(const nh_dag *dag, nh_ex e);

/* e with from[i] replaced by to[i], all at once. */
nh_ex nh_substitute(nh_dag *dag, nh_ex e, size_t n, const nh_ex *from, const nh_ex *to);

/* e with every half power of `base` written in `root`: base^(p/2) becomes root^p.  For base = root^2, and root of one
   sign. */
nh_ex nh_substitute_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root);
/* The same of base^(p/(2 q)), which becomes root^(p/q), for a positive root. */
nh_ex nh_substitute_positive_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root);

#endif
