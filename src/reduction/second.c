#include "reduction/second.h"

#include <math.h>
#include <string.h>

#include "expr/diff.h"
#include "expr/normal.h"
#include "expr/solve.h"
#include "reduction/subspace.h"

enum { most_places = 16 };

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

/* field = zeta^i d_i + c^a e_a on the slice: c from the rows of the group's coordinates. */
bool nh_second_descend(const nh_chaplygin *f, const nh_ex *field, nh_ex *out)
{
    const nh_slice *s = f->slice;
    nh_dag *d = f->dag;
    size_t n = f->n, g = f->d;
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

/* zeta^i U_lij at the sample points: out[(p*n + l)*n + j]. */
static double *interior(const nh_chaplygin *f, const nh_ex *zeta, size_t places)
{
    size_t n = f->n, at = 0;
    nh_ex *e = nh_alloc_array(n * n, sizeof *e);
    double *out = nh_alloc_array(places * n * n + 1, sizeof *out);
    for (size_t l = 0; l < n; l++)
        for (size_t j = 0; j < n; j++, at++) {
            e[at] = nh_int(f->dag, 0);
            for (size_t i = 0; i < n; i++) e[at] = plus(f->dag, e[at], zeta[i], f->U[(l * n + i) * n + j]);
        }
    nh_kinetic_sample(f->slice->kinetic, n * n, e, places, out);
    nh_free(e);
    return out;
}

static size_t places_of(const nh_chaplygin *f) { return f->slice->kinetic->places < most_places ? f->slice->kinetic->places : most_places; }

static double largest_U(const nh_chaplygin *f)
{
    size_t places = places_of(f), cube = f->n * f->n * f->n;
    double *U = nh_alloc_array(places * cube + 1, sizeof *U), most;
    nh_kinetic_sample(f->slice->kinetic, cube, f->U, places, U);
    most = nh_largest(places * cube, U);
    nh_free(U);
    return most > 0 ? most : 1;
}

size_t nh_second_candidates(const nh_chaplygin *f, size_t candidates, const nh_ex *field, const nh_options *options, double *c)
{
    size_t n = f->n, m = f->slice->m, places = places_of(f), rows = places * n * n;
    nh_ex *zeta = nh_alloc_array(n + 1, sizeof *zeta);
    double *a = nh_alloc_array(rows * candidates + 1, sizeof *a), size = largest_U(f);
    for (size_t b = 0; b < candidates; b++) {
        if (!nh_second_descend(f, field + b * m, zeta)) continue;
        double *U = interior(f, zeta, places);
        for (size_t p = 0; p < places; p++)
            for (size_t l = 0; l < n; l++)
                for (size_t j = 0; j < n; j++) a[(p * n + l) * n + j + b * rows] = (U[(p * n + l) * n + j] + U[(p * n + j) * n + l]) / size;
        nh_free(U);
    }
    size_t count = nh_kernel(rows, candidates, a, options->group, c, NULL, NULL);
    nh_column_echelon(candidates, count, options->group, c);
    nh_free(a);
    nh_free(zeta);
    return count;
}

/* The shape space with Khat and V. */
static nh_kinetic *hat_system(const nh_chaplygin *f)
{
    const nh_kinetic *k = f->slice->kinetic;
    nh_arena *arena = k->arena;
    size_t n = f->n;
    nh_kinetic *h = nh_arena_alloc(arena, sizeof *h);
    *h = (nh_kinetic){.model = k->model, .dag = k->dag, .arena = arena, .m = n, .V = f->V, .quadratic = true, .autonomous = true, .affine = true, .linear = true,
                      .metric = true, .reducible = true, .general = true, .places = k->places, .time = k->time};
    h->q = nh_arena_alloc(arena, (3 * n + 1) * sizeof *h->q);
    h->v = h->q + n;
    h->a = h->v + n;
    h->K = f->K;
    h->omega = h->b = h->force = h->a; /* none */
    h->name = nh_arena_alloc(arena, (n + 1) * sizeof *h->name);
    h->angle = nh_arena_alloc(arena, (2 * n + 1) * sizeof *h->angle);
    h->dependent = h->angle + n;
    h->place = nh_arena_alloc(arena, (2 * k->places * n + 1) * sizeof *h->place);
    h->speed = h->place + k->places * n;
    for (size_t i = 0; i < n; i++) {
        size_t s = f->slice->shape[i];
        h->q[i] = k->q[s];
        h->v[i] = k->v[s];
        h->a[i] = nh_int(k->dag, 0);
        h->name[i] = k->name[s];
        h->angle[i] = k->angle[s];
        for (size_t p = 0; p < k->places; p++) {
            h->place[p * n + i] = k->place[p * k->m + s];
            h->speed[p * n + i] = k->speed[p * k->m + s];
        }
    }
    return h;
}

/* (L_zeta U)_lij = zeta(U_lij) + U_sij d_l zeta^s + U_lsj d_i zeta^s + U_lis d_j zeta^s, largest over the sample points. */
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

static void conditions(nh_second *s)
{
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

bool nh_second_init(nh_second *s, const nh_chaplygin *f, size_t d, const nh_ex *field, const nh_options *options, nh_error *error)
{
    size_t n = f->n, m = f->slice->m;
    *s = (nh_second){.first = f, .hat = hat_system(f), .d = d, .n = n - d};
    nh_generator *g = nh_alloc_array(d + 1, sizeof *g);
    nh_ex *component = nh_alloc_array(n + 1, sizeof *component);
    bool good = true;
    for (size_t b = 0; b < d && good; b++) {
        good = nh_second_descend(f, field + b * m, component);
        if (good) nh_generator_init(&g[b], s->hat, NULL, component, options);
    }
    if (good) nh_action_init(&s->action, s->hat, d, g, options);
    if (good) good = nh_action_check(&s->action, options, error);
    if (good) conditions(s);
    nh_free(g);
    nh_free(component);
    if (!good) return nh_fail(error, NH_NUMERIC, "", "the second group does not act on the reduced system");
    s->abelian = nh_largest(d * d * d, s->action.algebra.c) == 0;
    if (s->weak <= options->group && s->invariance <= options->group) return true;
    nh_fail(error, NH_INPUT, "", s->weak > options->group ? "the momentum of the second group is not conserved: its field enters the gyroscopic form (off by %.2g of its size)"
                                                          : "the gyroscopic form is not invariant under the second group (off by %.2g of its size)",
            fmax(s->weak, s->invariance));
    return nh_error_hint(error, "a cyclic coordinate of the reduced metric is not enough");
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
    out->action.kinetic = out->hat;
    return true;
}

void nh_second_clear(nh_second *s) { nh_action_clear(&s->action); }

/* ---- equations ---- */

static nh_ex tidy(const nh_second *s, nh_ex e) { return s->slice.tidy ? nh_simplify(s->slice.dag, e) : e; }

static bool connection(nh_second *s)
{
    const nh_slice *c = &s->slice;
    nh_dag *d = c->dag;
    size_t n = s->n, g = s->d, m = c->m;
    nh_ex *b = nh_alloc_array(g + 1, sizeof *b);
    for (size_t a = 0; a < g * g; a++) s->inertia[a] = c->K[(n + a / g) * m + n + a % g];
    nh_lu *lu = nh_lu_create(d, g, s->inertia, nh_slice_pivot_score, &s->slice, NULL);
    for (size_t i = 0; i < n && lu; i++) {
        for (size_t a = 0; a < g; a++) b[a] = c->K[(n + a) * m + i];
        nh_lu_solve(lu, b, b);
        for (size_t a = 0; a < g; a++) s->Av[a * n + i] = tidy(s, b[a]);
    }
    for (size_t i = 0; i < n && lu; i++)
        for (size_t j = 0; j <= i; j++) { /* Av^T I Av = Av^T Khat_ex */
            nh_ex e = c->K[i * m + j];
            for (size_t a = 0; a < g; a++) e = plus(d, e, nh_neg(d, s->Av[a * n + i]), c->K[(n + a) * m + j]);
            s->Kt[i * n + j] = s->Kt[j * n + i] = tidy(s, e);
        }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(b);
    return good;
}

static void curvature(nh_second *s)
{
    nh_dag *d = s->slice.dag;
    const nh_algebra *g = &s->action.algebra;
    size_t n = s->n;
    for (size_t a = 0; a < s->d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++) {
                nh_ex e = nh_sub(d, nh_diff(d, s->Av[a * n + j], s->slice.x[i]), nh_diff(d, s->Av[a * n + i], s->slice.x[j]));
                for (size_t b = 0; b < s->d; b++)
                    for (size_t k = 0; k < s->d; k++) {
                        double c = g->c[(b * s->d + k) * s->d + a];
                        if (c != 0) e = plus(d, e, nh_real(d, -c), nh_mul(d, s->Av[b * n + i], s->Av[k * n + j]));
                    }
                e = tidy(s, e);
                s->Bv[(a * n + i) * n + j] = e;
                s->Bv[(a * n + j) * n + i] = nh_neg(d, e);
            }
}

/* g_r = Fr^i_r U_kij xhat'^k xhat'^j on the slice, xhat' = Fr (x', zeta). */
static void gyroscopic(const nh_second *s, const nh_ex *u, nh_ex *g)
{
    const nh_slice *c = &s->slice;
    const nh_chaplygin *f = s->first;
    nh_dag *d = c->dag;
    size_t m = c->m, n = c->n;
    nh_ex *speed = nh_alloc_array(2 * m + 2 * s->d + 1, sizeof *speed), *force = speed + m, *from = force + m, *to = from + s->d;
    for (size_t a = 0; a < s->d; a++) {
        from[a] = s->hat->q[c->along[a]];
        to[a] = c->y[a];
    }
    for (size_t i = 0; i < m; i++) speed[i] = nh_int(d, 0);
    for (size_t i = 0; i < n; i++) speed[c->shape[i]] = u[i];
    for (size_t i = 0; i < m; i++)
        for (size_t a = 0; a < s->d; a++) speed[i] = plus(d, speed[i], c->E[i * s->d + a], u[n + a]);
    for (size_t i = 0; i < m; i++) {
        force[i] = nh_int(d, 0);
        for (size_t k = 0; k < m; k++)
            for (size_t j = 0; j < m; j++) {
                nh_ex U = f->U[(k * m + i) * m + j];
                if (!nh_is_zero(d, U)) force[i] = plus(d, force[i], nh_substitute(d, U, s->d, from, to), nh_mul(d, speed[k], speed[j]));
            }
    }
    for (size_t i = 0; i < n; i++) g[i] = force[c->shape[i]];
    for (size_t a = 0; a < s->d; a++) {
        g[n + a] = nh_int(d, 0);
        for (size_t i = 0; i < m; i++) g[n + a] = plus(d, g[n + a], c->E[i * s->d + a], force[i]);
    }
    nh_free(speed);
}

/* U_kij of the first stage on the horizontal vectors h_i = d_i - Av^a_i e_a. */
static void horizontal_form(nh_second *s)
{
    const nh_slice *c = &s->slice;
    nh_dag *d = c->dag;
    size_t m = c->m, n = c->n, cube = m * m * m;
    nh_ex *h = nh_alloc_array(m * n + cube + s->d + 1, sizeof *h), *U = h + m * n, *from = U + cube;
    for (size_t a = 0; a < s->d; a++) from[a] = s->hat->q[c->along[a]];
    for (size_t i = 0; i < cube; i++) U[i] = nh_substitute(d, s->first->U[i], s->d, from, c->y);
    for (size_t r = 0; r < m; r++)
        for (size_t i = 0; i < n; i++) {
            h[r * n + i] = nh_int(d, c->shape[i] == r);
            for (size_t a = 0; a < s->d; a++) h[r * n + i] = plus(d, h[r * n + i], nh_neg(d, c->E[r * s->d + a]), s->Av[a * n + i]);
        }
    for (size_t at = 0; at < n * n * n; at++) {
        size_t k = at / (n * n), i = at / n % n, j = at % n;
        s->U[at] = nh_int(d, 0);
        for (size_t r = 0; r < cube; r++) {
            size_t a = r / (m * m), b = r / m % m, e = r % m;
            if (!nh_is_zero(d, U[r])) s->U[at] = plus(d, s->U[at], nh_mul(d, U[r], h[a * n + k]), nh_mul(d, h[b * n + i], h[e * n + j]));
        }
    }
    nh_free(h);
}

static void names(nh_second *s)
{
    nh_reduced *o = &s->reduced;
    nh_arena *arena = s->hat->arena;
    for (size_t i = 0; i < s->n; i++) {
        size_t c = s->slice.shape[i];
        o->w[i] = o->dx[i] = s->hat->v[c];
        o->momentum[i] = nh_arena_printf(arena, "p_%s", s->hat->name[c]);
    }
    for (size_t a = 0; a < s->d; a++) {
        o->w[s->n + a] = nh_symbol_fresh(s->slice.dag, nh_arena_printf(arena, "v%zu", a + 1));
        o->momentum[s->n + a] = nh_arena_printf(arena, "m_%zu", a + 1);
    }
}

/* The force on pt_i: without the gyroscopic form of the first stage. */
static nh_ex shape_force(const nh_second *s, size_t i, const nh_ex *momentum)
{
    const nh_reduced *o = &s->reduced;
    nh_dag *d = s->slice.dag;
    const nh_algebra *g = &s->action.algebra;
    size_t n = s->n, dim = s->d;
    nh_ex x = s->slice.x[i], sum = nh_neg(d, nh_diff(d, s->slice.V, x)), half = nh_ratio(d, 1, 2);
    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++) sum = plus(d, sum, nh_mul(d, half, nh_diff(d, s->Kt[a * n + b], x)), nh_mul(d, o->w[a], o->w[b]));
    for (size_t a = 0; a < dim; a++) {
        for (size_t b = 0; b < dim; b++) sum = plus(d, sum, nh_mul(d, half, nh_diff(d, s->inertia[a * dim + b], x)), nh_mul(d, o->w[n + a], o->w[n + b]));
        for (size_t j = 0; j < n; j++) sum = plus(d, sum, s->Bv[(a * n + i) * n + j], nh_mul(d, momentum[a], o->w[j]));
        for (size_t l = 0; l < dim; l++)
            for (size_t k = 0; k < dim; k++) {
                double c = g->c[(l * dim + k) * dim + a];
                if (c != 0) sum = plus(d, sum, nh_mul(d, nh_real(d, c), s->Av[l * n + i]), nh_mul(d, momentum[a], o->w[n + k]));
            }
    }
    return sum;
}

/* The slice of the shape space, and the first stage's connection on it. */
static void guard(nh_second *s)
{
    const nh_reduced *first = &s->first->reduced;
    nh_reduced *o = &s->reduced;
    nh_guard *g = &o->guard[0];
    size_t d = s->d, n = first->guard[0].rows * first->guard[0].columns;
    nh_ex *from = nh_alloc_array(d + 1, sizeof *from);
    for (size_t a = 0; a < d; a++) from[a] = s->hat->q[s->slice.along[a]];
    nh_reduced_guard_slice(o, &s->slice);
    *g = first->guard[0];
    g->e = nh_arena_alloc(s->hat->arena, (n + 1) * sizeof *g->e);
    for (size_t i = 0; i < n; i++) g->e[i] = nh_substitute(s->slice.dag, first->guard[0].e[i], d, from, s->slice.y);
    nh_free(from);
}

static void equations(nh_second *s)
{
    nh_reduced *o = &s->reduced;
    nh_dag *d = s->slice.dag;
    const nh_algebra *g = &s->action.algebra;
    size_t n = s->n, dim = s->d, r = n + dim;
    nh_reduced_init(o, s->hat, n, s->slice.x, r, dim);
    names(s);
    nh_ex *u = nh_alloc_array(2 * r + dim + 1, sizeof *u), *ups = u + r, *momentum = ups + r;
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < r; j++)
            o->M[i * r + j] = i < n && j < n ? s->Kt[i * n + j] : i >= n && j >= n ? s->inertia[(i - n) * dim + j - n] : nh_int(d, 0);
    for (size_t i = 0; i < n; i++) u[i] = o->w[i];
    for (size_t a = 0; a < dim; a++) {
        o->zeta[a] = o->w[n + a];
        for (size_t i = 0; i < n; i++) o->zeta[a] = plus(d, o->zeta[a], nh_neg(d, s->Av[a * n + i]), o->w[i]);
        u[n + a] = o->zeta[a];
        momentum[a] = nh_int(d, 0);
        for (size_t b = 0; b < dim; b++) momentum[a] = plus(d, momentum[a], s->inertia[a * dim + b], o->w[n + b]);
    }
    gyroscopic(s, u, ups);
    for (size_t i = 0; i < n; i++) {
        o->F[i] = nh_add(d, shape_force(s, i, momentum), ups[i]);
        for (size_t a = 0; a < dim; a++) o->F[i] = plus(d, o->F[i], nh_neg(d, s->Av[a * n + i]), ups[n + a]);
    }
    for (size_t b = 0; b < dim; b++)
        for (size_t a = 0; a < dim; a++)
            for (size_t k = 0; k < dim; k++) {
                double c = g->c[(a * dim + b) * dim + k];
                if (c != 0) o->F[n + b] = plus(d, o->F[n + b], nh_mul(d, nh_real(d, c), o->zeta[a]), momentum[k]);
            }
    guard(s);
    o->energy = s->slice.V;
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < r; j++) o->energy = plus(d, o->energy, nh_mul(d, nh_ratio(d, 1, 2), o->M[i * r + j]), nh_mul(d, o->w[i], o->w[j]));
    nh_free(u);
}

