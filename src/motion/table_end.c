#include "motion/table_end.h"

#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/print.h"

/* Is the value of an argument at an edge of the nodes, where a motion of small steps ends?  Then the edge. */
static bool at_edge(size_t n, const double *node, double value, double *edge)
{
    static const double near = 1e-3; /* of the table's width */
    double width = node[n - 1] - node[0], below = value - node[0], above = node[n - 1] - value;
    *edge = below < above ? node[0] : node[n - 1];
    return fmin(below, above) < near * width;
}

/* The note of one call of a table; false: it is not there that the motion ends. */
static bool explain(const nh_model *model, nh_ex call, const double *z, nh_motion *motion)
{
    nh_dag *d = model->dag;
    const nh_spline *s = nh_declared_table(d, (size_t)nh_number_of(d, nh_child(d, call, 0)).p);
    nh_ex argument[2] = {nh_child(d, call, 2), nh_child(d, call, 3)};
    double value[2], edge;
    nh_tape *tape = nh_model_tape(model, 2, argument);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    for (size_t k = 0; k < (s->y ? 2u : 1u); k++) {
        if (!at_edge(k ? s->ny : s->nx, k ? s->y : s->x, value[k], &edge)) continue;
        size_t f = (size_t)nh_number_of(d, nh_child(d, call, 0)).p;
        char *what = nh_print_string(d, argument[k]),
             *function = nh_print_string(d, nh_declared_call_table(d, f, 0, argument[0], argument[1]));
        motion->note[0] = 0; /* that no step was small enough there */
        nh_motion_note(motion, "at t = %.10g it leaves the table of %.60s, which ends at %.60s = %.10g",
                       motion->time[motion->count - 1] < motion->end_time ? motion->end_time
                                                                          : motion->time[motion->count - 1],
                       function, what, edge);
        nh_free(function);
        nh_free(what);
        return true;
    }
    return false;
}

void nh_table_end_explain(const nh_model *model, nh_motion *motion)
{
    if (!motion || motion->complete || !motion->count || !nh_declared_has_table(model->dag)) return;
    double *z = nh_alloc_array(model->width + 1, sizeof *z);
    z[0] = motion->end_time;
    memcpy(z + 1, motion->end_state, model->m * sizeof *z);
    NH_LIST(call);
    bool said = false;
    for (size_t i = 0; i <= model->n && !said; i++) {
        size_t n = nh_functions_in(model->dag, i < model->n ? model->a[i] : model->Lbar, &call);
        for (size_t k = 0; k < n && !said; k++)
            said = nh_function_of(model->dag, call[k]) == NH_TABLE && explain(model, call[k], z, motion);
    }
    nh_free(z);
}
