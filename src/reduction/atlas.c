/* The charts of one reduced motion (atlas.h). At a place q with velocity v, nh_atlas_at gives a chart and its state
 * z:
 *
 *      1. a known chart whose guards are far from zero there
 *      2. else a new one: its slice (the preferred one if it passes regularly), then its equations
 *             Chaplygin: by the connection, where there is one;  any group: master.c, with other components as w
 *             second stage: on the slice of the shape space;  without connection: both groups at once
 *
 *      nh_chart_leave: z -> (q, v);   enter: (q, v) -> z.   Where charts fail, the place is moved along its orbit
 *
 * The regularity of a chart is the smaller of its guards: a minor over the root of the sum of the squares of all
 * minors. */
#include "reduction/atlas.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "graph/diff.h"
#include "reduction/reach.h"
#include "reduction/subspace.h"

/* part of a guard at which a known chart is used again, and the connection is used */
static const double usable = 0.25;

struct nh_atlas {
    const nh_action *action;
    const nh_second *second; /* of a second stage */
    const nh_action *both;
    bool chaplygin;
    const size_t *avoid; /* the coordinates of a slice that failed, while another one is made; NULL */
    nh_reduced_chart **chart;
    size_t count, capacity;
    const nh_slice *preferred;
};

nh_atlas *nh_atlas_create(const nh_action *action, bool chaplygin)
{
    nh_atlas *a = nh_alloc(sizeof *a);
    *a = (nh_atlas){.action = action, .chaplygin = chaplygin};
    return a;
}

nh_atlas *nh_atlas_create_second(const nh_second *second, const nh_action *both)
{
    nh_atlas *a = nh_alloc(sizeof *a);
    *a = (nh_atlas){.action = &second->action, .second = second, .both = both};
    return a;
}

void nh_atlas_free(nh_atlas *a)
{
    if (!a) return;
    for (size_t i = 0; i < a->count; i++) {
        nh_reduced_flow_free(a->chart[i]->flow);
        nh_free(a->chart[i]);
    }
    nh_free(a->chart);
    nh_free(a);
}

void nh_atlas_prefer(nh_atlas *a) { a->preferred = a->chart[a->count - 1]->slice; }

const nh_slice *nh_atlas_preferred(const nh_atlas *a) { return a->preferred; }

const nh_action *nh_atlas_action(const nh_atlas *a) { return a->action; }

void nh_atlas_add(nh_atlas *a, const nh_slice *slice, const nh_reduced *reduced, const size_t *independent,
                  const nh_second *second)
{
    nh_grow(&a->chart, &a->capacity, a->count + 1, sizeof *a->chart);
    nh_reduced_chart *c = a->chart[a->count++] = nh_alloc(sizeof *c);
    *c = (nh_reduced_chart){.slice = slice,
                            .reduced = reduced,
                            .independent = independent,
                            .second = second,
                            .flow = nh_reduced_flow_create(reduced)};
}

/* ---- states ---- */

bool nh_chart_leave(const nh_reduced_chart *c, const double *z, double *q, double *v)
{
    const nh_slice *s = c->slice;
    size_t m = s->m, d = s->d;
    double *rate = nh_alloc_array(c->reduced->n + c->reduced->r + d + m * d + 1, sizeof *rate),
           *zeta = rate + c->reduced->n + c->reduced->r, *E = zeta + d;
    bool good = nh_reduced_flow_at(c->flow, z, rate, NULL, zeta, NULL);
    nh_slice_place(s, z, q);
    nh_action_values(s->action, q, E);
    memset(v, 0, m * sizeof *v);
    for (size_t i = 0; i < s->n; i++) v[s->shape[i]] = rate[i];
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < m; i++) v[i] += E[i + a * m] * zeta[a];
    nh_free(rate);
    return good;
}

/* Velocities in the frame of both groups from those on the shape space of the first: the horizontal lift u = (x', -A x'
 * - A_0). */
static bool lift(const nh_chaplygin *first, const nh_slice *both, const double *q, const double *v, double *u)
{
    const nh_slice *s = first->slice;
    size_t m = s->m, n = s->n, d = s->d;
    double *place = nh_alloc_array(2 * m + d * n + m * d + d + 1, sizeof *place), *speed = place + m, *A = speed + m,
           *E = A + d * n, *A0 = E + m * d;
    nh_slice_place(s, q, place);
    nh_kinetic_values(s->kinetic, d * n, first->A, place, A);
    nh_kinetic_values(s->kinetic, d, first->A0, place, A0);
    nh_action_values(s->action, place, E);
    for (size_t i = 0; i < n; i++) speed[s->shape[i]] = v[i];
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t r = 0; r < m; r++) speed[r] -= E[r + a * m] * (A[a * n + i] * v[i] + (i ? 0 : A0[a]));
    bool good = isfinite(nh_largest(m, speed)) && nh_slice_components(both, place, speed, u);
    nh_free(place);
    return good;
}

