/* benchmark_reduced: the motion of the benchmark in the reduced equations of every stage of the system's reduction
 * (reduce.h): z = (x, p).
 *
 * Reduced states are not functions of the full ones where the slice's coordinates are not invariant, so that errors are
 * those of (x, p), against a reference of their own.  The reduction itself has compared the reconstructed motion with
 * the full one. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/benchmark_internal.h"
#include "commands/reduce.h"

enum { least_budget = 1 }; /* seconds: finding the group may take as long */
static const double same_motion = 1e-6;
static const char *const methods[] = {"GSL rk8pd", "CVODE Adams", "CVODE BDF"};

/* "q1=..., q1'=..., ": the chart's initial state as text. */
static const char *initial_words(const nh_benchmark_work *c)
{
    const nh_system *system = c->model->system;
    const double *y = c->formulation[c->formulations - 1].z0; /* (q, v) */
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < system->coordinates; i++)
        nh_text_addf(&text, "%s%s=%.17g", i ? ", " : "", system->coordinate[i].name, y[i]);
    for (size_t i = 0; i < system->coordinates; i++)
        nh_text_addf(&text, ", %s'=%.17g", system->coordinate[i].name, y[system->coordinates + i]);
    const char *kept = nh_arena_strdup(c->out->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return kept;
}

static nh_reduction *reduce(const nh_benchmark_work *c, const nh_request *q, nh_error *error)
{
    const nh_analysis_file *a = c->out->question->analysis;
    size_t count = a ? a->settings : 0;
    nh_setting *setting = nh_arena_alloc(c->out->arena, (count + q->settings + 1) * sizeof *setting);
    if (count) memcpy(setting, a->setting, count * sizeof *setting);
    if (q->settings) memcpy(setting + count, q->setting, q->settings * sizeof *setting);
    nh_request r = *q;
    r.settings += count, r.setting = setting;
    r.initial = initial_words(c), r.project = true;
    r.accuracy = 0;
    r.options.until = c->out->end - c->out->begin;
    nh_deadline_set(c->budget);
    nh_reduction *out = nh_reduction_create(&r, error);
    nh_deadline_set(INFINITY);
    return out;
}

/* Computes a reference by two methods in (x, p); returns why they are no reference, or NULL. */
static const char *own_reference(nh_benchmark_work *c, nh_formulation *f)
{
    static const struct {
        const char *method;
        double tolerance;
    } two[2] = {{"GSL rk8pd", 1e-14}, {"CVODE Adams", 1e-13}};
    size_t size = NH_BENCHMARK_OUTPUTS * f->size;
    f->reference = nh_arena_alloc(c->out->arena, (size + f->size + 1) * sizeof *f->reference);
    f->reference_scale = f->reference + size;
    f->agreement = INFINITY;
    for (int i = 0; i < 2; i++) {
        nh_error ignored;
        nh_error_clear(&ignored);
        nh_flow_options how = {
            .rtol = two[i].tolerance, .scale = f->scale, .max_steps = 1e6, .effort = 1e9 * c->budget / 4};
        nh_motion *motion = nh_method_flow(nh_method_find(two[i].method), &f->problem, f->z0, NH_BENCHMARK_OUTPUTS,
                                           c->solution.times, &how, &ignored);
        bool good = motion && motion->complete;
        const char *why =
            good ? NULL
                 : nh_arena_printf(c->out->arena,
                                   "its motion does not reach the end in one chart of the reduced equations: %s",
                                   motion ? motion->note : ignored.what);
        if (good && i == 0) {
            memcpy(f->reference, motion->state, size * sizeof *f->reference);
            for (size_t j = 0; j < f->size; j++) f->reference_scale[j] = f->scale[j];
            for (size_t k = 0; k < size; k++)
                f->reference_scale[k % f->size] = fmax(f->reference_scale[k % f->size], fabs(motion->state[k]));
        } else if (good) {
            f->agreement = nh_reduced_error(f, motion);
        }
        nh_motion_free(motion);
        if (!good) return why;
    }
    return f->agreement < same_motion
               ? NULL
               : nh_arena_printf(c->out->arena, "two methods agree on its motion to %.0e only", f->agreement);
}

