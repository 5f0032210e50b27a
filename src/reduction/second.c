/* The second stage of a reduced Chaplygin system (second.h; docs/method.md (24), (25)).
 *
 *      fields of the whole system that normalise the first group
 *          descend            their parts zeta on the shape space
 *          candidates         combinations whose work zeta^i force_i vanishes: condition (ii), exactly or by numbers
 *          conditions         (i) Khat, V, Ups invariant: residuals
 *      hat_system             Khat and V as a system of its own, with N acting on it
 *          slice              of the shape space, in the frame (d_i, e_a)
 *          I, Av, Kt, Bv      locked inertia, mechanical connection, metric of the rest, curvature
 *          equations          (25) */
#include "reduction/second.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "reduction/group.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

enum { most_places = 16 };

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

/* field = zeta^i d_i + c^a e_a on the slice: c from the rows of the group's coordinates. */
static bool descend(const nh_chaplygin *f, const nh_ex *field, nh_ex *out)
{
    const nh_slice *s = f->slice;
    nh_dag *d = f->dag;
    size_t n = f->n, g = f->d;
    for (size_t i = 0; i < n && !g; i++) out[i] = field[s->shape[i]];
    if (!g) return true;
    nh_ex *a = nh_alloc_array(g * g + 2 * g + 1, sizeof *a), *c = a + g * g, *y = c + g;
    for (size_t r = 0; r < g; r++) y[r] = s->y[r];
    for (size_t r = 0; r < g; r++) {
        for (size_t b = 0; b < g; b++) a[r * g + b] = s->E[s->along[r] * g + b];
        c[r] = field[s->along[r]];
    }
    nh_ex *coordinate = nh_alloc_array(g + 1, sizeof *coordinate);
    for (size_t r = 0; r < g; r++) coordinate[r] = s->kinetic->q[s->along[r]];
    for (size_t r = 0; r < g; r++) c[r] = nh_substitute(d, c[r], g, coordinate, y);
    nh_lu *lu = nh_lu_create(d, g, a, nh_chart_pivot_score, s->kinetic->model->chart, NULL);
    if (lu) nh_lu_solve(lu, c, c);
    for (size_t i = 0; i < n && lu; i++) {
        out[i] = nh_substitute(d, field[s->shape[i]], g, coordinate, y);
        for (size_t b = 0; b < g; b++) out[i] = plus(d, out[i], nh_neg(d, s->E[s->shape[i] * g + b]), c[b]);
        out[i] = nh_simplify(d, out[i]);
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(coordinate);
    nh_free(a);
    return good;
}

/* e[l*n + j] = zeta^i U_lij */
static void contract(const nh_chaplygin *f, const nh_ex *zeta, nh_ex *e)
{
    size_t n = f->n, at = 0;
    for (size_t l = 0; l < n; l++)
        for (size_t j = 0; j < n; j++, at++) {
            e[at] = nh_int(f->dag, 0);
            for (size_t i = 0; i < n; i++) e[at] = plus(f->dag, e[at], zeta[i], f->U[(l * n + i) * n + j]);
        }
}

/* The same at the sample points: out[(p*n + l)*n + j]. */
static double *interior(const nh_chaplygin *f, const nh_ex *zeta, size_t places)
{
    size_t n = f->n;
    nh_ex *e = nh_alloc_array(n * n, sizeof *e);
    double *out = nh_alloc_array(places * n * n + 1, sizeof *out);
    contract(f, zeta, e);
    nh_kinetic_sample(f->slice->kinetic, n * n, e, places, out);
    nh_free(e);
    return out;
}

/* The sample points that are used. */
static size_t places_of(const nh_chaplygin *f)
{
    return f->slice->kinetic->places < most_places ? f->slice->kinetic->places : most_places;
}

/* max |U_lij| at the sample points, the unit of condition (ii). */
static double largest_U(const nh_chaplygin *f)
{
    size_t places = places_of(f), cube = f->n * f->n * f->n;
    double *U = nh_alloc_array(places * cube + 1, sizeof *U), most;
    nh_kinetic_sample(f->slice->kinetic, cube, f->U, places, U);
    most = nh_largest(places * cube, U);
    nh_free(U);
    return most > 0 ? most : 1;
}

/* Signs and fractions of the sample velocities: the values at these determine a force that is at most quadratic in the
 * velocities. */
enum { speeds = 4 };

/* The forces beside Lhat as functions of (x, x'); the gyroscopic one is U_lij x'^l x'^j. */
static void forces_of(const nh_chaplygin *f, nh_ex *out)
{
    const nh_kinetic *k = f->slice->kinetic;
    const size_t n = f->n, *shape = f->slice->shape;
    if (!f->plain) memcpy(out, f->force, n * sizeof *out);
    for (size_t i = 0; i < n && f->plain; i++) {
        out[i] = nh_int(f->dag, 0);
        for (size_t l = 0; l < n; l++)
            for (size_t j = 0; j < n; j++)
                out[i] =
                    plus(f->dag, out[i], f->U[(l * n + i) * n + j], nh_mul(f->dag, k->v[shape[l]], k->v[shape[j]]));
    }
}

static nh_ex work_of(const nh_chaplygin *f, const nh_ex *zeta, const nh_ex *force)
{
    nh_ex work = nh_int(f->dag, 0);
    for (size_t i = 0; i < f->n; i++) work = plus(f->dag, work, zeta[i], force[i]);
    return work;
}

/* zeta^i force_i at the sample points and several velocities each; *size: the largest force. */
static double *work_along(const nh_chaplygin *f, const nh_ex *zeta, size_t places, double *size)
{
    static const double factor[speeds] = {1, -1, 0, 0.5};
    const nh_kinetic *k = f->slice->kinetic;
    const nh_model *y = k->model;
    size_t n = f->n, m = k->m;
    nh_ex *in = nh_alloc_array(2 * m, sizeof *in), *e = nh_alloc_array(n + 1, sizeof *e);
    double *z = nh_alloc_array(2 * m + n + 1, sizeof *z), *value = z + 2 * m,
           *out = nh_alloc_array(places * speeds + 1, sizeof *out);
    memcpy(in, k->q, m * sizeof *in);
    memcpy(in + m, k->v, m * sizeof *in);
    forces_of(f, e);
    e[n] = work_of(f, zeta, e);
    nh_tape *tape =
        nh_tape_create(k->dag, 2 * m, in, n + 1, e, y->system->parameters, y->parameter, y->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < places * speeds; p++) {
        memcpy(z, k->place + p / speeds * m, m * sizeof *z);
        for (size_t i = 0; i < m; i++) z[m + i] = factor[p % speeds] * k->speed[p / speeds * m + i];
        nh_tape_eval(tape, work, z, value);
        *size = fmax(*size, nh_largest(n, value));
        out[p] = value[n];
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
    nh_free(e);
    nh_free(z);
    return out;
}

/* By numbers, where the exact relations are not known. */
static size_t candidates_at_places(const nh_chaplygin *f, size_t candidates, const nh_ex *field,
                                   const nh_options *options, double *c)
{
    size_t m = f->slice->m, places = places_of(f), rows = places * speeds;
    nh_ex *zeta = nh_alloc_array(f->n + 1, sizeof *zeta);
    double *a = nh_alloc_array(rows * candidates + 1, sizeof *a), size = 1e-300;
    for (size_t b = 0; b < candidates; b++) {
        if (!descend(f, field + b * m, zeta)) continue;
        double *work = work_along(f, zeta, places, &size);
        memcpy(a + b * rows, work, rows * sizeof *a);
        nh_free(work);
    }
    for (size_t i = 0; i < rows * candidates; i++) a[i] /= size;
    size_t count = nh_kernel(rows, candidates, a, options->group, c, NULL, NULL);
    nh_column_echelon(candidates, count, options->group, c);
    nh_free(a);
    nh_free(zeta);
    return count;
}

/* The work along each field: condition (ii) is that it vanishes. */
static void works(const nh_chaplygin *f, size_t candidates, const nh_ex *field, nh_ex *out)
{
    nh_ex *zeta = nh_alloc_array(2 * f->n + 1, sizeof *zeta), *force = zeta + f->n;
    forces_of(f, force);
    for (size_t b = 0; b < candidates; b++)
        out[b] = descend(f, field + b * f->slice->m, zeta) ? work_of(f, zeta, force) : nh_int(f->dag, 0);
    nh_free(zeta);
}

size_t nh_second_candidates(const nh_chaplygin *f, size_t candidates, const nh_ex *field, const nh_options *options,
                            double *c)
{
    size_t count;
    nh_ex *work = nh_alloc_array(candidates + 1, sizeof *work);
    works(f, candidates, field, work);
    if (!nh_section_combinations(f->slice->kinetic, candidates, 1, work, options, c, &count))
        count = candidates_at_places(f, candidates, field, options, c);
    nh_free(work);
    return count;
}

void nh_second_coefficients(const nh_chaplygin *f, size_t candidates, const nh_ex *field, const double *c,
                            const nh_options *options, nh_ex *exact)
{
    nh_ex *work = nh_alloc_array(candidates + 1, sizeof *work);
    works(f, candidates, field, work);
    nh_section_coefficients(f->slice->kinetic, candidates, work, c, nh_section_pivot(candidates, c), options, exact);
    nh_free(work);
}

/* The shape space with Khat and V. */
static nh_kinetic *hat_system(const nh_chaplygin *f)
{
    const nh_kinetic *k = f->slice->kinetic;
    nh_arena *arena = k->arena;
    size_t n = f->n;
    nh_kinetic *h = nh_arena_alloc(arena, sizeof *h);
    *h = (nh_kinetic){.model = k->model,
                      .dag = k->dag,
                      .arena = arena,
                      .m = n,
                      .V = f->V,
                      .quadratic = true,
                      .autonomous = true,
                      .affine = true,
                      .linear = true,
                      .metric = true,
                      .reducible = f->plain,
                      .general = true,
                      .forced = !f->plain,
                      .Q = f->force,
                      .places = k->places,
                      .time = k->time};
    h->q = nh_arena_alloc(arena, (3 * n + 1) * sizeof *h->q);
    h->v = h->q + n;
    h->a = h->v + n;
    h->K = f->K;
    h->omega = h->b = h->force = h->a; /* none */
    h->name = nh_arena_alloc(arena, (n + 1) * sizeof *h->name);
    h->angle = nh_arena_alloc(arena, (3 * n + 1) * sizeof *h->angle);
    h->dependent = h->angle + n;
    h->periodic = h->dependent + n;
    h->place = nh_arena_alloc(arena, (2 * k->places * n + 1) * sizeof *h->place);
    h->speed = h->place + k->places * n;
    for (size_t i = 0; i < n; i++) {
        size_t s = f->slice->shape[i];
        h->q[i] = k->q[s];
        h->v[i] = k->v[s];
        h->a[i] = nh_int(k->dag, 0);
        h->name[i] = k->name[s];
        h->angle[i] = k->angle[s];
        h->periodic[i] = k->periodic[s];
        for (size_t p = 0; p < k->places; p++) {
            h->place[p * n + i] = k->place[p * k->m + s];
            h->speed[p * n + i] = k->speed[p * k->m + s];
        }
    }
    return h;
}

/* (L_zeta U)_lij = zeta(U_lij) + U_sij d_l zeta^s + U_lsj d_i zeta^s + U_lis d_j zeta^s, largest over the sample
   points. */
static double lie_of_U(const nh_chaplygin *f, const nh_ex *zeta)
{
    nh_dag *d = f->dag;
    const nh_ex *x = f->slice->x;
    size_t n = f->n, cube = n * n * n, places = places_of(f), at = 0;
    nh_ex *e = nh_alloc_array(cube + 1, sizeof *e);
    double *value = nh_alloc_array(places * cube + 1, sizeof *value), worst;
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++, at++) {
                e[at] = nh_diff_along(d, f->U[at], n, x, zeta);
                for (size_t s = 0; s < n; s++) {
                    e[at] = plus(d, e[at], f->U[(s * n + i) * n + j], nh_diff(d, zeta[s], x[l]));
                    e[at] = plus(d, e[at], f->U[(l * n + s) * n + j], nh_diff(d, zeta[s], x[i]));
                    e[at] = plus(d, e[at], f->U[(l * n + i) * n + s], nh_diff(d, zeta[s], x[j]));
                }
            }
    nh_kinetic_sample(f->slice->kinetic, cube, e, places, value);
    worst = nh_largest(places * cube, value);
    nh_free(e);
    nh_free(value);
    return worst;
}

/* The same where there are more forces than the gyroscopic one: their invariance is known already; that of ahat is
 * checked. */
static void general_conditions(nh_second *s)
{
    const nh_chaplygin *f = s->first;
    size_t n = f->n, places = places_of(f);
    nh_ex *e = nh_alloc_array(2 * n + 1, sizeof *e);
    double *value = nh_alloc_array(2 * n * places + 1, sizeof *value);
    for (size_t b = 0; b < s->d; b++) {
        const nh_ex *zeta = s->action.generator[b].component;
        double size = 1e-300, most = 1e-300, *work = work_along(f, zeta, places, &size);
        s->strong = s->weak = fmax(s->weak, nh_largest(places * speeds, work) / size);
        for (size_t i = 0; i < n; i++) {
            e[i] = nh_diff_along(f->dag, f->a[i], n, f->slice->x, zeta);
            for (size_t j = 0; j < n; j++) e[i] = plus(f->dag, e[i], f->a[j], nh_diff(f->dag, zeta[j], f->slice->x[i]));
            e[n + i] = f->a[i];
        }
        nh_kinetic_sample(f->slice->kinetic, 2 * n, e, places, value);
        for (size_t p = 0; p < places; p++) most = fmax(most, nh_largest(n, value + 2 * n * p + n));
        for (size_t p = 0; p < places; p++)
            s->invariance = fmax(s->invariance, nh_largest(n, value + 2 * n * p) / most);
        nh_free(work);
    }
    nh_free(e);
    nh_free(value);
}

/* The largest relative residuals of (i), (ii) and (ii') over the sample points. */
static void conditions(nh_second *s)
{
    if (!s->first->plain) {
        general_conditions(s);
        return;
    }
    const nh_chaplygin *f = s->first;
    size_t n = f->n, places = places_of(f);
    double size = largest_U(f);
    for (size_t b = 0; b < s->d; b++) {
        const nh_ex *zeta = s->action.generator[b].component;
        double *U = interior(f, zeta, places);
        for (size_t p = 0; p < places; p++)
            for (size_t l = 0; l < n; l++)
                for (size_t j = 0; j < n; j++) {
                    double x = U[(p * n + l) * n + j], y = U[(p * n + j) * n + l];
                    s->strong = fmax(s->strong, fabs(x) / size);
                    s->weak = fmax(s->weak, fabs(x + y) / 2 / size);
                }
        nh_free(U);
        s->invariance = fmax(s->invariance, lie_of_U(f, zeta) / size);
    }
}

size_t nh_second_free(const nh_chaplygin *f, size_t d, nh_ex *field, const nh_options *options)
{
    nh_dag *dag = f->dag;
    size_t m = f->slice->m, n = d;
    const nh_kinetic *hat = hat_system(f);
    nh_generator *g = nh_alloc_array(d + 1, sizeof *g);
    nh_ex *component = nh_alloc_array(f->n + d * m + 1, sizeof *component), *sum = component + f->n;
    double *t = nh_alloc_array(d * d + 1, sizeof *t);
    bool good = true;
    for (size_t b = 0; b < d && good; b++) {
        good = descend(f, field + b * m, component);
        if (good) nh_generator_init(&g[b], hat, NULL, component, options);
    }
    if (good) {
        nh_group *group = nh_group_of(hat, d, g, options);
        n = nh_group_free_basis(group, options, t);
        nh_group_free(group);
        for (size_t i = 0; i < n * m; i++) {
            sum[i] = nh_int(dag, 0);
            for (size_t b = 0; b < d; b++)
                if (t[b + i / m * d] != 0)
                    sum[i] = plus(dag, sum[i], nh_real(dag, t[b + i / m * d]), field[b * m + i % m]);
        }
        memcpy(field, sum, n * m * sizeof *field);
    }
    nh_free(t);
    nh_free(component);
    nh_free(g);
    return n;
}

bool nh_second_init(nh_second *s, const nh_chaplygin *f, size_t d, const nh_ex *field, const nh_options *options,
                    nh_error *error)
{
    size_t n = f->n, m = f->slice->m;
    *s = (nh_second){.first = f, .hat = hat_system(f), .d = d, .n = n - d};
    nh_generator *g = nh_alloc_array(d + 1, sizeof *g);
    nh_ex *component = nh_alloc_array(n + 1, sizeof *component);
    bool good = true;
    for (size_t b = 0; b < d && good; b++) {
        good = descend(f, field + b * m, component);
        if (good) nh_generator_init(&g[b], s->hat, NULL, component, options);
    }
    if (good) nh_action_init(&s->action, s->hat, d, g, options);
    if (good) good = nh_action_check(&s->action, options, error);
    if (good) conditions(s);
    nh_free(g);
    nh_free(component);
    if (!good) return nh_fail(error, NH_NUMERIC, "", "the second group does not act on the reduced system");
    for (size_t i = 0; i < n; i++) s->magnetic |= !nh_is_zero(f->dag, f->a[i]);
    s->abelian = nh_largest(d * d * d, s->action.algebra.c) == 0;
    double *c = nh_alloc_array(d * d + 1, sizeof *c);
    bool conserved = nh_second_candidates(f, d, field, options, c) == d;
    nh_free(c);
    if (conserved && s->invariance <= options->group) return true;
    nh_fail(error, NH_INPUT, "",
            !conserved
                ? "the first stage does not conserve the momentum of the second group (relative residual %.2g)"
                : "the gyroscopic or magnetic form is not invariant under the second group (relative residual %.2g)",
            conserved ? s->invariance : s->weak);
    return nh_error_hint(error, "a cyclic coordinate of the reduced metric is not sufficient");
}

bool nh_second_renew(nh_second *out, const nh_second *s, const double *pivots, nh_error *error)
{
    const nh_slice *old = s->first->slice;
    nh_arena *arena = s->hat->arena;
    *out = *s;
    out->pivots = pivots;
    if (!pivots) return true;
    nh_slice *slice = nh_arena_alloc(arena, sizeof *slice);
    double *place = nh_arena_alloc(arena, old->m * sizeof *place);
    nh_chaplygin *first = nh_arena_alloc(arena, sizeof *first);
    nh_slice_place(old, pivots, place);
    *slice = *old;
    slice->pivots = place;
    if (!nh_chaplygin_init(first, slice, error)) return false;
    out->first = first;
    out->hat = nh_arena_alloc(arena, sizeof *out->hat);
    *out->hat = *s->hat;
    out->hat->K = first->K;
    out->hat->V = first->V;
    out->hat->Q = first->force;
    out->action.kinetic = out->hat;
    return true;
}

void nh_second_clear(nh_second *s) { nh_action_clear(&s->action); }