/* The state z = (x, p) of a place and velocity in the chart; false where the slice does not pass there. */
static bool enter(const nh_atlas *atlas, const nh_reduced_chart *c, const double *q, const double *v, double *z)
{
    const nh_slice *s = c->slice;
    size_t m = s->m, n = s->n, d = s->d;
    size_t all = c->both ? c->both->m : m;
    double *u = nh_alloc_array(3 * all + d * n + 1, sizeof *u), *x = u + all, *w = x + all, *Av = w + all;
    bool good = c->both ? lift(atlas->second->first, c->both, q, v, u) : nh_slice_components(s, q, v, u);
    for (size_t i = 0; i < n; i++) x[i] = q[s->shape[i]];
    if (c->second) {
        nh_kinetic_values(s->kinetic, d * n, c->second->Av, q, Av);
        memcpy(w, u, m * sizeof *w);
        for (size_t a = 0; a < d; a++)
            for (size_t i = 0; i < n; i++) w[n + a] += Av[a * n + i] * u[i];
    } else {
        for (size_t i = 0; i < c->reduced->r; i++) w[i] = u[c->independent[i]];
    }
    good = good && nh_reduced_start(c->reduced, x, w, z);
    nh_free(u);
    return good;
}

/* Is q on the slice? */
static bool passes(const nh_slice *s, const double *q)
{
    for (size_t a = 0; a < s->d; a++)
        if (q[s->along[a]] != s->y0[a]) return false;
    return true;
}

/* The smaller modulus of the guards at a place; 0 where they are not finite. */
static double regularity(const nh_reduced_chart *c, const double *q)
{
    double *x = nh_alloc_array(c->slice->n + 1, sizeof *x);
    for (size_t i = 0; i < c->slice->n; i++) x[i] = q[c->slice->shape[i]];
    double value = nh_reduced_flow_limit(c->flow, x, 0, 0);
    nh_free(x);
    return value;
}

/* ---- new charts ---- */

/* The generators' minor on a slice at a place. */
static double slice_regularity(const nh_reduced_chart *c, const double *q)
{
    const nh_slice *s = c->slice;
    const nh_guard *g = &c->reduced->guard[1];
    double *E = nh_alloc_array(2 * s->m * s->d + 1, sizeof *E), *rows = E + s->m * s->d, value;
    nh_action_values(s->action, q, E);
    for (size_t a = 0; a < s->d; a++)
        for (size_t i = 0; i < s->m; i++) rows[a * s->m + i] = E[i + a * s->m] * g->unit[i];
    value = s->d ? fabs(nh_relative_minor(s->d, s->m, rows, g->chosen)) : 1;
    nh_free(E);
    return isfinite(value) ? value : 0;
}

/* A slice that passes through the place, and is far from singular there. */
static const nh_slice *slice_at(nh_atlas *a, const double *q)
{
    const nh_kinetic *k = a->action->kinetic;
    for (size_t i = a->count; i-- > 0 && !a->avoid;)
        if (passes(a->chart[i]->slice, q) && slice_regularity(a->chart[i], q) > usable) return a->chart[i]->slice;
    size_t m = k->m, d = a->action->d, *shape = nh_alloc_array(m + 1, sizeof *shape), *along = shape + (m - d);
    double *y = nh_alloc_array(d + 1, sizeof *y);
    nh_slice *s = nh_arena_alloc(k->arena, sizeof *s);
    nh_slice_choose_at(a->action, q, a->avoid, shape, along);
    for (size_t i = 0; i < d; i++) y[i] = q[along[i]];
    nh_slice_init(s, a->action, shape, along, y);
    nh_free(shape);
    nh_free(y);
    return s;
}

/* The constraints on the orbits at a place, as a guard. */
static double connection_regularity(const nh_slice *s, const double *q)
{
    if (!s->f) return 1;
    size_t m = s->m, f = s->f, *columns = nh_alloc_array(f + 1, sizeof *columns);
    double *omega = nh_alloc_array(f * m + m * m + 1, sizeof *omega), *K = omega + f * m, value;
    nh_kinetic_values(s->kinetic, f * m, s->omega, q, omega);
    nh_kinetic_values(s->kinetic, m * m, s->K, q, K);
    for (size_t i = 0; i < f * m; i++) omega[i] /= K[i % m * (m + 1)] > 0 ? sqrt(K[i % m * (m + 1)]) : 1;
    for (size_t i = 0; i < f; i++) columns[i] = s->n + i;
    value = fabs(nh_relative_minor(f, m, omega, columns));
    nh_free(columns);
    nh_free(omega);
    return isfinite(value) ? value : 0;
}

