/* known_motions: the closed forms that a system file knows of its motions (known: motions:), as references of the
 * benchmark.
 *
 * A closed form is a claim: it is used only where two methods that agree with each other agree with it, too; where they
 * do not agree with each other, a complete one takes the place of the second. */
#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "commands/benchmark_internal.h"
#include "graph/node.h"

static const double least_off = 1e-11; /* rounding of a closed form and of the motion that it is compared with */
/* a condition on the initial state is satisfied when left and right side differ by less */
static const double fits = 1e-9;

/* ---- reading a closed form ---- */

/* Takes the numbers that the initial state determines, and tests the conditions: false where a number has no value or a
 * condition fails. */
static bool at_the_start(const nh_benchmark_work *c, const nh_known_motion *k, double *value)
{
    const nh_model *model = c->model;
    size_t n = k->starts + k->conditions;
    nh_ex *e = nh_alloc_array(n + 1, sizeof *e);
    double *point = nh_alloc_array(model->chart->width + 1, sizeof *point);
    nh_error ignored;
    nh_error_clear(&ignored);
    bool good = nh_dynamics_point(c->formulation[0].dynamics, c->solution.times[0], c->formulation[0].z0, point);
    for (size_t i = 0; i < n && good; i++)
        good = nh_analysis_file_to_chart(model, i < k->starts ? k->start[i].value : k->condition[i - k->starts], &e[i],
                                         &ignored);
    if (good) {
        nh_tape *tape = nh_model_tape(model, n, e);
        nh_tape_work *work = nh_tape_work_create(tape);
        nh_tape_eval(tape, work, point, value);
        nh_tape_work_free(work);
        nh_tape_free(tape);
    }
    for (size_t i = k->starts; i < n && good; i++) good = fabs(value[i]) <= fits;
    nh_free(point);
    nh_free(e);
    return good;
}

