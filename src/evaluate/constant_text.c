#include "evaluate/constant_text.h"

#include <math.h>

#include "base/text.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/parse.h"

static bool no_name(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)context, (void)name, (void)out, (void)fault;
    return false;
}

bool nh_constant_text(const char *text, double *out)
{
    if (nh_text_to_ratio(text, out)) return true;
    nh_dag *dag = nh_dag_create();
    nh_ex e;
    nh_parse_fault fault;
    double value = NAN;
    if (nh_parse(dag, text, no_name, NULL, &e, &fault)) {
        nh_tape *tape = nh_tape_create(dag, 0, NULL, 1, &e, 0, NULL, NULL);
        nh_tape_work *work = nh_tape_work_create(tape);
        nh_tape_eval(tape, work, NULL, &value);
        nh_tape_work_free(work);
        nh_tape_free(tape);
    }
    nh_dag_free(dag);
    if (isfinite(value)) *out = value;
    return isfinite(value);
}
