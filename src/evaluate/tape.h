/* tape: expressions compiled to a straight-line program, run at one point or at many.
 *
 * Unused code is left out, common subexpressions are computed once, constant subexpressions are computed when the tape
 * is made, and registers are reused as soon as their value is no longer needed, so that a batch stays in the cache.
 * The tape is constant and may be shared by threads; each thread brings its own work memory. */
#ifndef NH_TAPE_H
#define NH_TAPE_H

#include "graph/expr.h"

enum { NH_BATCH = 256 }; /* points per batch: below 64 slow, 128 to 512 flat (docs/performance.md) */

typedef struct nh_tape nh_tape;
typedef struct nh_tape_work nh_tape_work;

/* A tape that computes the outputs `out` as functions of the symbols `in`; the symbols `fixed` have the given values.
 * The caller frees it.  A symbol that is neither makes every output that uses it not-a-number; nh_tape_unbound names
 * the first such symbol. */
nh_tape *nh_tape_create(nh_dag *dag, size_t n_in, const nh_ex *in, size_t n_out, const nh_ex *out, size_t n_fixed,
                        const nh_ex *fixed, const double *value);
void nh_tape_free(nh_tape *tape);
size_t nh_tape_outputs(const nh_tape *tape);
size_t nh_tape_length(const nh_tape *tape); /* number of instructions */
bool nh_tape_unbound(const nh_tape *tape, nh_ex *symbol);

/* Work memory of one thread for a tape, which it borrows. */
nh_tape_work *nh_tape_work_create(const nh_tape *tape);
void nh_tape_work_free(nh_tape_work *work);

/* Evaluates at one point: in[n_in], out[n_out].  An output that is undefined there is inf or nan. */
void nh_tape_eval(const nh_tape *tape, nh_tape_work *work, const double *in, double *out);

/* The values of `e`, which depend on the symbols `fixed` only: out[n]. */
void nh_tape_constants(nh_dag *dag, size_t n, const nh_ex *e, size_t n_fixed, const nh_ex *fixed, const double *value,
                       double *out);

/* Let long work at single points pass to machine code (machine.h): when the interpreter has spent `patience` times what
 * compiling will cost, the compiler is started beside it, and its code is used as soon as it is ready.  However many
 * evaluations follow, this costs at most about 1 + 1/patience times the better choice.  The results do not change.
 * Where nothing can be compiled the interpreter goes on.  patience <= 0: never. */
void nh_tape_jit(nh_tape_work *work, double patience);
/* Compiles at once and waits for the code; false: evaluation stays with the interpreter. */
bool nh_tape_compile(const nh_tape *tape, nh_tape_work *work);
/* "compiled by cc in 0.07 s", or why not; NULL when nothing was tried. */
const char *nh_tape_words(const nh_tape_work *work);

/* `count` <= NH_BATCH points: in[j][p] is input j at point p, out[k][p] likewise.  Agrees with nh_tape_eval to a few
 * units in the last place of each operation (vector mathematics of glibc). */
void nh_tape_eval_batch(const nh_tape *tape, nh_tape_work *work, size_t count, const double *const *in,
                        double *const *out);

#endif
