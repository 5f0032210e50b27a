/* turned_translations: translations and what turns them, from values modulo a prime; each equation is then proved.
 * [docs/method.md, sec. 10, (30a)]
 *
 *     sample           rows at random points and velocities; unknowns  B_ij (c x c), then xi^s (m)
 *     find_turnings    null space; short fractions; keeps_rates, keeps_accelerations prove [R, Gamma] = 0
 *     is_tangent       on leaves: R and d/da_j tangent to them, B of what is tangent invertible */
#include "count/turned_translations.h"

#include <flint/nmod_mat.h>
#include <string.h>

#include "count/adapted_frame.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

enum { points = 4, velocities = 3, samples = points * velocities, attempts = 40, largest_proof = 5000 };

/* A symmetry R: how it turns the a, and its constant components. */
typedef struct {
    nh_ex *B, *xi;              /* c x c; m */
    nh_residue *turn, *residue; /* the same modulo the prime of the samples */
} turning;

typedef struct {
    nh_jet_equations *x;
    nh_arena *arena;
    nh_prime field;
    size_t m, n, cyclic;
    size_t *a; /* indices of the cyclic coordinates */
    /* w^l is the rate of this coordinate (m: of none): then R(w^l) = Gamma(R(q)), otherwise it is 0 */
    size_t *owner;
    nh_residue *row;       /* samples x equations x unknowns */
    size_t rows, unknowns; /* B_ij, then xi^s */
    size_t count;
    turning *turning;
    bool *translated; /* is a_i turned? */
} algebra;

static nh_ex coordinate(const algebra *g, size_t s) { return g->x->coordinate[g->x->time + s]; }

static bool vanishes(const nh_jet_equations *x, nh_ex e)
{
    return nh_normal_is_zero(x->dag, e, largest_proof) == NH_ZERO;
}

/* ---- the equations for B and xi, at random points ---- */

/* Values at a point, and their slopes along the coordinates: series of first order. */
typedef struct {
    nh_jet_ring *ring;
    nh_residue *field, *M, *coefficient; /* fields x coordinates; n x n; monomials x n */
} point;

/* The same at a velocity, as numbers. */
typedef struct {
    nh_residue *rate, *rate_slope, *rate_along, *R; /* m; m x m; m: Gamma of it at fixed w; m x n */
    nh_residue *M, *M_slope, *A, *A_slope, *A_by_w; /* n x n; n x n x m; n; n x m; n x n */
} values;

/* The derivative of a series along coordinate k. */
static nh_residue slope(const algebra *g, const nh_jet_ring *ring, const nh_residue *series, size_t k)
{
    return series[ring->up[(g->x->time + k) * ring->size]];
}