/* A copy of q in the kinetic's arena. */
static const double *copied(const nh_kinetic *k, const double *q)
{
    double *out = nh_arena_alloc(k->arena, k->m * sizeof *out);
    memcpy(out, q, k->m * sizeof *out);
    return out;
}

/* `pivots`: the place for which linear systems are eliminated, or NULL. */
static bool build_second(nh_atlas *a, const double *q, const double *pivots, nh_error *error)
{
    const nh_kinetic *k = a->action->kinetic;
    size_t m = k->m, d = a->action->d, *shape = nh_alloc_array(m + 1, sizeof *shape), *along = shape + (m - d);
    double *y = nh_alloc_array(d + 1, sizeof *y);
    nh_second *t = nh_arena_alloc(k->arena, sizeof *t);
    bool good = nh_second_renew(t, a->second, pivots, error);
    nh_slice_choose_at(a->action, q, a->avoid, shape, along);
    for (size_t i = 0; i < d; i++) y[i] = q[along[i]];
    good = good && nh_second_equations(t, shape, along, y, error);
    if (good) nh_atlas_add(a, &t->slice, &t->reduced, NULL, t);
    nh_free(shape);
    nh_free(y);
    return good;
}

/* The equations of both groups at once, of whose velocities those of the second are kept: at a place q of the shape
   space. */
static bool build_both(nh_atlas *a, const double *q, const double *pivots, nh_error *error)
{
    const nh_slice *first = a->second->first->slice;
    nh_arena *arena = first->kinetic->arena;
    size_t m = first->m, n = first->n, d = a->action->d, *shape = nh_alloc_array(2 * m + 1, sizeof *shape),
           *along = shape + m, *own = nh_alloc_array(2 * m + 1, sizeof *own), *across = own + m;
    double *y = nh_alloc_array(m + 1, sizeof *y), *place = nh_arena_alloc(arena, m * sizeof *place);
    nh_slice *hat = nh_arena_alloc(arena, sizeof *hat), *both = nh_arena_alloc(arena, sizeof *both);
    nh_reduced *o = nh_arena_alloc(arena, sizeof *o);
    size_t *independent = nh_arena_alloc(arena, (m + 1) * sizeof *independent);
    nh_slice_choose_at(a->action, q, a->avoid, shape, along);
    for (size_t i = 0; i < d; i++) y[i] = q[along[i]];
    nh_slice_init(hat, a->action, shape, along, y);
    for (size_t i = 0; i < n - d; i++) own[i] = first->shape[shape[i]];
    for (size_t i = 0; i < first->d; i++) across[i] = first->along[i], y[i] = first->y0[i];
    for (size_t i = 0; i < d; i++) across[first->d + i] = first->shape[along[i]], y[first->d + i] = q[along[i]];
    nh_slice_init(both, a->both, own, across, y);
    nh_slice_place(first, q, place);
    both->pivots = pivots ? place : NULL;
    nh_reduced_independent_at(both, place, independent);
    bool good = nh_reduced_master(o, both, independent, error);
    o->zeta += first->d;
    o->d = d;
    if (good) nh_atlas_add(a, hat, o, independent, NULL);
    if (good) a->chart[a->count - 1]->both = both;
    nh_free(shape);
    nh_free(own);
    nh_free(y);
    return good;
}

/* Is there a connection at a place of the shape space? */
static bool connected(const nh_slice *first, const double *q)
{
    double *place = nh_alloc_array(first->m, sizeof *place);
    nh_slice_place(first, q, place);
    bool good = connection_regularity(first, place) > usable;
    nh_free(place);
    return good;
}

/* A new chart for the place: by the connection where there is one, else by master.c. */
static bool build(nh_atlas *a, const double *q, const double *pivots, nh_error *error)
{
    if (a->second && a->both && !connected(a->second->first->slice, q)) return build_both(a, q, pivots, error);
    if (a->second) return build_second(a, q, pivots, error);
    const nh_slice *found = slice_at(a, q);
    nh_arena *arena = found->kinetic->arena;
    nh_slice *s = nh_arena_alloc(arena, sizeof *s);
    size_t *independent = nh_arena_alloc(arena, (found->m + 1) * sizeof *independent);
    *s = *found;
    s->pivots = pivots;
    s->tidy &= !pivots; /* the simplification may have removed a place at which it is regular */
    if (a->chaplygin && connection_regularity(s, q) > usable) {
        nh_chaplygin *c = nh_arena_alloc(arena, sizeof *c);
        for (size_t i = 0; i < s->n; i++) independent[i] = i;
        if (!nh_chaplygin_init(c, s, error)) return false;
        nh_atlas_add(a, s, &c->reduced, independent, NULL);
        return true;
    }
    nh_reduced *o = nh_arena_alloc(arena, sizeof *o);
    nh_reduced_independent_at(s, q, independent);
    if (!nh_reduced_master(o, s, independent, error)) return false;
    nh_atlas_add(a, s, o, independent, NULL);
    return true;
}

