#include "commands/live.h"

#include <string.h>

#include "commands/export_internal.h"
#include "geometry/bordered.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/terms.h"

enum { most_states = 20 };
static const double relative_only = 1e-30; /* the floor of a state whose relative error counts */

typedef struct {
    nh_live *live;
    const nh_live_request *q;
    nh_export *x;
    const nh_model *o;
    nh_dag *d;
    bool everywhere; /* in all coordinates */
    size_t m, n, k, states;
    nh_ex *state, *multiplier; /* symbols; the k multipliers of the equations in all coordinates */
    nh_ex *K, *h, *F, *g, *f;  /* these equations */
} maker;

static nh_ex *take(const maker *w, size_t n) { return nh_arena_alloc(w->x->arena, (n + 1) * sizeof(nh_ex)); }

static nh_export_function *function_of_state(const maker *w, const char *name, const char *doc)
{
    nh_export_function *f = nh_export_add(w->x, NH_EXPORT_EQUATIONS, w->o->system, name, doc);
    nh_export_argument(w->x, f, "state", "", w->states, w->state);
    return f;
}

/* ---- the state ---- */

/* Coordinates, then the chart's velocities, or all of them. */
static void choose_state(maker *w)
{
    const nh_chart *c = w->o->chart;
    const nh_system *system = w->o->system;
    w->everywhere = c->implicit || (!c->quasi && !c->regular);
    w->states = w->m + (w->everywhere ? w->m : w->n);
    w->state = take(w, w->states);
    for (size_t i = 0; i < w->m; i++) {
        w->state[i] = system->coordinate[i].q;
        if (w->everywhere) w->state[w->m + i] = system->coordinate[i].v;
    }
    for (size_t i = 0; i < w->n && !w->everywhere; i++) w->state[w->m + i] = c->w[i];
}

/* The tracks begin with the coordinates and their velocities, then those quasi-velocities that are no such velocity. */
static double first_value(const maker *w, nh_ex symbol)
{
    const nh_observables *t = w->q->tracks;
    for (size_t i = 0; i < t->count && t->track[i].kind == NH_TRACK_STATE; i++)
        if (t->track[i].value == symbol ||
            (i >= w->m && i < 2 * w->m && w->o->system->coordinate[i - w->m].v == symbol))
            return w->q->first[i];
    return 0;
}

/* Does e have a logarithm or a denominator that is singular where the symbol is zero? */
static bool is_singular_at_zero(nh_dag *d, nh_ex e, nh_ex symbol)
{
    if (!nh_depends(d, e, symbol)) return false;
    nh_ex zero = nh_int(d, 0);
    nh_kind kind = nh_kind_of(d, e);
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex child = nh_child(d, e, i);
        bool below = kind == NH_PRODUCT && nh_kind_of(d, nh_exponent_of(d, e, i)) == NH_NUMBER &&
                     nh_num_value(nh_number_of(d, nh_exponent_of(d, e, i))) < 0;
        bool inside = kind == NH_FUNCTION && nh_function_of(d, e) == NH_LOG;
        if ((below || inside) && nh_depends(d, child, symbol) &&
            nh_is_zero(d, nh_substitute(d, child, 1, &symbol, &zero)))
            return true;
        if (is_singular_at_zero(d, child, symbol)) return true;
    }
    return false;
}

static void begin_state(maker *w)
{
    nh_live *l = w->live;
    l->states = w->states;
    l->symbol = w->state;
    l->state = nh_arena_alloc(w->x->arena, (w->states + 1) * sizeof *l->state);
    l->initial = nh_arena_alloc(w->x->arena, (w->states + 1) * sizeof *l->initial);
    l->floor = nh_arena_alloc(w->x->arena, (w->states + 1) * sizeof *l->floor);
    for (size_t i = 0; i < w->states; i++) {
        l->state[i] = nh_name_of(w->d, w->state[i]);
        l->initial[i] = first_value(w, w->state[i]);
        l->floor[i] = 1;
        for (size_t k = 0; k < l->quantities; k++)
            if (!l->without[k] && is_singular_at_zero(w->d, l->quantity[k].value, w->state[i]))
                l->floor[i] = relative_only;
    }
}

/* ---- the functions ---- */

/* The dependent velocities of the chart as the velocities that they are. */
static nh_ex of_state(const maker *w, nh_ex e)
{
    const nh_chart *c = w->o->chart;
    if (!w->everywhere || !c->implicit) return e;
    nh_ex *v = take(w, c->implicit);
    for (size_t i = 0; i < c->implicit; i++) v[i] = w->o->system->coordinate[c->dependent[i]].v;
    return nh_substitute(w->d, e, c->implicit, c->u, v);
}