/* rate = b + R w and its slopes, M, A = coefficients times monomials of w, and dA/dw, at one velocity. */
static values values_at(const algebra *g, const point *p, const nh_residue *w)
{
    nh_prime f = g->field;
    const nh_jet_equations *x = g->x;
    size_t m = g->m, n = g->n, e = p->ring->size, first = x->time;
    values v = {.rate = nh_arena_alloc(g->arena, (m + m * m + m + m * n + 1) * sizeof *v.rate),
                .M = nh_arena_alloc(g->arena, (n * n * (1 + m) + n * (1 + m) + n * n + 1) * sizeof *v.M)};
    v.rate_slope = v.rate + m;
    v.rate_along = v.rate_slope + m * m;
    v.R = v.rate_along + m;
    v.M_slope = v.M + n * n;
    v.A = v.M_slope + n * n * m;
    v.A_slope = v.A + n;
    v.A_by_w = v.A_slope + n * m;
    for (size_t s = 0; s < m; s++) {
        nh_residue by_time = 0;
        for (size_t i = 0; i < x->fields; i++) {
            const nh_residue *X = p->field + (i * x->coordinates + first + s) * e;
            nh_residue factor = i < n ? w[i] : 1;
            if (i < n) v.R[s * n + i] = X[0];
            v.rate[s] = nh_residue_add(f, v.rate[s], nh_residue_mul(f, factor, X[0]));
            for (size_t k = 0; k < m; k++)
                v.rate_slope[s * m + k] =
                    nh_residue_add(f, v.rate_slope[s * m + k], nh_residue_mul(f, factor, slope(g, p->ring, X, k)));
            if (x->time) by_time = nh_residue_add(f, by_time, nh_residue_mul(f, factor, X[p->ring->up[0]]));
        }
        v.rate_along[s] = by_time;
    }
    for (size_t s = 0; s < m; s++)
        for (size_t k = 0; k < m; k++)
            v.rate_along[s] = nh_residue_add(f, v.rate_along[s], nh_residue_mul(f, v.rate[k], v.rate_slope[s * m + k]));
    for (size_t i = 0; i < n * n; i++) {
        v.M[i] = p->M[i * e];
        for (size_t k = 0; k < m; k++) v.M_slope[i * m + k] = slope(g, p->ring, p->M + i * e, k);
    }
    size_t mu = 0;
    for (size_t i = 0; i <= n; i++)
        for (size_t j = i; j <= n; j++) { /* 1, w^j, w^i w^j: index 0 is the factor 1 */
            nh_residue first_factor = i ? w[i - 1] : 1, second = j ? w[j - 1] : 1,
                       power = nh_residue_mul(f, first_factor, second);
            for (size_t l = 0; l < n; l++) {
                const nh_residue *c = p->coefficient + (mu * n + l) * e;
                v.A[l] = nh_residue_add(f, v.A[l], nh_residue_mul(f, power, c[0]));
                for (size_t k = 0; k < m; k++)
                    v.A_slope[l * m + k] =
                        nh_residue_add(f, v.A_slope[l * m + k], nh_residue_mul(f, power, slope(g, p->ring, c, k)));
                if (i)
                    v.A_by_w[l * n + i - 1] =
                        nh_residue_add(f, v.A_by_w[l * n + i - 1], nh_residue_mul(f, second, c[0]));
                if (j)
                    v.A_by_w[l * n + j - 1] =
                        nh_residue_add(f, v.A_by_w[l * n + j - 1], nh_residue_mul(f, first_factor, c[0]));
            }
            mu++;
        }
    return v;
}

/* The equations [R, Gamma] = 0 at one point and velocity: R of the rates, of M and of A, where R(w) = E w follows from
 * the rates that are velocities:
 *
 *     R(q_s') = Gamma(R(q_s)),   R(M) + E^T M + M E = 0,   R(A) + E^T A = M Gamma(E w) at fixed w */
static void add_equations(algebra *g, const values *v)
{
    nh_prime f = g->field;
    size_t m = g->m, n = g->n, c = g->cyclic;
    for (size_t u = 0; u < g->unknowns; u++) {
        nh_residue *row = g->row + g->rows * g->unknowns + u;
        if (u >= c * c) {
            size_t k = u - c * c;
            for (size_t s = 0; s < m; s++, row += g->unknowns) *row = v->rate_slope[s * m + k];
            for (size_t i = 0; i < n * n; i++, row += g->unknowns) *row = v->M_slope[i * m + k];
            for (size_t i = 0; i < n; i++, row += g->unknowns) *row = v->A_slope[i * m + k];
            continue;
        }
        size_t to = g->a[u / c], from = g->a[u % c], l = 0;
        while (l < n && g->owner[l] != to) l++;
        const nh_residue *E = v->R + from * n;
        for (size_t s = 0; s < m; s++, row += g->unknowns) {
            nh_residue r = l < n ? nh_residue_mul(f, v->R[s * n + l], v->rate[from]) : 0;
            *row = s == to ? nh_residue_sub(f, r, v->rate[from]) : r;
        }
        for (size_t i = 0; i < n * n; i++, row += g->unknowns)
            if (l < n)
                *row = nh_residue_add(f, nh_residue_mul(f, E[i / n], v->M[l * n + i % n]),
                                      nh_residue_mul(f, E[i % n], v->M[i / n * n + l]));
        for (size_t i = 0; i < n && l < n; i++, row += g->unknowns) {
            nh_residue r = nh_residue_add(f, nh_residue_mul(f, v->A_by_w[i * n + l], v->rate[from]),
                                          nh_residue_mul(f, E[i], v->A[l]));
            *row = nh_residue_sub(f, r, nh_residue_mul(f, v->M[i * n + l], v->rate_along[from]));
        }
    }
    g->rows += m + n * n + n;
}

