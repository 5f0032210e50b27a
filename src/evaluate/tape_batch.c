/* tape_batch: one instruction over many points, in loops that the compiler vectorises.
 *
 * glibc's libmvec has vector versions of the elementary functions.  GCC uses them when the prototypes carry the `simd`
 * attribute, which avoids -ffast-math (that would also remove nan and inf from this file).
 *
 * Arithmetic is compiled for several instruction sets, all of which round alike.  For functions this is not so:
 * libmvec's versions for vectors of two, four and eight differ in the last digits.  So functions are computed four at a
 * time wherever possible, in every build: an answer must not depend on the machine. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clones.h"
#include "base/effort.h"
#include "base/memory.h"
#include "evaluate/named_value.h"
#include "evaluate/tape_internal.h"
#include "graph/function.h"

#if defined __x86_64__ && defined __GNUC__ && !defined __clang__
#define FOURS __attribute__((target("avx2")))
#define HAS_FOURS (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
#else
#define FOURS
#define HAS_FOURS false
#endif

/* A sanitizer's check of every access would keep the loops from being vectorised. */
#if defined __GNUC__ && !defined __clang__
#define UNCHECKED __attribute__((no_sanitize("address", "undefined")))
#else
#define UNCHECKED
#endif

#if defined __x86_64__ && defined __GNUC__
#define VECTOR __attribute__((simd("notinbranch")))
extern VECTOR double sin(double);
extern VECTOR double cos(double);
extern VECTOR double tan(double);
extern VECTOR double asin(double);
extern VECTOR double acos(double);
extern VECTOR double atan(double);
extern VECTOR double sinh(double);
extern VECTOR double cosh(double);
extern VECTOR double tanh(double);
extern VECTOR double asinh(double);
extern VECTOR double acosh(double);
extern VECTOR double atanh(double);
extern VECTOR double exp(double);
extern VECTOR double log(double);
extern VECTOR double pow(double, double);
extern VECTOR double atan2(double, double);
#endif

static const double in_batch = 0.25; /* effort of a batch per point, as a part of that of a single evaluation */

/* Points are computed in whole blocks, the widest vector of doubles: no loop has a remainder. */
enum { BLOCK = 8 };

#define LOOP(formula)                                                                                                  \
    {                                                                                                                  \
        (void)b;                                                                                                       \
        n &= ~(size_t)(BLOCK - 1);                                                                                     \
        for (size_t i = 0; i < n; i++) to[i] = (formula);                                                              \
    }
#define ARGUMENTS size_t n, double *restrict to, const double *a, const double *b

#define KERNEL(name, formula) NH_CLONES UNCHECKED static void name(ARGUMENTS) LOOP(formula)

#define FUNCTION(name, formula)                                                                                        \
    FOURS UNCHECKED static void name##_by_fours(ARGUMENTS) LOOP(formula)                                               \
        UNCHECKED static void name##_otherwise(ARGUMENTS) LOOP(formula) static void                                    \
        name(ARGUMENTS)                                                                                                \
    {                                                                                                                  \
        (HAS_FOURS ? name##_by_fours : name##_otherwise)(n, to, a, b);                                                 \
    }

KERNEL(k_add, a[i] + b[i])
KERNEL(k_sub, a[i] - b[i])
KERNEL(k_mul, a[i] * b[i])
KERNEL(k_div, a[i] / b[i])
KERNEL(k_neg, -a[i])
KERNEL(k_inv, 1 / a[i])
KERNEL(k_square, a[i] * a[i])
KERNEL(k_sqrt, sqrt(a[i]))
FUNCTION(k_pow, pow(a[i], b[i]))
#define X(id, name, parity, at_zero, at_one) FUNCTION(k_##name, name(a[i]))
NH_ELEMENTARY_TABLE(X)
#undef X
KERNEL(k_abs, fabs(a[i]))
KERNEL(k_sign, a[i] > 0 ? 1 : a[i] < 0 ? -1 : a[i])
FUNCTION(k_atan2, atan2(a[i], b[i]))

typedef void kernel(size_t n, double *restrict to, const double *a, const double *b);

#define X(id, name, parity, at_zero, at_one) [NH_OP_FUNCTION + NH_##id] = k_##name,
static kernel *const table[] = {
    [NH_OP_ADD] = k_add,
    [NH_OP_SUB] = k_sub,
    [NH_OP_MUL] = k_mul,
    [NH_OP_DIV] = k_div,
    [NH_OP_NEG] = k_neg,
    [NH_OP_INV] = k_inv,
    [NH_OP_SQUARE] = k_square,
    [NH_OP_SQRT] = k_sqrt,
    [NH_OP_POW] = k_pow,
    NH_ELEMENTARY_TABLE(X)[NH_OP_FUNCTION + NH_ABS] = k_abs,
    [NH_OP_FUNCTION + NH_SIGN] = k_sign,
    [NH_OP_FUNCTION + NH_ATAN2] = k_atan2,
};
#undef X

/* Rows of this work memory: inputs are copied there, so that a short batch can be padded to whole blocks with copies of
 * its first point. */
static void prepare(const nh_tape *tape, nh_tape_work *work)
{
    size_t bytes = (tape->registers + 1) * NH_BATCH * sizeof(double);
    work->batch = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!work->batch) work->batch = nh_alloc(SIZE_MAX); /* lets the memory handler decide */
    for (size_t i = 0; i < tape->registers; i++) work->row[i] = work->batch + i * NH_BATCH;
    for (size_t i = 0; i < tape->constants; i++)
        for (size_t p = 0; p < NH_BATCH; p++) work->row[tape->inputs + i][p] = tape->constant[i];
}

/* Points of padding get the value of the first point. */
static void named(const nh_tape *tape, const nh_instruction *x, double **row, size_t count, size_t padded)
{
    const double *third = x->more ? row[tape->more[x->more - 1].c] : row[x->a],
                 *fourth = x->more ? row[tape->more[x->more - 1].d] : row[x->a];
    for (size_t p = 0; p < count; p++) {
        const double argument[NH_MOST_ARGUMENTS] = {row[x->a][p], row[x->b][p], third[p], fourth[p]};
        row[x->to][p] = nh_tape_named(tape->table, x->op, argument);
    }
    for (size_t p = count; p < padded; p++) row[x->to][p] = row[x->to][0];
}

void nh_tape_eval_batch(const nh_tape *tape, nh_tape_work *work, size_t count, const double *const *in,
                        double *const *out)
{
    if (count == 0) return;
    nh_effort_add(in_batch * tape->effort * (double)count);
    if (!work->batch) prepare(tape, work);
    double **row = work->row;
    size_t padded = (count + BLOCK - 1) / BLOCK * BLOCK;
    for (size_t j = 0; j < tape->inputs; j++) {
        memcpy(row[j], in[j], count * sizeof(double));
        for (size_t p = count; p < padded; p++) row[j][p] = in[j][0];
    }
    for (const nh_instruction *x = tape->code, *end = x + tape->length; x < end; x++) {
        if (nh_op_is_named(x->op)) named(tape, x, row, count, padded);
        else table[x->op](padded, row[x->to], row[x->a], row[x->b]);
    }
    for (size_t k = 0; k < tape->outputs; k++) memcpy(out[k], row[tape->output[k]], count * sizeof(double));
}
