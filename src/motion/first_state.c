#include "motion/first_state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/linalg.h"
#include "motion/assembly.h"

static bool depends_on_time(const nh_model *model)
{
    const nh_ex t = model->system->t;
    bool any = nh_depends(model->dag, model->Lbar, t);
    for (size_t i = 0; i < model->m; i++) any |= nh_depends(model->dag, model->rho[i], t);
    for (size_t i = 0; i < model->n; i++) any |= nh_depends(model->dag, model->a[i], t);
    return any;
}

static void round_point(const nh_model *model, double *z)
{
    enum { digits = 2 };
    nh_assembly *equations = nh_assembly_create(model);
    for (size_t i = 0; i < 1 + model->m + model->n; i++) {
        bool position = i >= 1 && i <= model->m;
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
static void leave_poles(const nh_model *model, double *z)
{
    nh_assembly *equations = nh_assembly_create(model);
    acceleration x = {.model = model,
                      .tape = nh_model_tape(model, model->n, model->a),
                      .a = nh_alloc_array(model->n + 1, sizeof *x.a)};
    x.work = nh_tape_work_create(x.tape);
    for (size_t i = 1; i <= model->m && !equations; i++) {
        const nh_coordinate *c = &model->system->coordinate[i - 1];
        double before = z[i];
        bool own = false;
        for (size_t k = 0; k < model->system->intervals; k++) own |= model->system->interval[k].symbol == c->q;
        if (c->type == NH_ANGLE || own || finite_at(&x, z, i, 0) || !finite_at(&x, z, i, 1)) z[i] = before;
    }
    nh_free(x.a);
    nh_tape_work_free(x.work);
    nh_tape_free(x.tape);
    nh_assembly_free(equations);
}

static bool velocities_at(const nh_model *model, double *z, double *v)
{
    nh_tape *tape = nh_model_tape(model, model->m, model->rho);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = nh_chart_complete(model->chart, z);
    nh_tape_eval(tape, work, z, v);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return good && nh_all_finite(model->m, v);
}

bool nh_first_state(const nh_model *model, double *z, double *v)
{
    double *given = nh_alloc_array(model->width + 1, sizeof *given);
    if (!depends_on_time(model) || model->system->driven) z[0] = 0;
    memcpy(given, z, model->width * sizeof *given);
    if (model->system->driven) memset(z + 1 + model->m, 0, model->n * sizeof *z);
    round_point(model, z);
    leave_poles(model, z);
    bool good = velocities_at(model, z, v);
    if (!good) {
        memcpy(z, given, model->width * sizeof *given);
        good = velocities_at(model, z, v);
    }
    nh_free(given);
    return good;
}