static bool sample_at_point(algebra *g, uint64_t *random)
{
    nh_jet_equations *x = g->x;
    size_t n = g->n, monomials = nh_jet_equations_monomials(n);
    size_t *one = nh_arena_alloc(g->arena, (x->coordinates + 1) * sizeof *one);
    for (size_t k = 0; k < x->coordinates; k++) one[k] = 1;
    point p = {.ring = nh_jet_ring_create(g->field, x->coordinates, one, 1)};
    size_t e = p.ring->size;
    nh_residue *q = nh_arena_alloc(g->arena, (x->coordinates * e + 1) * sizeof *q),
               *w = nh_arena_alloc(g->arena, (n + 1) * sizeof *w);
    p.field = nh_arena_alloc(g->arena, (x->fields * x->coordinates * e + 1) * sizeof *p.field);
    p.M = nh_arena_alloc(g->arena, (n * n * e + 1) * sizeof *p.M);
    p.coefficient = nh_arena_alloc(g->arena, (monomials * n * e + 1) * sizeof *p.coefficient);
    for (size_t k = 0; k < x->coordinates; k++) {
        q[k * e] = x->at[k];
        q[k * e + p.ring->up[k * e]] = 1;
    }
    nh_jet_eval *v = nh_jet_equations_eval(x, p.ring, q);
    bool good = nh_jet_equations_fields(x, p.ring, q, p.field) && nh_jet_eval_all(v, n * n, x->M, p.M) &&
                nh_jet_eval_all(v, monomials * n, x->coefficient, p.coefficient);
    nh_jet_eval_free(v);
    for (size_t b = 0; b < velocities && good; b++) {
        for (size_t i = 0; i < n; i++) w[i] = nh_residue_random(g->field, random);
        values at = values_at(g, &p, w);
        add_equations(g, &at);
    }
    nh_jet_ring_free(p.ring);
    return good;
}

/* False: no points were found, or the linear system is too large, with more than about ten cyclic coordinates. */
static bool sample(algebra *g)
{
    enum { largest = 300000 };
    nh_jet_equations *x = g->x;
    size_t taken = 0, equations = g->m + g->n * g->n + g->n;
    uint64_t random = 161803;
    g->field = nh_jet_point_prime(x->point, 0);
    g->unknowns = g->cyclic * g->cyclic + g->m;
    if (samples * equations * g->unknowns > largest) return false;
    g->row = nh_arena_alloc(g->arena, (samples * equations * g->unknowns + 1) * sizeof *g->row);
    for (size_t a = 0; a < attempts && taken < points && !x->obstacle; a++) {
        nh_jet_equations_choose(x, g->field, 31 + a);
        taken += sample_at_point(g, &random);
    }
    return taken == points && !x->obstacle;
}

/* ---- proofs ---- */

/* R(w^l) = B_ij a_j' for the coordinate a_i whose rate w^l is; else 0. */
static nh_ex R_of_velocity(const algebra *g, const turning *t, size_t l)
{
    nh_dag *d = g->x->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < g->cyclic; i++)
        for (size_t j = 0; j < g->cyclic && g->a[i] == g->owner[l]; j++)
            if (t->turn[i * g->cyclic + j])
                sum = nh_add(d, sum, nh_mul(d, t->B[i * g->cyclic + j], g->x->rho[g->a[j]]));
    return sum;
}

/* R(e), with R(w) given. */
static nh_ex R_of(const algebra *g, const turning *t, const nh_ex *Rw, nh_ex e)
{
    nh_dag *d = g->x->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < g->m; s++)
        if (t->residue[s]) sum = nh_add(d, sum, nh_mul(d, t->xi[s], nh_diff(d, e, coordinate(g, s))));
    for (size_t l = 0; l < g->n; l++)
        if (!nh_is_zero(d, Rw[l])) sum = nh_add(d, sum, nh_mul(d, Rw[l], nh_diff(d, e, g->x->w[l])));
    return sum;
}

/* R(q_s') - Gamma(R(q_s)) vanishes for every coordinate. */
static bool keeps_rates(const algebra *g, const turning *t, const nh_ex *Rw)
{
    nh_dag *d = g->x->dag;
    bool good = true;
    for (size_t s = 0; s < g->m && good; s++) {
        nh_ex rest = R_of(g, t, Rw, g->x->rho[s]);
        for (size_t i = 0; i < g->cyclic; i++)
            for (size_t j = 0; j < g->cyclic && g->a[i] == s; j++)
                if (t->turn[i * g->cyclic + j])
                    rest = nh_sub(d, rest, nh_mul(d, t->B[i * g->cyclic + j], g->x->rho[g->a[j]]));
        good = vanishes(g->x, rest);
    }
    return good;
}

