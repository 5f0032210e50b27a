/* The smallest closed subsystem for the observables (closed_subsystem.h), from the graph of dependency_graph.c:
 *
 *      state[]     [ core ........ | quadratures .... | by currents | dropped ]
 *                    0               core               kept          kept + levels
 *
 *      feeds       core <-> core --> layer 1 --> layer 2 --> observables       no state of the core feeds on a layer
 *
 * Layers are taken off from the outside: first the kept states that no other kept state reads. Programs are compiled
 * with constants in the places of dropped states, on which they do not depend. */
#include "motion/closed_subsystem.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "exact/walls.h"
#include "graph/dag.h"

/* least slope of a current relative to its slope at the start: below it the state that it determines loses digits */
static const double smallest_slope = 0.03;

static const double same_rows = 1e-9; /* relative difference of two forms of one row that counts as rounding */

/* error of a state that is zero at the start, as a part of the current over its slope, that counts as rounding */
static const double rounding = 1e-13;

static nh_ex symbol_of(const nh_model *model, size_t j) { return model->chart->symbol[1 + j]; }

/* ---- core, quadratures, rest ---- */

/* Removes, layer by layer, the states that no remaining state depends on.  The layer that is removed last can be
 * integrated first. */
static void sort_states(nh_closed_subsystem *s, const nh_dependency_graph *w)
{
    bool *left = nh_alloc_array(w->states, sizeof *left), *layer = nh_alloc_array(w->states, sizeof *layer);
    memcpy(left, w->kept, w->states * sizeof *left);
    size_t at = s->kept;
    for (bool again = true; again;) {
        again = false;
        for (size_t j = 0; j < w->states; j++) {
            layer[j] = left[j];
            for (size_t i = 0; i < w->states; i++)
                if (left[i] && w->feeds[i * w->states + j]) layer[j] = false;
        }
        for (size_t j = w->states; j-- > 0;)
            if (layer[j]) {
                left[j] = false;
                s->state[--at] = j;
                again = true;
            }
    }
    s->core = at;
    s->quadratures = s->kept - at;
    size_t next = 0, last = s->kept + w->levels;
    for (size_t j = 0; j < w->states; j++) {
        if (left[j]) s->state[next++] = j;
        for (size_t k = 0; k < w->levels; k++)
            if (w->level[k].state == j) s->state[s->kept + k] = j;
        bool removed = false;
        for (size_t k = 0; k < w->levels; k++) removed |= w->level[k].state == j;
        if (!w->kept[j] && !removed) s->state[last++] = j;
    }
    nh_free(layer);
    nh_free(left);
}

/* The kept rows with zero for what is dropped, which makes most of them short.  False where that is no regular
   value. */
