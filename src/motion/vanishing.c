#include "motion/vanishing.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "graph/terms.h"

enum { most_probes = 4, disturbed_times = 4 };
static const double disturbance = 4; /* roundings of each state */
static const double above = 32;      /* larger multiples of the effect of these are not rounding */
/* roundings so many times larger change a well-conditioned value at least by this factor more; tan(pi/2) they do not */
static const double more = 1e6, linear = 1e4;
static const double cancelled = 1e-12; /* part of the terms of a sum: a smaller value counts as zero */

struct nh_vanishing {
    const nh_model *model;
    nh_dynamics *dynamics; /* for implicit velocities */
    nh_tape *tape;         /* rates of (q, w), then the quantities */
    nh_tape_work *work;
    size_t states, rows, outputs;
    size_t *first; /* per row of outputs: the row itself, then its terms; rows + 1 entries */
    double *z, *moved, *point, *value, *other, *rounding, *coarse;
    bool *fixed;
};

/* Every row with its terms, for the tape. */
static void make_tape(nh_vanishing *v, const nh_ex *e)
{
    const nh_model *model = v->model;
    nh_ex **terms = nh_alloc_array(v->rows + 1, sizeof *terms);
    for (size_t i = 0; i < v->rows; i++) {
        nh_ex row = i < model->m ? model->rho[i] : i < v->states ? model->a[i - model->m] : e[i - v->states];
        v->first[i + 1] = v->first[i] + nh_terms_of(model->dag, row, &terms[i]);
    }
    v->outputs = v->first[v->rows];
    nh_ex *all = nh_alloc_array(v->outputs + 1, sizeof *all);
    for (size_t i = 0; i < v->rows; i++) {
        memcpy(all + v->first[i], terms[i], (v->first[i + 1] - v->first[i]) * sizeof *all);
        nh_free(terms[i]);
    }
    v->tape = nh_model_tape(model, v->outputs, all);
    v->work = nh_tape_work_create(v->tape);
    nh_free(all);
    nh_free(terms);
}

nh_vanishing *nh_vanishing_create(const nh_model *model, size_t n, const nh_ex *e)
{
    nh_vanishing *v = nh_alloc(sizeof *v);
    *v = (nh_vanishing){.model = model,
                        .dynamics = nh_dynamics_create(model),
                        .states = model->m + model->n,
                        .rows = model->m + model->n + n};
    v->first = nh_alloc_array(v->rows + 1, sizeof *v->first);
    make_tape(v, e);
    v->z = nh_alloc_array(2 * v->states + model->width + 2 * v->outputs + 2 * v->rows, sizeof *v->z);
    v->moved = v->z + v->states;
    v->point = v->moved + v->states;
    v->value = v->point + model->width;
    v->other = v->value + v->outputs;
    v->rounding = v->other + v->outputs;
    v->coarse = v->rounding + v->rows;
    v->fixed = nh_alloc_array(v->states + 1, sizeof *v->fixed);
    return v;
}

void nh_vanishing_free(nh_vanishing *v)
{
    if (!v) return;
    nh_tape_work_free(v->work);
    nh_tape_free(v->tape);
    nh_dynamics_free(v->dynamics);
    nh_free(v->z);
    nh_free(v->first);
    nh_free(v->fixed);
    nh_free(v);
}

static bool values_at(nh_vanishing *v, double t, const double *z, double *value)
{
    if (!nh_dynamics_point(v->dynamics, t, z, v->point)) return false;
    nh_tape_eval(v->tape, v->work, v->point, value);
    return true;
}

/* The largest changes of the rows when each state changes by the relative part `part`. */
static bool disturb(nh_vanishing *v, double t, double part, double *change)
{
    uint64_t random = 0x2545f4914f6cdd1du;
    memset(change, 0, v->rows * sizeof *change);
    for (int k = 0; k < disturbed_times; k++) {
        for (size_t i = 0; i < v->states; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            v->moved[i] = v->z[i] * (1 + (random >> 63 ? part : -part));
        }
        if (!values_at(v, t, v->moved, v->other)) return false;
        for (size_t i = 0; i < v->rows; i++)
            change[i] = fmax(change[i], fabs(v->other[v->first[i]] - v->value[v->first[i]]));
    }
    return true;
}

/* All rows at z, and the effect of rounding of each state on them. */
static bool measure(nh_vanishing *v, double t)
{
    double part = disturbance * DBL_EPSILON;
    return values_at(v, t, v->z, v->value) && disturb(v, t, part, v->rounding) && disturb(v, t, more * part, v->coarse);
}

/* False also for NAN. */
static bool is_zero(const nh_vanishing *v, size_t row)
{
    double size = 0, value = fabs(v->value[v->first[row]]);
    if (value == 0 && v->rounding[row] == 0) return true;
    for (size_t i = v->first[row]; i < v->first[row + 1]; i++) size = fmax(size, fabs(v->value[i]));
    return value <= above * v->rounding[row] &&
           (v->coarse[row] >= linear * v->rounding[row] || v->rounding[row] <= cancelled * size);
}

/* At probe number `index`, with the fixed states at their initial values; false: the rows cannot be evaluated there. */
static bool go_to_probe(nh_vanishing *v, size_t index, const double *start)
{
    const nh_chart *c = v->model->chart;
    const double *probe = c->probe + index * c->width;
    for (size_t i = 0; i < v->states; i++) v->z[i] = v->fixed[i] ? start[i] : probe[1 + i];
    return measure(v, probe[0]);
}

void nh_vanishing_test(nh_vanishing *v, const double *start, bool *zero)
{
    size_t probes = v->model->chart->probes < most_probes ? v->model->chart->probes : most_probes,
           n = v->rows - v->states;
    for (size_t i = 0; i < v->states; i++) v->fixed[i] = true;
    for (bool again = true; again;) {
        again = false;
        for (size_t p = 0; p < probes; p++) {
            bool good = go_to_probe(v, p, start);
            for (size_t i = 0; i < v->states; i++) {
                if (!v->fixed[i] || (good && is_zero(v, i))) continue;
                v->fixed[i] = false;
                again = true;
            }
        }
    }
    for (size_t k = 0; k < n; k++) zero[k] = probes > 0;
    for (size_t p = 0; p < probes; p++) {
        bool good = go_to_probe(v, p, start);
        for (size_t k = 0; k < n; k++) zero[k] = zero[k] && good && is_zero(v, v->states + k);
    }
}