/* Its coordinates, and as their derivatives by t the velocities, at the output times, into rows of 2m. */
static bool along(const nh_benchmark_work *c, const nh_known_motion *k, const double *start, double *state)
{
    const nh_model *model = c->model;
    const nh_system *system = model->system;
    size_t m = model->m, n = 0, inputs = 1 + k->starts;
    nh_ex *in = nh_alloc_array(inputs, sizeof *in), *out = nh_alloc_array(2 * m, sizeof *out);
    double *x = nh_alloc_array(inputs, sizeof *x), *value = nh_alloc_array(2 * m, sizeof *value);
    bool good = true;
    in[0] = system->t;
    if (k->starts) memcpy(in + 1, k->symbol, k->starts * sizeof *in);
    if (k->starts) memcpy(x + 1, start, k->starts * sizeof *x);
    for (size_t j = 0; j < m; j++)
        if (k->given[j]) out[n++] = k->value[j], out[n++] = nh_diff(model->dag, k->value[j], system->t);
    nh_tape *tape =
        nh_tape_create(model->dag, inputs, in, n, out, system->parameters, model->parameter, model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t i = 0; i < NH_BENCHMARK_OUTPUTS; i++) {
        x[0] = c->solution.times[i];
        nh_tape_eval(tape, work, x, value);
        for (size_t j = 0, l = 0; j < m; j++) {
            if (!k->given[j]) continue;
            good &= isfinite(value[l]) && isfinite(value[l + 1]);
            state[2 * i * m + j] = value[l++];
            state[(2 * i + 1) * m + j] = value[l++];
        }
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(value);
    nh_free(x);
    nh_free(out);
    nh_free(in);
    return good;
}

void nh_known_motions_open(nh_benchmark_work *c)
{
    nh_arena *arena = c->out->arena;
    nh_known_motion *known;
    size_t count;
    nh_error error;
    nh_error_clear(&error);
    bool good = nh_system_motions(c->model->system, &count, &known, &error);
    c->closed = nh_arena_alloc(arena, (count + 1) * sizeof *c->closed);
    if (!good) nh_benchmark_work_refuse(c, "closed forms", error.what);
    for (size_t i = 0; i < count && good; i++) {
        const nh_known_motion *k = &known[i];
        nh_known_motions *f = &c->closed[c->closed_count];
        double *start = nh_alloc_array(k->starts + k->conditions + 1, sizeof *start);
        *f = (nh_known_motions){.motion = k,
                                .state =
                                    nh_arena_alloc(arena, NH_BENCHMARK_OUTPUTS * 2 * c->model->m * sizeof *f->state),
                                .whole = k->values == c->model->m};
        bool fitting = at_the_start(c, k, start);
        if (fitting && along(c, k, start, f->state)) c->closed_count++;
        else if (fitting)
            nh_benchmark_work_refuse(c, nh_arena_printf(arena, "closed form \"%s\"", k->name),
                                     "it has no value on the way");
        nh_free(start);
    }
}

/* ---- confirming it ---- */

double nh_closed_off(nh_benchmark_work *c, const nh_known_motions *f, double *states, size_t *worst)
{
    size_t m = c->model->m;
    double *kept = c->solution.state, most = 0;
    c->solution.state = states;
    nh_reference_solution_scales(&c->solution, c->out->arena, c->formulation[0].scale[0]);
    c->solution.state = kept;
    *worst = 0;
    for (size_t i = 0; i < NH_BENCHMARK_OUTPUTS * 2 * m; i++) {
        double off = f->motion->given[i % m] ? fabs(f->state[i] - states[i]) / c->solution.scale[i % (2 * m)] : 0;
        if (!(off <= most)) most = isfinite(off) ? off : INFINITY, *worst = i;
    }
    return most;
}

/* "phi and y" */
static const char *names_of(const nh_benchmark_work *c, const nh_known_motions *f)
{
    const nh_system *system = c->model->system;
    const char *text = "";
    size_t left = f->motion->values;
    for (size_t j = 0; j < c->model->m; j++) {
        if (!f->motion->given[j]) continue;
        text = nh_arena_printf(c->out->arena, "%s%s%s", text,
                               !text[0]    ? ""
                               : left == 1 ? " and "
                                           : ", ",
                               system->coordinate[j].name);
        left--;
    }
    return text;
}

static void refuse(nh_benchmark_work *c, const nh_known_motions *f, double off, size_t worst, const char *methods)
{
    const nh_system *system = c->model->system;
    size_t m = c->model->m, j = worst % (2 * m);
    const char *name = j < m ? system->coordinate[j].name : nh_name_of(c->model->dag, system->coordinate[j - m].v);
    nh_benchmark_work_refuse(
        c, nh_arena_printf(c->out->arena, "closed form \"%s\"", f->motion->name),
        nh_arena_printf(c->out->arena, "it is not this motion: %s is off by %.0e at t = %g, where %s agree to %.0e",
                        name, off, c->solution.times[worst / (2 * m)], methods, c->out->agreement));
}

void nh_known_motions_use(nh_benchmark_work *c)
{
    size_t m = c->model->m;
    const char *methods = nh_arena_printf(c->out->arena, "%s and %s", c->out->reference, c->out->second);
    for (size_t k = 0; k < c->closed_count; k++) {
        const nh_known_motions *f = &c->closed[k];
        size_t worst;
        double off = nh_closed_off(c, f, c->solution.state, &worst);
        if (!(off <=
              fmax(fmin(c->options.benchmark_closed * c->out->agreement, c->options.benchmark_trusted), least_off))) {
            refuse(c, f, off, worst, methods);
            continue;
        }
        for (size_t i = 0; i < NH_BENCHMARK_OUTPUTS * 2 * m; i++)
            if (f->motion->given[i % m]) c->solution.state[i] = f->state[i];
        if (f->whole) {
            c->out->second = c->out->reference;
            c->out->reference = nh_arena_printf(c->out->arena, "closed form \"%s\"", f->motion->name);
            c->out->agreement = off;
            return;
        }
        c->out->reference = nh_arena_printf(c->out->arena, "closed form \"%s\" of %s, otherwise %s", f->motion->name,
                                            names_of(c, f), c->out->reference);
        c->out->agreement = fmax(c->out->agreement, off);
    }
}