static bool rows_at_zero(const nh_closed_subsystem *s, nh_ex *e)
{
    const nh_model *model = s->model;
    size_t n = s->kept, from = n + s->levels, count = s->states - from, width = model->width + s->levels;
    nh_ex *symbol = nh_alloc_array(count + 1, sizeof *symbol), *zero = nh_alloc_array(count + 1, sizeof *zero);
    for (size_t i = 0; i < count; i++)
        symbol[i] = symbol_of(model, s->state[from + i]), zero[i] = nh_int(model->dag, 0);
    for (size_t i = 0; i < n; i++) {
        e[i] = nh_substitute(model->dag, s->graph.row[s->state[i]], count, symbol, zero);
        e[n + i] = s->graph.row[s->state[i]];
    }
    double *value = nh_alloc_array(4 * n + 1, sizeof *value), *off = value + 2 * n, *size = off + n,
           *point = nh_alloc_array(width + 1, sizeof *point);
    nh_tape *tape = nh_dependency_graph_tape(&s->graph, 2 * n, e, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = !s->implicit && model->chart->probes > 0;
    for (size_t p = 0; p < model->chart->probes && good; p++) {
        memcpy(point, model->chart->probe + p * model->width, model->width * sizeof *point);
        for (size_t k = 0; k < s->levels; k++) point[model->width + k] = 0.7385 + 0.31 * (double)(p + k); /* any */
        nh_tape_eval(tape, work, point, value);
        good = nh_all_finite(2 * n, value);
        for (size_t i = 0; i < n; i++) {
            off[i] = fmax(off[i], fabs(value[i] - value[n + i]));
            size[i] = fmax(size[i], fabs(value[n + i]));
        }
    }
    for (size_t i = 0; i < n && good; i++) good = off[i] <= same_rows * size[i];
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(point);
    nh_free(value);
    nh_free(zero);
    nh_free(symbol);
    return good;
}

/* Compiles expressions with regular values for the dropped states, on which they do not depend: constants need not be
 * computed then. */
static nh_tape *frozen_tape(const nh_closed_subsystem *s, size_t n, const nh_ex *e)
{
    const nh_model *model = s->model;
    size_t from = s->kept + s->levels, count = model->chart->probes ? s->states - from : 0;
    nh_ex *symbol = nh_alloc_array(count + 1, sizeof *symbol);
    double *value = nh_alloc_array(count + 1, sizeof *value);
    for (size_t i = 0; i < count; i++) {
        symbol[i] = symbol_of(model, s->state[from + i]);
        value[i] = model->chart->probe[1 + s->state[from + i]];
    }
    nh_tape *tape = nh_dependency_graph_tape(&s->graph, n, e, s->implicit ? 0 : count, symbol, value);
    nh_free(value);
    nh_free(symbol);
    return tape;
}

/* The rates of the kept states and their Jacobian, the values and slopes of the levels. */
static void make_tapes(nh_closed_subsystem *s)
{
    const nh_model *model = s->model;
    size_t n = s->kept, levels = s->levels;
    nh_ex *e = nh_alloc_array(s->states + n * (n + 1) + 2 * levels + 1, sizeof *e);
    memcpy(e, model->rho, model->m * sizeof *e);
    memcpy(e + model->m, model->a, model->n * sizeof *e);
    s->rate_of_all = nh_model_tape(model, s->states, e);
    s->instructions_of_all = nh_tape_length(s->rate_of_all);
    bool zero = rows_at_zero(s, e);
    for (size_t i = 0; i < n && !zero; i++) e[i] = s->graph.row[s->state[i]];
    /* what follows from the equations of motion where a chart of velocities holds, and is entire, holds where it ends,
       too: both sides are continuous, and the former places are dense */
    for (size_t i = 0; i < n; i++)
        s->smooth = s->smooth && nh_is_entire(model->dag, e[i], model->width, model->chart->symbol);
    s->rate = n ? frozen_tape(s, n, e) : NULL;
    nh_ex wall[NH_MOST_WALLS];
    s->walls = nh_walls_between(model->dag, n, e, model->width, model->chart->symbol, wall);
    s->wall = s->walls ? frozen_tape(s, s->walls, wall) : NULL;
    s->instructions = n ? nh_tape_length(s->rate) : 0;
    bool exact = n && !nh_dynamics_differences(s->instructions, n);
    for (size_t j = 0; j < n && exact; j++)
        for (size_t i = 0; i < n; i++) e[n + i + j * n] = nh_diff(model->dag, e[i], symbol_of(model, s->state[j]));
    s->jacobian = exact ? frozen_tape(s, n * n, e + n) : NULL;
    for (size_t k = 0; k < levels; k++) {
        e[k] = s->graph.level[k].value;
        e[levels + k] = s->graph.level[k].slope;
    }
    s->removed = nh_dependency_graph_tape(&s->graph, 2 * levels, e, 0, NULL, NULL);
    for (size_t k = 0; k < levels; k++) e[k] = s->graph.level[k].current;
    s->currents = nh_model_tape(model, levels, e);
    nh_free(e);
}

nh_closed_subsystem *nh_closed_subsystem_create(const nh_model *model, size_t n, const nh_ex *watched, size_t currents,
                                                const nh_ex *current)
{
    nh_arena *arena = nh_arena_create();
    nh_closed_subsystem *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_closed_subsystem){.model = model, .arena = arena, .states = model->m + model->n};
    s->state = nh_arena_alloc(arena, (s->states + 1) * sizeof *s->state);
    nh_dependency_graph_init(&s->graph, model, n, watched, currents, current);
    s->implicit = s->graph.implicit;
    s->kept = s->graph.count;
    s->levels = s->graph.levels;
    s->smooth = !s->implicit && !s->levels && !model->chart->branch;
    for (size_t i = 0; i < n; i++)
        s->smooth = s->smooth && nh_is_entire(model->dag, watched[i], model->width, model->chart->symbol);
    sort_states(s, &s->graph);
    make_tapes(s);
    return s;
}