/* [ K F^T ; F 0 ] (v', mu) = -(h, g) [geometry/bordered.h]; adds the unknowns to the function. */
static void solve_everywhere(const maker *w, nh_export_function *f, nh_ex *acceleration)
{
    nh_dag *d = w->d;
    size_t m = w->m, k = w->k, n = m + k;
    nh_ex *A = take(w, n * n), *b = take(w, n), *unknown = take(w, n), zero = nh_int(d, 0);
    for (size_t i = 0; i < n * n; i++) A[i] = zero;
    for (size_t i = 0; i < m; i++) {
        acceleration[i] = unknown[i] =
            nh_symbol_fresh(d, nh_arena_printf(w->x->arena, "%s''", w->o->system->coordinate[i].name));
        b[i] = nh_neg(d, w->h[i]);
        for (size_t j = 0; j < m; j++) A[i * n + j] = w->K[i + j * m];
        for (size_t a = 0; a < k; a++) A[i * n + m + a] = A[(m + a) * n + i] = w->F[a + i * k];
    }
    for (size_t a = 0; a < k; a++) unknown[m + a] = w->multiplier[a], b[m + a] = nh_neg(d, w->g[a]);
    nh_export_linear(w->x, f, n, A, b, unknown);
}

static void equations_everywhere(maker *w)
{
    size_t m = w->m, k = w->k;
    w->K = take(w, m * m), w->h = take(w, m), w->F = take(w, k * m), w->g = take(w, k), w->f = take(w, k);
    w->multiplier = nh_export_symbols(w->x, w->d, "lambda", k);
    nh_bordered_expressions(w->o, w->K, w->h, w->F, w->g, w->f);
}

