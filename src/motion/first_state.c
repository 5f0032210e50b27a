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
    if (!depends_on_time(o)) z[0] = 0;
    memcpy(given, z, o->width * sizeof *given);
    round_point(o, z);
    bool good = velocities_at(o, z, v);
    if (!good) {
        memcpy(z, given, o->width * sizeof *given);
        good = velocities_at(o, z, v);
    }
    nh_free(given);
    return good;
}
