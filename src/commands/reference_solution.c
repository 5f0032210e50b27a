/* reference_solution: the motion and the currents with which a computed motion is compared. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "graph/terms.h"
#include "commands/benchmark_internal.h"
#include "graph/dag.h"
#include "motion/turns.h"

/* relative rate at the probes below which a known current counts as conserved with these parameters */
static const double conserved = 1e-9;

/* ---- formulations ---- */

static void sized(nh_formulation *f, size_t m, double absolute, nh_arena *arena)
{
    f->z0 = nh_arena_alloc(arena, 2 * m * sizeof *f->z0);
    f->scale = nh_arena_alloc(arena, 2 * m * sizeof *f->scale);
    for (size_t i = 0; i < 2 * m; i++) f->scale[i] = absolute;
}

bool nh_formulation_open(nh_formulation *f, nh_model *model, const nh_state *initial, bool project, double absolute,
                         nh_arena *arena, nh_error *error)
{
    *f = (nh_formulation){
        .name = nh_arena_strdup(arena, model->chart->name), .model = model, .size = model->m + model->n};
    sized(f, model->m, absolute, arena);
    f->dynamics = nh_dynamics_create(model);
    f->problem = nh_dynamics_problem(f->dynamics);
    f->programs = nh_programs_create(model);
    return nh_dynamics_start(f->dynamics, initial, project, f->z0, error);
}

bool nh_formulation_open_all(nh_formulation *f, nh_formulation *chart, double t, nh_arena *arena, nh_error *error)
{
    const nh_model *model = chart->model;
    *f = (nh_formulation){.name = "all coordinates", .size = 2 * model->m, .bordered = nh_bordered_create(model)};
    f->problem = nh_bordered_flow(f->bordered);
    sized(f, model->m, chart->scale[0], arena);
    memcpy(f->z0, chart->z0, model->m * sizeof *f->z0);
    return nh_dynamics_velocities(chart->dynamics, t, chart->z0, f->z0 + model->m) ||
           nh_fail(error, NH_NUMERIC, "", "the velocities cannot be found at the initial state");
}

void nh_formulation_close(nh_formulation *f)
{
    nh_reduced_flow_free(f->reduced);
    nh_programs_free(f->programs);
    nh_dynamics_free(f->dynamics);
    nh_bordered_free(f->bordered);
}

bool nh_formulation_states(nh_formulation *f, const nh_motion *motion, double *y)
{
    if (f->model) return nh_states_in_coordinates(f->dynamics, motion, y);
    size_t m2 = f->size; /* in each state multipliers may follow */
    for (size_t i = 0; i < motion->count; i++) memcpy(y + i * m2, motion->state + i * motion->size, m2 * sizeof *y);
    return true;
}

/* ---- currents ---- */

/* Is dPhi/dt = sum_j dPhi/dz_j z_j' zero at the probes, relative to the terms of the sum?  Near the end of a chart
 * these are large. */