/* One node above n expressions, to count the operations of all. */
static size_t operations(const maker *w, size_t n, const nh_ex *e)
{
    nh_ex sum = nh_int(w->d, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(w->d, sum, nh_mul(w->d, nh_symbol_fresh(w->d, "e"), e[i]));
    return nh_node_count(w->d, sum);
}

/* w' in closed form, or from M w' = A where that is shorter. */
static void rates_in_chart(maker *w, nh_export_function *f, nh_ex *rate)
{
    const nh_model *o = w->o;
    size_t n = w->n, elimination = n * n * n / 3 + n * n;
    nh_ex *both = take(w, n * n + n);
    memcpy(both, o->M, n * n * sizeof *both);
    memcpy(both + n * n, o->A, n * sizeof *both);
    memcpy(rate, o->a, n * sizeof *rate);
    if (operations(w, n, o->a) <= operations(w, n * n + n, both) + elimination) return;
    for (size_t i = 0; i < n; i++) rate[i] = nh_symbol_fresh(w->d, "rate");
    nh_export_linear(w->x, f, n, o->M, o->A, rate);
}

static void rates(maker *w)
{
    nh_ex *rate = take(w, w->states);
    nh_export_function *f = function_of_state(w, "rhs", "the rate of the state");
    memcpy(rate, w->everywhere ? w->state + w->m : w->o->rho, w->m * sizeof *rate);
    if (w->everywhere) solve_everywhere(w, f, rate + w->m);
    else rates_in_chart(w, f, rate + w->m);
    nh_export_result(w->x, f, "rate", "", w->states, 1, rate, NULL);
}

/* The multipliers of the constraints as they are written would need a conversion in all coordinates. */
static bool can_observe(const maker *w, const nh_track *t)
{
    return t->kind != NH_TRACK_CURRENT && !(w->everywhere && t->kind == NH_TRACK_MULTIPLIER);
}

static void observations(maker *w, nh_live_lacks *lacks)
{
    const nh_observables *t = w->q->tracks;
    nh_ex *value = take(w, t->count);
    size_t *track = nh_arena_alloc(w->x->arena, (t->count + 1) * sizeof *track), n = 0;
    for (size_t i = 0; i < t->count; i++) {
        if (!can_observe(w, &t->track[i]) || lacks(w->d, t->track[i].value)) continue;
        bool velocity = t->track[i].kind == NH_TRACK_STATE && i >= w->m && i < 2 * w->m;
        value[n] = velocity && w->everywhere ? w->o->system->coordinate[i - w->m].v : of_state(w, t->track[i].value);
        track[n++] = i;
    }
    w->live->tracks = n;
    w->live->track = track;
    nh_export_function *f = function_of_state(w, "observe", "the values that are followed");
    nh_export_result(w->x, f, "value", "", n, 1, value, NULL);
}

static nh_ex quantity_of(const maker *w, const nh_live_quantity *q)
{
    return w->everywhere && q->in_velocities ? q->in_velocities : of_state(w, q->value);
}

static void quantities(maker *w)
{
    size_t n = w->live->quantities;
    nh_ex *value = take(w, 2 * n);
    for (size_t i = 0; i < n; i++) {
        value[i] = w->live->without[i] ? nh_int(w->d, 0) : quantity_of(w, &w->q->quantity[i]);
        value[n + i] = nh_terms_uncancelled(w->d, value[i]);
    }
    if (!n) return;
    nh_export_function *f = function_of_state(w, "quantities", "conserved quantities, and the sizes of their terms");
    nh_export_result(w->x, f, "quantity", "", n, 1, value, NULL);
    nh_export_result(w->x, f, "size", "", n, 1, value + n, NULL);
}

/* Equations between positions; in all coordinates the constraints, too. */
static void conditions(maker *w)
{
    const nh_system *system = w->o->system;
    nh_ex *value = take(w, system->constraints + w->k);
    size_t n = 0;
    for (size_t a = 0; a < system->constraints; a++)
        if (system->constraint[a].level) value[n++] = system->constraint[a].level;
    for (size_t a = 0; w->everywhere && a < w->k; a++) value[n++] = w->f[a];
    if (!n) return;
    nh_export_function *f = function_of_state(w, "conditions", "zero at states that the constraints allow");
    nh_export_result(w->x, f, "value", "", n, 1, value, NULL);
}

/* ---- can a page compute it? ---- */

static void leave_quantities(maker *w, nh_live_lacks *lacks)
{
    bool *without = nh_arena_alloc(w->x->arena, (w->q->quantities + 1) * sizeof *without);
    for (size_t i = 0; i < w->q->quantities; i++) without[i] = lacks(w->d, w->q->quantity[i].value) != NULL;
    w->live->without = without;
}

static const char *obstacle(const maker *w, nh_live_lacks *lacks)
{
    const nh_observables *t = w->q->tracks;
    size_t states = 0;
    while (states < t->count && t->track[states].kind == NH_TRACK_STATE) states++;
    if (states < 2 * w->m) return "only a part of the state was computed";
    if (w->states > most_states)
        return nh_arena_printf(w->x->arena, "it has %zu states, more than %d", w->states, most_states);
    for (size_t i = 0; i < w->states - w->m; i++) {
        const char *name = lacks(w->d, w->everywhere ? w->h[i] : w->o->A[i]);
        if (name && !strcmp(name, nh_function_name(NH_TABLE))) return "its equations contain a table of values";
        if (name) return nh_arena_printf(w->x->arena, "its equations need the function %s", name);
    }
    return NULL;
}

nh_live *nh_live_create(const nh_live_request *q, nh_live_lacks *lacks)
{
    nh_arena *arena = nh_arena_create();
    nh_live *l = nh_arena_alloc(arena, sizeof *l);
    nh_export *x = nh_arena_alloc(arena, sizeof *x);
    const nh_model *model = q->model;
    *x = (nh_export){.arena = arena, .borrowed = true, .system = model->system, .model = model};
    x->input = nh_arena_alloc(arena, (model->system->parameters + 1) * sizeof *x->input);
    *l = (nh_live){.code = x,
                   .model = model,
                   .begin = q->begin,
                   .end = q->end,
                   .quantities = q->quantities,
                   .quantity = q->quantity};
    maker w = {.live = l, .q = q, .x = x, .o = model, .d = model->dag, .m = model->m, .n = model->n, .k = model->k};
    choose_state(&w);
    if (w.everywhere) equations_everywhere(&w);
    leave_quantities(&w, lacks);
    const char *why = obstacle(&w, lacks);
    if (why) return nh_live_leave(l, q->tracks, why), l;
    rates(&w);
    observations(&w, lacks);
    quantities(&w);
    conditions(&w);
    begin_state(&w);
    return l;
}

void nh_live_leave(nh_live *l, const nh_observables *tracks, const char *why)
{
    size_t *all = nh_arena_alloc(l->code->arena, (tracks->count + 1) * sizeof *all);
    for (size_t i = 0; i < tracks->count; i++) all[i] = i;
    l->why = why;
    l->states = 0;
    l->track = all;
    l->tracks = tracks->count;
}

void nh_live_free(nh_live *l)
{
    if (l) nh_export_free(l->code);
}
