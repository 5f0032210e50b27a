#include "motion/integrators.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/diff.h"

typedef struct {
    nh_tape *tape;
    nh_tape_work *work;
    double *out;
} program;

struct nh_programs {
    const nh_model *model;
    program program[NH_PROGRAMS];
    double *point;
    long evaluations;
    size_t compiled;
};

nh_programs *nh_programs_create(const nh_model *model)
{
    nh_programs *s = nh_alloc(sizeof *s);
    *s = (nh_programs){.model = model, .point = nh_alloc_array(model->width, sizeof *s->point)};
    return s;
}

void nh_programs_free(nh_programs *s)
{
    if (!s) return;
    for (int i = 0; i < NH_PROGRAMS; i++) {
        nh_tape_work_free(s->program[i].work);
        nh_tape_free(s->program[i].tape);
        nh_free(s->program[i].out);
    }
    nh_free(s->point);
    nh_free(s);
}

const nh_model *nh_programs_model(const nh_programs *s) { return s->model; }
long nh_programs_evaluations(const nh_programs *s) { return s->evaluations; }
size_t nh_programs_compiled(const nh_programs *s) { return s->compiled; }

/* ---- the functions ---- */

/* e (count) and its derivatives by z, column-major, after them. */
static void with_derivatives(const nh_model *model, size_t count, const nh_ex *e, nh_ex *derivative)
{
    for (size_t j = 0; j < model->m + model->n; j++)
        for (size_t i = 0; i < count; i++)
            derivative[i + j * count] = nh_diff(model->dag, e[i], model->chart->symbol[1 + j]);
}

static void momentum(const nh_model *model, nh_ex *e)
{
    size_t m = model->m, n = model->n;
    memcpy(e, model->rho, m * sizeof *e);
    memcpy(e + m, model->p, m * sizeof *e);
    for (size_t s = 0; s < m; s++) {
        const nh_coordinate *q = &model->system->coordinate[s];
        e[2 * m + s] = nh_model_compose(
            model, nh_add(model->dag, nh_diff(model->dag, model->system->lagrangian, q->q), model->system->force[s]));
    }
    memcpy(e + 3 * m, model->R, m * n * sizeof *e);
    with_derivatives(model, 3 * m, e, e + 3 * m + m * n);
}

/* Returns the number of outputs, and writes them to e unless that is NULL. */
static size_t outputs(const nh_model *model, nh_program which, nh_ex *e)
{
    size_t m = model->m, n = model->n, size = m + n;
    switch (which) {
    case NH_PROGRAM_RATE:
    case NH_PROGRAM_FLOW:
        if (e) memcpy(e, model->rho, m * sizeof *e);
        if (e) memcpy(e + m, model->a, n * sizeof *e);
        if (e && which == NH_PROGRAM_FLOW) with_derivatives(model, size, e, e + size);
        return which == NH_PROGRAM_FLOW ? size + size * size : size;
    case NH_PROGRAM_MOMENTUM:
        if (e) momentum(model, e);
        return 3 * m + m * n + 3 * m * size;
    case NH_PROGRAM_PAIR:
        if (e) memcpy(e, model->R, m * n * sizeof *e);
        if (e) memcpy(e + m * n, model->M, n * n * sizeof *e);
        if (e) memcpy(e + m * n + n * n, nh_model_G(model), n * n * sizeof *e);
        return m * n + 2 * n * n;
    default:
        if (e) with_derivatives(model, 1, &model->E, e);
        if (e) e[size] = model->E, e[size + 1] = nh_model_gamma(model, model->E);
        return size + 2;
    }
}

static void compile(nh_programs *s, nh_program which)
{
    const nh_model *model = s->model;
    size_t count = outputs(model, which, NULL);
    nh_ex *e = nh_alloc_array(count + 1, sizeof *e);
    outputs(model, which, e);
    program *p = &s->program[which];
    p->tape = nh_model_tape(model, count, e);
    p->work = nh_tape_work_create(p->tape);
    p->out = nh_alloc_array(count + 1, sizeof *p->out);
    s->compiled++;
    nh_free(e);
}

const double *nh_programs_at(nh_programs *s, nh_program which, double t, const double *z)
{
    program *p = &s->program[which];
    if (!p->tape) compile(s, which);
    s->point[0] = t;
    memcpy(s->point + 1, z, (s->model->m + s->model->n) * sizeof *z);
    nh_tape_eval(p->tape, p->work, s->point, p->out);
    s->evaluations++;
    return p->out;
}

bool nh_programs_rate(double t, const double *z, double *rate, void *programs)
{
    nh_programs *s = programs;
    size_t size = s->model->m + s->model->n;
    memcpy(rate, nh_programs_at(s, NH_PROGRAM_RATE, t, z), size * sizeof *rate);
    return nh_all_finite(size, rate);
}

const nh_tape *nh_programs_tape(nh_programs *s, nh_program which)
{
    if (!s->program[which].tape) compile(s, which);
    return s->program[which].tape;
}

double nh_programs_pace(const nh_model *model, const double *f)
{
    double most = 0;
    for (size_t j = 0; j < model->m + model->n; j++) {
        double reach = fmax(fabs(model->chart->low[1 + j]), fabs(model->chart->high[1 + j]));
        if (reach > 0 && isfinite(reach)) most = fmax(most, fabs(f[j]) / reach);
    }
    return most;
}