double nh_reduced_error(const nh_formulation *f, const nh_motion *motion)
{
    double worst = 0;
    for (size_t k = 0; k < motion->count * f->size; k++) {
        double e = fabs(motion->state[k] - f->reference[k]) / f->reference_scale[k % f->size];
        if (!(e <= worst)) worst = isfinite(e) ? e : INFINITY;
    }
    return worst;
}

double nh_reduced_drift(nh_formulation *f, const nh_motion *motion)
{
    double start = 0, e, worst = 0, size = DBL_MIN;
    for (size_t i = 0; i < motion->count; i++) {
        if (!nh_reduced_flow_at(f->reduced, motion->state + i * motion->size, NULL, NULL, NULL, &e)) return NAN;
        if (i == 0) start = e;
        size = fmax(size, fabs(e));
        worst = fmax(worst, fabs(e - start));
    }
    return worst / size;
}

/* Names the formulation: "reduced by SE(2), 2 states", "reduced again by R, 3 states", "reduced on momentum levels by
 * R, 4 states".  Returns why the stage cannot be used, or NULL. */
static const char *open_stage(nh_benchmark_work *c, const nh_reduction_stage *s)
{
    nh_formulation *f = &c->formulation[c->formulations];
    *f = (nh_formulation){.reduced = nh_reduced_flow_create(s->reduced)};
    f->problem = nh_reduced_flow_problem(f->reduced);
    f->size = f->problem.size;
    const char *again = s->kind != NH_STAGE_SECOND ? "" : s->second->first->d ? "again " : "on momentum levels ";
    f->name = nh_arena_printf(c->out->arena, "reduced %sby %s, %zu state%s", again, s->group, f->size,
                              f->size == 1 ? "" : "s");
    f->z0 = nh_arena_alloc(c->out->arena, (2 * f->size + 1) * sizeof *f->z0);
    f->scale = f->z0 + f->size;
    for (size_t i = 0; i < f->size; i++) f->z0[i] = s->start[i], f->scale[i] = c->absolute;
    c->formulations++;
    return f->size > 0 ? own_reference(c, f) : "no state is left";
}

void nh_benchmark_reduced(nh_benchmark_work *c, const nh_request *q)
{
    nh_error error;
    nh_error_clear(&error);
    if (c->budget < least_budget) return;
    c->reduction = reduce(c, q, &error);
    const nh_reduction *r = c->reduction;
    if (!r || !r->stages) {
        nh_benchmark_work_refuse(c, "reduced equations",
                                 !r            ? error.what
                                 : r->warnings ? r->warning[0]
                                               : "no symmetry was found that can be divided out");
        return;
    }
    for (size_t i = 0; i < r->stages && c->formulations < NH_BENCHMARK_FORMULATIONS + NH_CHART_REDUCED; i++) {
        const nh_reduction_stage *s = &r->stage[i];
        const char *name = nh_arena_printf(c->out->arena, "reduced by %s", s->group), *why;
        if (!s->start || !s->compared)
            nh_benchmark_work_refuse(c, name,
                                     s->note[0] ? s->note : "its motion could not be compared with the full one");
        else if (!(s->agreement < same_motion))
            nh_benchmark_work_refuse(
                c, name, nh_arena_printf(c->out->arena, "its motion differs from the full one by %.0e", s->agreement));
        else if (!s->reduced->conservative)
            nh_benchmark_work_refuse(
                c, name, "with forces, or a constraint that does work, its energy says nothing about its error");
        else if ((why = open_stage(c, s))) nh_benchmark_work_refuse(c, name, why);
        else
            for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
                nh_benchmark_work_add(c, nh_method_find(methods[k]), c->formulations - 1);
    }
}
