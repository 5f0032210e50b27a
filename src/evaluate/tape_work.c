/* tape_work: the memory of a tape, and the work memory of its callers. */
#include <stdlib.h>

#include "base/memory.h"
#include "evaluate/tape_internal.h"

void nh_tape_free(nh_tape *tape)
{
    if (!tape) return;
    nh_free(tape->constant);
    nh_free(tape->code);
    nh_free(tape->more);
    nh_free(tape->table);
    nh_free(tape->output);
    nh_free(tape);
}

size_t nh_tape_outputs(const nh_tape *tape) { return tape->outputs; }
size_t nh_tape_length(const nh_tape *tape) { return tape->length; }

bool nh_tape_unbound(const nh_tape *tape, nh_ex *symbol)
{
    *symbol = tape->unbound;
    return tape->has_unbound;
}

nh_tape_work *nh_tape_work_create(const nh_tape *tape)
{
    nh_tape_work *work = nh_alloc(sizeof *work);
    work->scalar = nh_alloc_array(tape->registers + 1, sizeof(double));
    work->row = nh_alloc_array(tape->registers + 1, sizeof *work->row);
    for (size_t i = 0; i < tape->constants; i++) work->scalar[tape->inputs + i] = tape->constant[i];
    work->batch = NULL; /* allocated at the first batch: many tapes are only evaluated at single points */
    return work;
}

void nh_tape_work_free(nh_tape_work *work)
{
    if (!work) return;
    free(work->batch);
    nh_free(work->scalar);
    nh_free(work->row);
    nh_free(work);
}

void nh_tape_constants(nh_dag *dag, size_t n, const nh_ex *e, size_t n_fixed, const nh_ex *fixed, const double *value,
                       double *out)
{
    nh_tape *tape = nh_tape_create(dag, 0, NULL, n, e, n_fixed, fixed, value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, NULL, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}