/* rank of C_ab^k m_k at a generic m. */
static size_t orbit_dimension(const nh_algebra *g)
{
    size_t d = g->d;
    double *a = nh_alloc_array(d * d + 1, sizeof *a), *u = nh_alloc_array(d * d + 1, sizeof *u);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            for (size_t k = 0; k < d; k++) a[i + j * d] += g->c[(i * d + j) * d + k] * (0.7 + 0.31 * (double)k * (double)(k + 1));
    size_t rank = nh_span(d, d, a, 1e-9, u);
    nh_free(a);
    nh_free(u);
    return rank;
}

bool nh_second_equations(nh_second *s, const size_t *shape, const size_t *along, const double *y0, nh_error *error)
{
    nh_arena *arena = s->hat->arena;
    size_t n = s->n, d = s->d;
    nh_slice_init(&s->slice, &s->action, shape, along, y0);
    s->slice.pivots = s->pivots;
    s->inertia = nh_arena_alloc(arena, (d * d + d * n + n * n + d * n * n + n * n * n + 1) * sizeof *s->inertia);
    s->Av = s->inertia + d * d;
    s->Kt = s->Av + d * n;
    s->Bv = s->Kt + n * n;
    s->U = s->Bv + d * n * n;
    if (!connection(s)) return nh_fail(error, NH_NUMERIC, "", "the locked inertia of the second group is singular");
    curvature(s);
    horizontal_form(s);
    equations(s);
    s->orbit = orbit_dimension(&s->action.algebra);
    return true;
}
