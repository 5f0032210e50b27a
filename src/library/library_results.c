/* library_results: what a caller reads of results, number by number. */
#include <math.h>

#include "base/memory.h"
#include "commands/simulate.h"
#include "document/typeset.h"
#include "evaluate/tape.h"
#include "graph/print.h"
#include "search/analysis.h"

/* ---- an analysis ---- */

const char *nh_analysis_verdict(const nh_analysis *a) { return a->verdict == NH_FOUND ? "FOUND" : a->verdict == NH_NONE ? "NONE" : "UNDECIDED"; }

const char *nh_analysis_search(const nh_analysis *a) { return nh_search_word(a->search); }

size_t nh_analysis_currents(const nh_analysis *a) { return a->count; }

size_t nh_analysis_independent(const nh_analysis *a) { return a->independent; }

size_t nh_analysis_most(const nh_analysis *a) { return a->local_maximum; }

nh_current_facts nh_current_describe(const nh_analysis *a, size_t index)
{
    if (index >= a->count) return (nh_current_facts){.name = "", .meaning = "", .digits = NAN, .drift = NAN};
    const nh_current *c = &a->found[index];
    bool followed = a->validation != NULL;
    return (nh_current_facts){.name = c->name, .meaning = c->meaning, .proved = c->proof.proved, .for_all = c->proof.all_parameters,
                              .independent = c->independence == NH_INDEPENDENT, .digits = c->proof.digits,
                              .drift = followed ? c->drift.drift[NH_DRIFT_RUNS - 1] : NAN};
}

/* In velocities where that is possible, else in the chart. */
static nh_ex shown_form(const nh_current *c) { return c->has_in_velocities ? c->in_velocities : c->phi; }

char *nh_current_formula(const nh_analysis *a, size_t index, nh_syntax syntax)
{
    if (index >= a->count) return NULL;
    char *plain = nh_print_short(a->model->dag, shown_form(&a->found[index]), a->options.written);
    if (!plain || syntax == NH_SYNTAX_PLAIN) return plain;
    nh_text text;
    nh_text_init(&text);
    bool good = nh_typeset(plain, syntax == NH_SYNTAX_LATEX ? NH_LATEX : NH_MATHML, &text);
    nh_free(plain);
    plain = good ? nh_strdup(nh_text_string(&text)) : NULL;
    nh_text_clear(&text);
    return plain;
}

double nh_current_value(const nh_analysis *a, size_t index, double t, const double *q, const double *v)
{
    if (index >= a->count || !a->found[index].has_in_velocities) return NAN;
    const nh_system *s = a->system;
    size_t m = s->coordinates;
    nh_ex  form = a->found[index].in_velocities, *in = nh_alloc_array(2 * m + 1, sizeof *in);
    double out, *value = nh_alloc_array(2 * m + 1, sizeof *value);
    in[0] = s->t;
    value[0] = t;
    for (size_t i = 0; i < m; i++) {
        in[1 + i] = s->coordinate[i].q;
        in[1 + m + i] = s->coordinate[i].v;
        value[1 + i] = q[i];
        value[1 + m + i] = v[i];
    }
    nh_tape *tape = nh_tape_create(a->model->dag, 2 * m + 1, in, 1, &form, s->parameters, a->model->parameter, a->model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, value, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
    nh_free(value);
    return isfinite(out) ? out : NAN;
}

/* ---- a simulation ---- */

static size_t drawn_from(const nh_simulation *s)
{
    size_t k = 0;
    while (k < s->columns.count && s->columns.track[k].kind != NH_TRACK_SHAPE) k++;
    return k;
}

size_t nh_simulation_rows(const nh_simulation *s) { return s->motion->count; }

size_t nh_simulation_columns(const nh_simulation *s) { return 1 + drawn_from(s); }

const char *nh_simulation_column(const nh_simulation *s, size_t column)
{
    return column == 0 ? "t" : column < nh_simulation_columns(s) ? s->columns.track[column - 1].name : NULL;
}

double nh_simulation_value(const nh_simulation *s, size_t row, size_t column)
{
    if (row >= s->motion->count || column >= nh_simulation_columns(s)) return NAN;
    return column == 0 ? s->motion->time[row] : s->value[row * s->columns.count + column - 1];
}