/* R(A) + E^T A - M Gamma(E w) and R(M) + E^T M + M E vanish. */
static bool keeps_accelerations(const algebra *g, const turning *t, const nh_ex *Rw)
{
    const nh_jet_equations *x = g->x;
    nh_dag *d = x->dag;
    size_t n = g->n;
    bool good = true;
    for (size_t i = 0; i < n && good; i++) {
        nh_ex force = R_of(g, t, Rw, x->A[i]);
        for (size_t l = 0; l < n; l++) {
            nh_ex E = nh_diff(d, Rw[l], x->w[i]), along = nh_diff(d, Rw[l], x->model->system->t);
            for (size_t k = 0; k < g->m; k++)
                along = nh_add(d, along, nh_mul(d, x->rho[k], nh_diff(d, Rw[l], coordinate(g, k))));
            force = nh_add(d, force, nh_mul(d, E, x->A[l]));
            force = nh_sub(d, force, nh_mul(d, x->M[i * n + l], along));
        }
        good = vanishes(x, force);
        for (size_t j = i; j < n && good; j++) {
            nh_ex metric = R_of(g, t, Rw, x->M[i * n + j]);
            for (size_t l = 0; l < n; l++) {
                metric = nh_add(d, metric, nh_mul(d, nh_diff(d, Rw[l], x->w[i]), x->M[l * n + j]));
                metric = nh_add(d, metric, nh_mul(d, nh_diff(d, Rw[l], x->w[j]), x->M[i * n + l]));
            }
            good = vanishes(x, metric);
        }
    }
    return good;
}

/* The number that a residue stands for; false: it is no short fraction. */
static bool number(const algebra *g, nh_residue r, nh_ex *out)
{
    enum { longest = 100 };
    int64_t top, bottom;
    if (!nh_residue_fraction(g->field, r, longest, &top, &bottom)) return false;
    *out = nh_ratio(g->x->dag, top, bottom);
    return true;
}

/* The symmetries among the solutions, and what they turn. */
static void find_turnings(algebra *g)
{
    size_t c = g->cyclic;
    nmod_mat_t rows, solutions;
    nmod_mat_init(rows, (slong)g->rows, (slong)g->unknowns, g->field.p);
    nmod_mat_init(solutions, (slong)g->unknowns, (slong)g->unknowns, g->field.p);
    for (size_t i = 0; i < g->rows * g->unknowns; i++)
        nmod_mat_entry(rows, i / g->unknowns, i % g->unknowns) = g->row[i];
    size_t found = (size_t)nmod_mat_nullspace(solutions, rows);
    g->turning = nh_arena_alloc(g->arena, (found + 1) * sizeof *g->turning);
    nh_ex *Rw = nh_arena_alloc(g->arena, (g->n + 1) * sizeof *Rw);
    for (size_t k = 0; k < found; k++) {
        turning t = {.B = nh_arena_alloc(g->arena, (g->unknowns + 1) * sizeof *t.B),
                     .turn = nh_arena_alloc(g->arena, (g->unknowns + 1) * sizeof *t.turn)};
        t.xi = t.B + c * c;
        t.residue = t.turn + c * c;
        bool good = true;
        for (size_t u = 0; u < g->unknowns && good; u++) {
            t.turn[u] = (nh_residue)nmod_mat_entry(solutions, u, k);
            good = number(g, t.turn[u], &t.B[u]);
        }
        for (size_t l = 0; l < g->n && good; l++) Rw[l] = R_of_velocity(g, &t, l);
        if (!good || !keeps_rates(g, &t, Rw) || !keeps_accelerations(g, &t, Rw)) continue;
        g->turning[g->count++] = t;
        for (size_t i = 0; i < c * c; i++) g->translated[i / c] |= t.turn[i] != 0;
    }
    nmod_mat_clear(solutions);
    nmod_mat_clear(rows);
}

/* ---- leaves ---- */