void nh_closed_subsystem_free(nh_closed_subsystem *s)
{
    if (!s) return;
    nh_tape_free(s->rate);
    nh_tape_free(s->jacobian);
    nh_tape_free(s->wall);
    nh_tape_free(s->rate_of_all);
    nh_tape_free(s->removed);
    nh_tape_free(s->currents);
    nh_dependency_graph_clear(&s->graph);
    nh_arena_free(s->arena);
}

/* ---- its equations ---- */

struct nh_closed_subsystem_run {
    const nh_closed_subsystem *scene;
    nh_tape_work *rate, *jacobian, *removed, *wall;
    const nh_flow_problem *whole;
    double *point; /* (t, q, w, u, c): dropped states at their initial values, implicit velocities at their last ones */
    long failed;   /* the level that does not determine its state; -1: none */
    double *level, *slope; /* the states that currents determine, then the slopes; the slopes at the start */
};

nh_closed_subsystem_run *nh_closed_subsystem_run_create(const nh_closed_subsystem *s, double t, const double *z0)
{
    size_t width = s->model->width;
    nh_closed_subsystem_run *run = nh_alloc(sizeof *run);
    *run = (nh_closed_subsystem_run){.scene = s,
                                     .failed = -1,
                                     .point = nh_alloc_array(width + s->levels + 1, sizeof *run->point),
                                     .level = nh_alloc_array(3 * s->levels + 1, sizeof *run->level)};
    run->slope = run->level + 2 * s->levels;
    if (s->rate) run->rate = nh_tape_work_create(s->rate);
    if (s->jacobian) run->jacobian = nh_tape_work_create(s->jacobian);
    run->removed = nh_tape_work_create(s->removed);
    if (s->wall) run->wall = nh_tape_work_create(s->wall);
    run->point[0] = t;
    memcpy(run->point + 1, z0, s->states * sizeof *z0);
    if (!s->levels) return run;
    nh_tape_work *work = nh_tape_work_create(s->currents);
    nh_tape_eval(s->currents, work, run->point, run->point + width);
    nh_tape_work_free(work);
    nh_tape_eval(s->removed, run->removed, run->point, run->level);
    memcpy(run->slope, run->level + s->levels, s->levels * sizeof *run->slope);
    for (size_t k = 0; k < s->levels && run->failed < 0; k++) { /* does the inverse return the value that was there? */
        double at = z0[s->state[s->kept + k]];
        double allowed = at != 0 ? same_rows * fabs(at) : rounding * fabs(run->point[width + k] / run->slope[k]);
        if (!(fabs(run->level[k] - at) <= allowed)) run->failed = (long)k;
    }
    return run;
}

void nh_closed_subsystem_run_jit(nh_closed_subsystem_run *run, double patience)
{
    if (run->rate) nh_tape_jit(run->rate, patience);
    if (run->jacobian) nh_tape_jit(run->jacobian, patience);
}

const char *nh_closed_subsystem_run_words(const nh_closed_subsystem_run *run)
{
    return run->rate ? nh_tape_words(run->rate) : NULL;
}