/* sigma_min / sigma_max of the metric with unit diagonal: small near a pole of the coordinates. */
static double coordinates_regularity(const nh_kinetic *k, const double *q)
{
    size_t m = k->m;
    double *K = nh_alloc_array(m * m + 2 * m, sizeof *K), *s = K + m * m, *unit = s + m, ratio = 0;
    nh_kinetic_values(k, m * m, k->K, q, K);
    bool good = isfinite(nh_largest(m * m, K));
    for (size_t i = 0; i < m; i++) unit[i] = K[i * (m + 1)] > 0 ? 1 / sqrt(K[i * (m + 1)]) : 0;
    for (size_t i = 0; i < m * m; i++) K[i] *= unit[i % m] * unit[i / m];
    if (good) nh_singular_values(m, m, K, s);
    if (good && s[0] > 0) ratio = s[m - 1] / s[0];
    nh_free(K);
    return ratio;
}

enum { most_charts = 400 };

const nh_reduced_chart *nh_atlas_at(nh_atlas *a, const double *q, const double *v, double *z, nh_error *error)
{
    static const double pole = 1e-10; /* part of the value at the best sample point */
    const nh_kinetic *k = a->action->kinetic;
    const nh_reduced_chart *best = NULL;
    double most = 0;
    if (!(coordinates_regularity(k, q) >= pole * coordinates_regularity(k, k->place))) {
        nh_fail(error, NH_NUMERIC, "", "the coordinates are singular at this place");
        return NULL;
    }
    for (size_t i = 0; i < a->count && most < usable; i++) {
        double value = passes(a->chart[i]->slice, q) ? regularity(a->chart[i], q) : 0;
        if (value > most) most = value, best = a->chart[i];
    }
    if (most < usable && a->count < most_charts) {
        nh_error trouble = {0};
        if (build(a, q, NULL, &trouble) && regularity(a->chart[a->count - 1], q) > most) best = a->chart[a->count - 1];
        nh_error_clear(&trouble);
    }
    if (best && enter(a, best, q, v, z)) return best;
    nh_fail(error, NH_NUMERIC, "", "no slice and no choice of velocities is regular at this place");
    return NULL;
}

bool nh_atlas_start(const nh_atlas *a, const double *q, const double *v, double *z)
{
    return a->count > 0 && enter(a, a->chart[0], q, v, z);
}

/* ---- along the orbits ---- */

/* Moves to the place of the orbit, among a few, at which the coordinates are most regular, unless they are much less so
 * there than here, or the same along the orbit. */
static void move_along_orbit(const nh_action *g, size_t attempt, double *q, double *v, double *moved)
{
    static const double times[] = {0.7, -0.7, 1.4, -1.4}, better = 0.1, same = 1e-3;
    double stretch = 1 + 0.37 * (double)attempt;
    size_t m = g->kinetic->m;
    double *z = nh_alloc_array(4 * m, sizeof *z), *best = z + 2 * m, here = coordinates_regularity(g->kinetic, q),
           most = better * here;
    memset(moved, 0, g->d * sizeof *moved);
    for (size_t i = 0; i < 4 * g->d; i++) {
        memcpy(z, q, m * sizeof *z);
        memcpy(z + m, v, m * sizeof *z);
        if (!nh_action_push(g, i / 4, times[i % 4] * stretch, z)) continue;
        double value = coordinates_regularity(g->kinetic, z);
        if (value <= most || fabs(value - here) < same * here) continue;
        most = value;
        memcpy(best, z, 2 * m * sizeof *z);
        memset(moved, 0, g->d * sizeof *moved);
        moved[i / 4] = -times[i % 4] * stretch;
    }
    if (nh_largest(g->d, moved) > 0) {
        memcpy(q, best, m * sizeof *q);
        memcpy(v, best + m, m * sizeof *v);
    }
    nh_free(z);
}

const nh_reduced_chart *nh_atlas_renew(nh_atlas *a, const nh_reduced_chart *failed, size_t attempt, double *q,
                                       double *v, double *moved, double *z, nh_error *error)
{
    move_along_orbit(a->action, attempt, q, v, moved);
    a->avoid = attempt ? failed->slice->along : NULL;
    bool built = a->count < most_charts && build(a, q, copied(a->action->kinetic, q), error);
    a->avoid = NULL;
    if (built && enter(a, a->chart[a->count - 1], q, v, z)) return a->chart[a->count - 1];
    nh_fail(error, NH_NUMERIC, "", "no slice and no choice of velocities is regular at this place");
    return NULL;
}