/* B of a random combination of the fields that are tangent to the leaf, on which the covectors `across` vanish. */
static void tangent_turn(const algebra *g, size_t across, const nh_residue *covector, size_t rows, const size_t *place,
                         nmod_mat_t B)
{
    size_t first = g->x->time, all = g->m + first;
    uint64_t random = 2718281;
    nmod_mat_t conditions, tangent;
    nmod_mat_init(conditions, (slong)across, (slong)g->count, g->field.p);
    nmod_mat_init(tangent, (slong)g->count, (slong)g->count, g->field.p);
    for (size_t l = 0; l < across; l++)
        for (size_t k = 0; k < g->count; k++)
            for (size_t s = 0; s < g->m; s++)
                nmod_mat_entry(conditions, l, k) =
                    nh_residue_add(g->field, (nh_residue)nmod_mat_entry(conditions, l, k),
                                   nh_residue_mul(g->field, covector[l * all + first + s], g->turning[k].residue[s]));
    slong free = nmod_mat_nullspace(tangent, conditions);
    for (slong f = 0; f < free; f++) {
        nh_residue weight = nh_residue_random(g->field, &random);
        for (size_t k = 0; k < g->count; k++) {
            nh_residue factor = nh_residue_mul(g->field, weight, (nh_residue)nmod_mat_entry(tangent, k, f));
            for (size_t i = 0; i < rows * rows; i++)
                nmod_mat_entry(B, i / rows, i % rows) =
                    nh_residue_add(g->field, (nh_residue)nmod_mat_entry(B, i / rows, i % rows),
                                   nh_residue_mul(g->field, factor,
                                                  g->turning[k].turn[place[i / rows] * g->cyclic + place[i % rows]]));
        }
    }
    nmod_mat_clear(tangent);
    nmod_mat_clear(conditions);
}

/* Are the translations tangent to the leaf, and turned by something tangent with an invertible B? */
static bool is_solvable(const algebra *g, size_t across, const nh_residue *covector)
{
    size_t first = g->x->time, all = g->m + first, rows = 0, *place = nh_alloc_array(g->cyclic + 1, sizeof *place);
    bool good = true;
    for (size_t i = 0; i < g->cyclic; i++)
        if (g->translated[i]) place[rows++] = i;
    for (size_t l = 0; l < across && good; l++)
        for (size_t i = 0; i < rows; i++) good = good && covector[l * all + first + g->a[place[i]]] == 0;
    nmod_mat_t B;
    nmod_mat_init(B, (slong)rows, (slong)rows, g->field.p);
    if (good) tangent_turn(g, across, covector, rows, place, B);
    good = good && rows > 0 && (size_t)nmod_mat_rank(B) == rows;
    nmod_mat_clear(B);
    nh_free(place);
    return good;
}

/* Where the brackets span everything one point shows it; a leaf is taken at two. */
static bool is_tangent(const algebra *g)
{
    enum { leaves = 2 };
    nh_jet_equations *x = g->x;
    nh_residue *covector = nh_alloc_array(x->coordinates * x->coordinates + 1, sizeof *covector);
    size_t seen = 0, across = 0;
    bool good = true;
    for (size_t a = 0; a < attempts && good && seen < leaves && !x->obstacle; a++) {
        nh_jet_equations_choose(x, g->field, 1 + a);
        if (!nh_adapted_frame_across(x, &across, covector)) continue;
        good = is_solvable(g, across, covector);
        seen += across ? 1 : leaves;
    }
    nh_free(covector);
    return good && seen >= leaves && !x->obstacle;
}

size_t nh_turned_translations(nh_jet_equations *x, nh_ex *out)
{
    algebra g = {.x = x, .m = x->m, .n = x->n, .arena = nh_arena_create()};
    size_t count = 0;
    g.a = nh_arena_alloc(g.arena, (g.m + 1) * sizeof *g.a);
    g.owner = nh_arena_alloc(g.arena, (g.n + 1) * sizeof *g.owner);
    g.translated = nh_arena_alloc(g.arena, g.m + 1);
    for (size_t i = 0; i < g.m; i++)
        if (nh_jet_equations_is_cyclic(x, coordinate(&g, i))) g.a[g.cyclic++] = i;
    for (size_t l = 0; l < g.n; l++)
        while (g.owner[l] < g.m && x->rho[g.owner[l]] != x->w[l]) g.owner[l]++;
    if (g.cyclic && sample(&g)) {
        find_turnings(&g);
        for (size_t i = 0; i < g.cyclic; i++)
            if (g.translated[i]) out[count++] = coordinate(&g, g.a[i]);
        if (count && !is_tangent(&g)) count = 0;
    }
    nh_arena_free(g.arena);
    return count;
}