static bool is_conserved(const nh_model *model, nh_ex phi)
{
    size_t size = model->m + model->n, n = 3 * size + 2;
    nh_ex *e = nh_alloc_array(n, sizeof *e);
    double *value = nh_alloc_array(n, sizeof *value);
    e[0] = nh_model_gamma(model, phi);
    e[1] = phi;
    for (size_t j = 0; j < size; j++) {
        nh_ex z = model->chart->symbol[1 + j], slope = nh_diff(model->dag, phi, z),
              rate = j < model->m ? model->rho[j] : model->a[j - model->m];
        e[2 + j] = nh_mul(model->dag, slope, rate);
        e[2 + size + j] = nh_mul(model->dag, slope, z);
        e[2 + 2 * size + j] = rate;
    }
    nh_tape *tape = nh_model_tape(model, n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = model->chart->probes > 0;
    for (size_t p = 0; p < model->chart->probes && good; p++) {
        nh_tape_eval(tape, work, model->chart->probe + p * model->chart->width, value);
        double terms = 0, own = fabs(value[1]);
        for (size_t j = 0; j < size; j++) terms += fabs(value[2 + j]), own += fabs(value[2 + size + j]);
        terms += own * nh_programs_pace(model, value + 2 + 2 * size);
        good = fabs(value[0]) <= conserved * terms;
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(value);
    nh_free(e);
    return good;
}

/* Replaces the chart's velocities, implicit ones too, by those of the coordinates. */
static bool to_coordinates(const nh_model *model, size_t n, const nh_ex *e, nh_ex *out)
{
    const nh_chart *c = model->chart;
    nh_ex *from = nh_alloc_array(model->n + c->implicit + 1, sizeof *from),
          *to = nh_alloc_array(model->n + c->implicit + 1, sizeof *to);
    bool good = !c->quasi || nh_chart_inverse(c, to);
    for (size_t i = 0; i < model->n; i++) {
        from[i] = c->w[i];
        if (!c->quasi) to[i] = c->w[i];
    }
    for (size_t a = 0; a < c->implicit; a++) {
        from[model->n + a] = c->u[a];
        to[model->n + a] = model->system->coordinate[c->dependent[a]].v;
    }
    for (size_t k = 0; k < n && good; k++) out[k] = nh_substitute(model->dag, e[k], model->n + c->implicit, from, to);
    nh_free(to);
    nh_free(from);
    return good;
}

static void compile(nh_reference_solution *y, const nh_ex *e)
{
    const nh_model *model = y->model;
    size_t m = model->m, n = y->currents;
    nh_ex *in = nh_alloc_array(1 + 2 * m, sizeof *in), *out = nh_alloc_array(n * (1 + 2 * m) + 1, sizeof *out);
    in[0] = model->system->t;
    for (size_t s = 0; s < m; s++) {
        in[1 + s] = model->system->coordinate[s].q;
        in[1 + m + s] = model->system->coordinate[s].v;
    }
    for (size_t k = 0; k < n; k++) {
        out[k] = e[k];
        for (size_t j = 0; j < 2 * m; j++) out[n + k * 2 * m + j] = nh_diff(model->dag, e[k], in[1 + j]);
    }
    y->tape = nh_tape_create(model->dag, 1 + 2 * m, in, n * (1 + 2 * m), out, model->system->parameters,
                             model->parameter, model->parameter_value);
    nh_free(in);
    nh_free(out);
}

/* Is b a multiple of a at the probes? */
static bool same_current(const nh_model *model, nh_ex a, nh_ex b)
{
    nh_ex *e;
    size_t n = nh_terms_of(model->dag, b, &e);
    e = nh_realloc_array(e, n + 1, sizeof *e);
    e[n] = a;
    double *value = nh_alloc_array(n + 1, sizeof *value), ratio = NAN;
    nh_tape *tape = nh_model_tape(model, n + 1, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool same = true;
    for (size_t p = 0; p < model->chart->probes && same; p++) {
        nh_tape_eval(tape, work, model->chart->probe + p * model->chart->width, value);
        if (p == 0) ratio = value[0] / value[n];
        double terms = 0;
        for (size_t i = 0; i < n; i++) terms += fabs(value[i]);
        same = fabs(value[0] - ratio * value[n]) <= conserved * terms;
    }
    nh_free(value);
    nh_free(e);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return same;
}

size_t nh_reference_solution_currents(nh_reference_solution *y, nh_arena *arena, const char **varying)
{
    size_t others = 0;
    const nh_model *model = y->model;
    const nh_system *system = model->system;
    nh_error ignored;
    nh_error_clear(&ignored);
    y->current = nh_arena_alloc(arena, (system->currents + 1) * sizeof *y->current);
    y->name = nh_arena_alloc(arena, (system->currents + 1) * sizeof *y->name);
    nh_ex *e = nh_alloc_array(system->currents + 1, sizeof *e);
    for (size_t k = 0; k <= system->currents; k++) {
        nh_ex phi = model->E;
        if (k && system->current[k - 1].unwatched) continue;
        if (k && !nh_analysis_file_to_chart(model, system->current[k - 1].value, &phi, &ignored)) continue;
        if (k && y->currents && y->current[0] == model->E && same_current(model, model->E, phi)) continue;
        if (!is_conserved(model, phi)) {
            if (k) varying[others++] = system->current[k - 1].name;
            continue;
        }
        if (!to_coordinates(model, 1, &phi, &e[y->currents])) continue;
        y->name[y->currents] = k ? system->current[k - 1].name : "E";
        y->current[y->currents++] = phi;
    }
    compile(y, e);
    nh_free(e);
    return others;
}

/* The size of a coordinate or velocity in a current.  An angle that grows by full turns does not count as larger:
 * otherwise its drift would appear smaller and smaller. */
static double size_of(const nh_model *model, size_t j, double y, double least)
{
    double size = fmax(fabs(y), least);
    return j < model->m && model->system->coordinate[j].type == NH_ANGLE ? fmin(size, 1) : size;
}

/* The size of a current is that of its parts: |Phi| and |dPhi/dy_j y_j|, y_j not below its least size. */
void nh_reference_solution_scales(nh_reference_solution *y, nh_arena *arena, double least)
{
    size_t m2 = 2 * y->model->m, n = y->currents;
    double *in = nh_alloc_array(1 + m2, sizeof *in), *out = nh_alloc_array(n * (1 + m2) + 1, sizeof *out);
    nh_tape_work *work = nh_tape_work_create(y->tape);
    y->scale = nh_arena_alloc(arena, m2 * sizeof *y->scale);
    y->current_scale = nh_arena_alloc(arena, (n + 1) * sizeof *y->current_scale);
    y->current_start = nh_arena_alloc(arena, (n + 1) * sizeof *y->current_start);
    for (size_t j = 0; j < m2; j++) y->scale[j] = least;
    for (size_t i = 0; i < NH_BENCHMARK_OUTPUTS; i++) {
        const double *at = y->state + i * m2;
        in[0] = y->times[i];
        memcpy(in + 1, at, m2 * sizeof *in);
        nh_tape_eval(y->tape, work, in, out);
        for (size_t j = 0; j < m2; j++) y->scale[j] = fmax(y->scale[j], fabs(at[j]));
        for (size_t k = 0; k < n; k++) {
            double size = fabs(out[k]);
            for (size_t j = 0; j < m2; j++)
                size = fmax(size, fabs(out[n + k * m2 + j]) * size_of(y->model, j, at[j], least));
            if (isfinite(size)) y->current_scale[k] = fmax(y->current_scale[k], size);
            if (i == 0) y->current_start[k] = out[k];
        }
    }
    /* zero, with all its parts */
    for (size_t k = 0; k < n; k++) y->current_scale[k] = y->current_scale[k] > 0 ? y->current_scale[k] : 1;
    nh_tape_work_free(work);
    nh_free(in);
    nh_free(out);
}

void nh_reference_solution_close(nh_reference_solution *y) { nh_tape_free(y->tape); }

double nh_reference_solution_error(const nh_reference_solution *y, size_t count, const double *states)
{
    size_t m2 = 2 * y->model->m;
    double worst = 0;
    double *own = nh_alloc_array(m2, sizeof *own);
    for (size_t i = 0; i < count; i++) {
        const double *to = y->state + i * m2;
        memcpy(own, states + i * m2, m2 * sizeof *own);
        nh_turns_nearest(y->model->system, to, own, own + y->model->m);
        for (size_t j = 0; j < m2; j++) {
            double e = fabs(own[j] - to[j]) / y->scale[j];
            if (!(e <= worst)) worst = isfinite(e) ? e : INFINITY;
        }
    }
    nh_free(own);
    return worst;
}

void nh_reference_solution_drifts(const nh_reference_solution *y, size_t count, const double *states, double *drift)
{
    size_t m2 = 2 * y->model->m, n = y->currents;
    double *in = nh_alloc_array(1 + m2, sizeof *in), *out = nh_alloc_array(n * (1 + m2) + 1, sizeof *out);
    nh_tape_work *work = nh_tape_work_create(y->tape);
    for (size_t k = 0; k < n; k++) drift[k] = 0;
    for (size_t i = 0; i < count; i++) {
        in[0] = y->times[i];
        memcpy(in + 1, states + i * m2, m2 * sizeof *in);
        nh_tape_eval(y->tape, work, in, out);
        for (size_t k = 0; k < n; k++) {
            double d = fabs(out[k] - y->current_start[k]) / fmax(y->current_scale[k], DBL_MIN);
            if (!(d <= drift[k])) drift[k] = isfinite(d) ? d : INFINITY;
        }
    }
    nh_tape_work_free(work);
    nh_free(in);
    nh_free(out);
}