long nh_closed_subsystem_run_failed(const nh_closed_subsystem_run *run) { return run->failed; }

void nh_closed_subsystem_run_free(nh_closed_subsystem_run *run)
{
    if (!run) return;
    nh_tape_work_free(run->rate);
    nh_tape_work_free(run->jacobian);
    nh_tape_work_free(run->removed);
    nh_tape_work_free(run->wall);
    nh_free(run->level);
    nh_free(run->point);
    nh_free(run);
}

/* The point (t, q, w, u, c) of the kept states z. */
static bool place(nh_closed_subsystem_run *run, double t, const double *z)
{
    const nh_closed_subsystem *s = run->scene;
    run->point[0] = t;
    for (size_t i = 0; i < s->kept; i++) run->point[1 + s->state[i]] = z[i];
    return !s->implicit || nh_chart_complete(s->model->chart, run->point);
}

/* The states that currents determine, into the point; false when one is not determined there. */
static bool place_removed(nh_closed_subsystem_run *run)
{
    const nh_closed_subsystem *s = run->scene;
    if (!s->levels) return true;
    nh_tape_eval(s->removed, run->removed, run->point, run->level);
    for (size_t k = 0; k < s->levels; k++) {
        run->point[1 + s->state[s->kept + k]] = run->level[k];
        if (!(run->level[s->levels + k] / run->slope[k] > smallest_slope)) return run->failed = (long)k, false;
    }
    return true;
}

bool nh_closed_subsystem_point(nh_closed_subsystem_run *run, double t, const double *z, double *point)
{
    bool good = place(run, t, z) && place_removed(run);
    memcpy(point, run->point, run->scene->model->width * sizeof *point);
    return good;
}

/* The rates of the kept states; false where a current does not determine its state. */
static bool scene_rate(double t, const double *z, double *rate, void *context)
{
    nh_closed_subsystem_run *run = context;
    if (!place(run, t, z)) return false;
    nh_tape_eval(run->scene->rate, run->rate, run->point, rate);
    return nh_all_finite(run->scene->kept, rate);
}

static bool scene_jacobian(double t, const double *z, double *jacobian, void *context)
{
    nh_closed_subsystem_run *run = context;
    if (!place(run, t, z)) return false;
    nh_tape_eval(run->scene->jacobian, run->jacobian, run->point, jacobian);
    return nh_all_finite(run->scene->kept * run->scene->kept, jacobian);
}

static bool scene_guard(double t, const double *z, double *value, void *context)
{
    nh_closed_subsystem_run *run = context;
    const nh_closed_subsystem *s = run->scene;
    size_t guards = run->whole ? run->whole->guards : 0;
    bool good = place(run, t, z);
    if (good && s->levels) place_removed(run);
    for (size_t k = 0; k < s->levels; k++)
        value[guards + k] = run->level[s->levels + k] / run->slope[k] - smallest_slope;
    return good && (!guards || run->whole->guard(t, run->point + 1, value, run->whole->context));
}

static bool scene_walls(double t, const double *z, double *value, void *context)
{
    nh_closed_subsystem_run *run = context;
    if (!place(run, t, z)) return false;
    nh_tape_eval(run->scene->wall, run->wall, run->point, value);
    return true;
}

nh_flow_problem nh_closed_subsystem_problem(nh_closed_subsystem_run *run, const nh_flow_problem *whole)
{
    run->whole = whole;
    if (run->scene->smooth) run->whole = NULL;
    size_t guards = (run->whole ? run->whole->guards : 0) + run->scene->levels;
    return (nh_flow_problem){.size = run->scene->kept,
                             .context = run,
                             .rate = scene_rate,
                             .jacobian = run->jacobian ? scene_jacobian : NULL,
                             .guards = guards,
                             .guard = guards ? scene_guard : NULL,
                             .walls = run->scene->walls,
                             .wall = scene_walls};
}
