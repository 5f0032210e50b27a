#include "motion/first_state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/linalg.h"
#include "motion/assembly.h"

static bool depends_on_time(const nh_model *o)
{
    const nh_ex t = o->system->t;
    bool any = nh_depends(o->dag, o->Lbar, t);
    for (size_t i = 0; i < o->m; i++) any |= nh_depends(o->dag, o->rho[i], t);
    for (size_t i = 0; i < o->n; i++) any |= nh_depends(o->dag, o->a[i], t);
    return any;
}

static void round_point(const nh_model *o, double *z)
{
    enum { digits = 2 };
    nh_assembly *equations = nh_assembly_create(o);
    for (size_t i = 0; i < 1 + o->m + o->n; i++) {
        bool position = i >= 1 && i <= o->m;
        char text[32];
        snprintf(text, sizeof text, "%.*g", digits, z[i]);
        if (!position || !equations) z[i] = strtod(text, NULL);
    }
    nh_assembly_free(equations);
}

typedef struct {
    const nh_model *model;
    nh_tape *tape;
    nh_tape_work *work;
    double *a; /* n: the accelerations */
} acceleration;

static bool finite_at(acceleration *x, double *z, size_t i, double value)
{
    z[i] = value;
    bool good = nh_chart_complete(x->model->chart, z);
    nh_tape_eval(x->tape, x->work, z, x->a);
    return good && nh_all_finite(x->model->n, x->a);
}

/* A length whose zero is a pole of the equations of motion, as r = 0 of polar coordinates, becomes 1 if that is none
 * and the file gives no interval. */
static void leave_poles(const nh_model *o, double *z)
{
    nh_assembly *equations = nh_assembly_create(o);
    acceleration x = {.model = o, .tape = nh_model_tape(o, o->n, o->a), .a = nh_alloc_array(o->n + 1, sizeof *x.a)};
    x.work = nh_tape_work_create(x.tape);
    for (size_t i = 1; i <= o->m && !equations; i++) {
        const nh_coordinate *c = &o->system->coordinate[i - 1];
        double before = z[i];
        bool own = false;
        for (size_t k = 0; k < o->system->intervals; k++) own |= o->system->interval[k].symbol == c->q;
        if (c->type == NH_ANGLE || own || finite_at(&x, z, i, 0) || !finite_at(&x, z, i, 1)) z[i] = before;
    }
    nh_free(x.a);
    nh_tape_work_free(x.work);
    nh_tape_free(x.tape);
    nh_assembly_free(equations);
}

static bool velocities_at(const nh_model *o, double *z, double *v)
{
    nh_tape *tape = nh_model_tape(o, o->m, o->rho);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = nh_chart_complete(o->chart, z);
    nh_tape_eval(tape, work, z, v);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return good && nh_all_finite(o->m, v);
}

bool nh_first_state(const nh_model *o, double *z, double *v)
{
    double *given = nh_alloc_array(o->width + 1, sizeof *given);
    if (!depends_on_time(o) || o->system->driven) z[0] = 0;
    memcpy(given, z, o->width * sizeof *given);
    if (o->system->driven) memset(z + 1 + o->m, 0, o->n * sizeof *z);
    round_point(o, z);
    leave_poles(o, z);
    bool good = velocities_at(o, z, v);
    if (!good) {
        memcpy(z, given, o->width * sizeof *given);
        good = velocities_at(o, z, v);
    }
    nh_free(given);
    return good;
}
