/* A group by its generators E = (e_1 .. e_d), m x d columns (action.h): ranks at sample points, and flows.
 *
 *      columns   E            V, the directions of the orbits          free where rank E = d
 *                D            ker omega                                dimension assumption where rank [E, D] = m
 *                [E, D]                                                dim S = d + (m - f) - rank [E, D]
 *
 * Everything is measured in units in which the metric has diagonal one, so that a rank does not depend on units of
 * length. A flow q' = c^a e_a(q) is integrated; it is a circle if it is back at the start after a turn or two, or
 * after up to four periods of its slowest rotation. */
#include "reduction/action.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "reduction/runge.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

static size_t places_of(const nh_kinetic *k) { return k->places < NH_ACTION_PLACES ? k->places : NH_ACTION_PLACES; }

void nh_action_values(const nh_action *g, const double *q, double *E)
{
    const nh_kinetic *k = g->kinetic;
    nh_ex *e = nh_alloc_array(k->m * g->d + 1, sizeof *e);
    for (size_t a = 0; a < g->d; a++) memcpy(e + a * k->m, g->generator[a].component, k->m * sizeof *e);
    if (g->d) nh_kinetic_values(k, k->m * g->d, e, q, E);
    nh_free(e);
}

/* ---- ranks ---- */

/* Columns of a (m x n) of length one. */
static void unit_columns(size_t m, size_t n, double *a)
{
    for (size_t j = 0; j < n; j++) {
        double size = 0;
        for (size_t i = 0; i < m; i++) size = hypot(size, a[i + j * m]);
        for (size_t i = 0; i < m && size > 0; i++) a[i + j * m] /= size;
    }
}

static size_t rank_at(size_t m, size_t n, const double *a, double small, double *ratio)
{
    double *s = nh_alloc_array(n + 1, sizeof *s);
    size_t rank = 0, least = m < n ? m : n;
    nh_singular_values(m, n, a, s);
    while (rank < least && s[rank] > small) rank++;
    if (ratio) *ratio = n && s[0] > 0 ? s[n - 1] / s[0] : n ? 0 : 1;
    nh_free(s);
    return rank;
}

static double unit_of(double K) { return K > 0 ? sqrt(K) : 1; }

/* Columns in units in which the metric has diagonal one, so that lengths and angles compare. */
static void scaled(size_t m, const double *K, size_t n, double *a)
{
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < m; i++) a[i + j * m] *= unit_of(K[i * (m + 1)]);
    unit_columns(m, n, a);
}

/* Rank of [E, D] at a place, and sigma_min / sigma_max of omega on V (unit columns) when there are as many generators
 * as constraints; both in units in which the metric has diagonal one. */
static size_t with_distribution(size_t m, size_t f, size_t d, const double *K, const double *omega, const double *E,
                                double small, double *transversality)
{
    double *forms = nh_alloc_array(f * m + 1, sizeof *forms), *both = nh_alloc_array(m * (m + d) + 1, sizeof *both),
           *on = nh_alloc_array(f * d + 1, sizeof *on);
    memcpy(both, E, m * d * sizeof *both);
    scaled(m, K, d, both);
    for (size_t a = 0; a < f; a++) {
        double size = 0;
        for (size_t s = 0; s < m; s++)
            size = hypot(size, forms[a + s * f] = omega[a * m + s] / unit_of(K[s * (m + 1)]));
        for (size_t s = 0; s < m; s++) forms[a + s * f] = size > 0 ? forms[a + s * f] / size : 0;
        /* generators of length one: the part of a column outside D stays small where D nearly contains it */
        for (size_t c = 0; c < d; c++)
            for (size_t s = 0; s < m; s++) on[a + c * f] += forms[a + s * f] * both[s + c * m];
    }
    size_t n = nh_kernel(f, m, forms, small, both + m * d, NULL, NULL);
    size_t rank = rank_at(m, d + n, both, small, NULL);
    *transversality = 0;
    if (d == f) rank_at(f, d, on, small, transversality);
    nh_free(forms);
    nh_free(both);
    nh_free(on);
    return rank;
}

/* omega(e_a): column a has f rows; room for d x f. */
static void on_constraints(const nh_action *g, nh_ex *e)
{
    const nh_kinetic *k = g->kinetic;
    for (size_t a = 0; a < g->d; a++)
        for (size_t i = 0; i < k->f; i++) {
            nh_ex sum = nh_int(k->dag, 0);
            for (size_t s = 0; s < k->m; s++)
                sum = nh_add(k->dag, sum, nh_mul(k->dag, k->omega[i * k->m + s], g->generator[a].component[s]));
            e[a * k->f + i] = sum;
        }
}

/* Ranks of E, [E, D] at the sample points; exact where relations are known. From these free, Chaplygin, dim S. */
static void find_ranks(nh_action *g, const nh_options *options)
{
    static const double rounding = 1e-12;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d, f = k->f, joint = 0, total = m * d + m * m + f * m;
    nh_ex *e = nh_alloc_array(total + 1, sizeof *e);
    double *z = nh_alloc_array(k->places * total + m * d + 1, sizeof *z), *unit = z + k->places * total;
    for (size_t a = 0; a < d; a++) memcpy(e + a * m, g->generator[a].component, m * sizeof *e);
    memcpy(e + m * d, k->K, m * m * sizeof *e);
    memcpy(e + m * d + m * m, k->omega, f * m * sizeof *e);
    nh_kinetic_sample(k, total, e, k->places, z);
    size_t exact;
    bool known = nh_kinetic_rank(k, d, m, e, &exact); /* the generators, one a row */
    double small = known ? rounding : options->group;
    g->free = true;
    g->least = g->transversality = INFINITY;
    for (size_t p = 0; p < k->places; p++) {
        const double *E = z + p * total, *K = E + m * d, *omega = K + m * m;
        double ratio, transversality = 0;
        memcpy(unit, E, m * d * sizeof *unit);
        scaled(m, K, d, unit);
        size_t rank = rank_at(m, d, unit, small, &ratio),
               both = k->affine ? with_distribution(m, f, d, K, omega, E, options->group, &transversality) : rank;
        if (rank > g->orbit) g->orbit = rank;
        if (both > joint) joint = both;
        g->free &= rank == d;
        if (ratio < g->least) g->least = ratio, g->least_place = p;
        g->transversality = fmin(g->transversality, transversality);
    }
    size_t n = m - f;
    if (known) {
        g->orbit = exact;
        nh_ex *on = nh_alloc_array(d * f + 1, sizeof *on);
        on_constraints(g, on);
        if (k->affine && nh_kinetic_rank(k, d, f, on, &exact)) joint = n + exact;
        nh_free(on);
    }
    g->dimension_assumption = k->affine && joint == m;
    g->intersection = g->orbit + n > joint ? g->orbit + n - joint : 0;
    g->chaplygin = g->dimension_assumption && g->intersection == 0 && g->orbit == d;
    nh_free(e);
    nh_free(z);
}

size_t nh_action_orbit_at(const nh_action *g, const double *q, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d;
    double *E = nh_alloc_array(m * d + m * m + 1, sizeof *E), *K = E + m * d;
    nh_action_values(g, q, E);
    nh_kinetic_values(k, m * m, k->K, q, K);
    scaled(m, K, d, E);
    size_t rank = isfinite(nh_largest(m * d, E)) ? rank_at(m, d, E, options->group, NULL) : 0;
    nh_free(E);
    return rank;
}

void nh_action_init(nh_action *g, const nh_kinetic *k, size_t d, const nh_generator *generator,
                    const nh_options *options)
{
    *g = (nh_action){.kinetic = k, .d = d, .generator = nh_arena_alloc(k->arena, (d + 1) * sizeof *g->generator)};
    if (d) memcpy(g->generator, generator, d * sizeof *generator);
    nh_action_find_constants(g, options);
    find_ranks(g, options);
}

void nh_action_clear(nh_action *g) { nh_algebra_clear(&g->algebra); }

void nh_action_sub(nh_action *out, const nh_action *g, size_t r, const double *t, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *dag = k->dag;
    nh_generator *sub = nh_alloc_array(r + 1, sizeof *sub);
    nh_ex *component = nh_alloc_array(k->m, sizeof *component);
    for (size_t j = 0; j < r; j++) {
        size_t terms = 0, only = 0;
        for (size_t a = 0; a < g->d; a++)
            if (t[a + j * g->d] != 0) terms++, only = a;
        if (terms == 1 && t[only + j * g->d] == 1) {
            sub[j] = g->generator[only];
            continue;
        }
        for (size_t s = 0; s < k->m; s++) {
            component[s] = nh_int(dag, 0);
            for (size_t a = 0; a < g->d; a++)
                component[s] =
                    nh_add(dag, component[s], nh_mul(dag, nh_real(dag, t[a + j * g->d]), g->generator[a].component[s]));
        }
        nh_generator_init(&sub[j], k, NULL, component, options);
    }
    nh_action_init(out, k, r, sub, options);
    nh_free(sub);
    nh_free(component);
}

/* ---- horizontal symmetries ---- */

static bool horizontal_exactly(const nh_action *g, const nh_options *options, double *c, size_t *n)
{
    nh_ex *e = nh_alloc_array(g->d * g->kinetic->f + 1, sizeof *e);
    on_constraints(g, e);
    bool known = g->kinetic->f && nh_section_combinations(g->kinetic, g->d, g->kinetic->f, e, options, c, n);
    nh_free(e);
    return known;
}

size_t nh_action_horizontal(const nh_action *g, const nh_options *options, double *c)
{
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, f = k->f, d = g->d, places = places_of(k), rows = places * f, exact;
    if (horizontal_exactly(g, options, c, &exact)) return exact;
    double *a = nh_alloc_array(rows * d + 1, sizeof *a), *E = nh_alloc_array(m * d + f * m + 1, sizeof *E),
           *omega = E + m * d;
    for (size_t p = 0; p < places && f; p++) {
        nh_action_values(g, k->place + p * m, E);
        nh_kinetic_values(k, f * m, k->omega, k->place + p * m, omega);
        for (size_t i = 0; i < f; i++)
            for (size_t b = 0; b < d; b++)
                for (size_t s = 0; s < m; s++) a[p * f + i + b * rows] += omega[i * m + s] * E[s + b * m];
    }
    size_t n = nh_kernel(rows, d, a, options->group, c, NULL, NULL);
    nh_column_echelon(d, n, options->group, c);
    nh_free(a);
    nh_free(E);
    return n;
}

bool nh_action_moving(const nh_action *g, double *c)
{
    static const double small = 1e-9;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, f = k->f, d = g->d, places = places_of(k), rows = places * f, ld = rows > d ? rows : d;
    double *a = nh_alloc_array(rows * d + 1, sizeof *a), *b = nh_alloc_array(ld + 1, sizeof *b),
           *E = nh_alloc_array(m * d + f * m + f + 1, sizeof *E), *omega = E + m * d, *value = omega + f * m, off = 0,
           size = 0;
    double *kept = nh_alloc_array(rows * (d + 1) + 1, sizeof *kept);
    for (size_t p = 0; p < places && f; p++) {
        nh_action_values(g, k->place + p * m, E);
        nh_kinetic_values(k, f * m, k->omega, k->place + p * m, omega);
        nh_kinetic_values(k, f, k->b, k->place + p * m, value);
        for (size_t i = 0; i < f; i++) {
            b[p * f + i] = kept[rows * d + p * f + i] = -value[i];
            for (size_t e = 0; e < d; e++)
                for (size_t s = 0; s < m; s++) a[p * f + i + e * rows] += omega[i * m + s] * E[s + e * m];
        }
    }
    memcpy(kept, a, rows * d * sizeof *a);
    bool good = d && f && nh_least_squares(rows, d, a, 1, b, ld, small) >= 0;
    for (size_t i = 0; i < rows && good; i++) {
        double sum = -kept[rows * d + i];
        for (size_t e = 0; e < d; e++) sum += kept[i + e * rows] * b[e];
        off = fmax(off, fabs(sum));
        size = fmax(size, fabs(kept[rows * d + i]));
    }
    if (good) memcpy(c, b, d * sizeof *c);
    nh_free(a);
    nh_free(b);
    nh_free(E);
    nh_free(kept);
    return good && off <= small * size;
}

/* ---- flows ---- */

struct nh_flows {
    const nh_action *action;
    nh_tape *tape;
    nh_tape_work *work;
    double *E;
    bool *constant; /* per generator: a translation */
    const double *c;
};

nh_flows *nh_flows_create(const nh_action *g)
{
    size_t m = g->kinetic->m;
    nh_flows *f = nh_alloc(sizeof *f);
    nh_ex *e = nh_alloc_array(m * g->d + 1, sizeof *e);
    for (size_t a = 0; a < g->d; a++) memcpy(e + a * m, g->generator[a].component, m * sizeof *e);
    *f = (nh_flows){
        .action = g, .tape = nh_kinetic_tape(g->kinetic, m * g->d, e), .E = nh_alloc_array(m * g->d + 1, sizeof *f->E)};
    f->work = nh_tape_work_create(f->tape);
    f->constant = nh_alloc_array(g->d + 1, sizeof *f->constant);
    for (size_t a = 0; a < g->d; a++) {
        f->constant[a] = true;
        for (size_t s = 0; s < m; s++)
            for (size_t j = 0; j < m; j++)
                f->constant[a] &= !nh_depends(g->kinetic->dag, e[a * m + s], g->kinetic->q[j]);
    }
    nh_free(e);
    return f;
}

void nh_flows_free(nh_flows *f)
{
    if (!f) return;
    nh_tape_work_free(f->work);
    nh_tape_free(f->tape);
    nh_free(f->E);
    nh_free(f->constant);
    nh_free(f);
}

static bool field_rate(double t, const double *q, double *rate, void *context)
{
    (void)t;
    nh_flows *f = context;
    size_t m = f->action->kinetic->m;
    nh_tape_eval(f->tape, f->work, q, f->E);
    memset(rate, 0, m * sizeof *rate);
    for (size_t a = 0; a < f->action->d; a++)
        for (size_t s = 0; s < m && f->c[a] != 0; s++) rate[s] += f->c[a] * f->E[s + a * m];
    return true;
}

bool nh_flows_move(nh_flows *f, const double *c, double t, double *q)
{
    static const double tolerance = 1e-14, largest = 1e12;
    size_t m = f->action->kinetic->m;
    bool translation = true;
    f->c = c;
    for (size_t a = 0; a < f->action->d; a++) translation &= c[a] == 0 || f->constant[a];
    if (translation) {
        nh_tape_eval(f->tape, f->work, q, f->E);
        for (size_t a = 0; a < f->action->d; a++)
            for (size_t s = 0; s < m && c[a] != 0; s++) q[s] += t * c[a] * f->E[s + a * m];
        return true;
    }
    return t == 0 || nh_runge_sized(m, field_rate, f, 0, t, tolerance, largest, q);
}

/* Is it back at the start, relative to the distance that the flow went away in between (at times that are no parts of a
 * period)? */
static bool returns(nh_flows *f, const double *c, double time, const double *start)
{
    static const double same = 1e-8, rounding = 1e-13, turn = 6.283185307179586, part[] = {0.17, 0.41, 0.77};
    enum { parts = sizeof part / sizeof *part };
    const nh_kinetic *k = f->action->kinetic;
    size_t m = k->m;
    double *q = nh_alloc_array(2 * m, sizeof *q), *away = q + m, before = 0;
    bool closed = true;
    memcpy(q, start, m * sizeof *q);
    for (size_t i = 0; i < parts && closed; i++) {
        closed = nh_flows_move(f, c, (part[i] - before) * time, q);
        before = part[i];
        for (size_t s = 0; s < m; s++) away[s] = fmax(away[s], fabs(q[s] - start[s]));
    }
    closed = closed && nh_flows_move(f, c, (1 - before) * time, q);
    for (size_t s = 0; s < m && closed; s++) {
        double way = q[s] - start[s];
        if (k->periodic[s]) way -= turn * round(way / turn);
        closed = fabs(way) <= same * (k->periodic[s] ? fmax(1, away[s]) : away[s]) + rounding * fabs(start[s]);
    }
    nh_free(q);
    return closed;
}

/* The slowest rotation among the eigenvalues of the Jacobian at a place; 0 when there is none. */
static double frequency(const nh_flows *f, const double *c, const double *q)
{
    const nh_kinetic *k = f->action->kinetic;
    size_t m = k->m;
    nh_ex *e = nh_alloc_array(m * m, sizeof *e);
    double *J = nh_alloc_array(m * m + 2 * m, sizeof *J), *re = J + m * m, *im = re + m, least = 0;
    for (size_t s = 0; s < m; s++)
        for (size_t r = 0; r < m; r++) {
            e[s + r * m] = nh_int(k->dag, 0);
            for (size_t a = 0; a < f->action->d; a++)
                if (c[a] != 0)
                    e[s + r * m] = nh_add(k->dag, e[s + r * m],
                                          nh_mul(k->dag, nh_real(k->dag, c[a]),
                                                 nh_diff(k->dag, f->action->generator[a].component[s], k->q[r])));
        }
    nh_kinetic_values(k, m * m, e, q, J);
    if (nh_eigen(m, J, re, im, NULL))
        for (size_t i = 0; i < m; i++)
            if (fabs(im[i]) > 1e-6 && (least == 0 || fabs(im[i]) < least)) least = fabs(im[i]);
    nh_free(e);
    nh_free(J);
    return least;
}

bool nh_flows_closed(nh_flows *f, const double *c)
{
    enum { places = 4 }; /* from some places the flow may meet a pole of the coordinates */
    static const double turn = 6.283185307179586;
    const nh_kinetic *k = f->action->kinetic;
    bool closed = false;
    for (size_t p = 0; p < places && p < k->places && !closed; p++) {
        const double *q = k->place + p * k->m;
        double omega = frequency(f, c, q);
        for (int i = 1; i <= 4 && !closed; i++)
            closed = (i <= 2 && returns(f, c, i * turn, q)) || (omega > 0 && returns(f, c, i * turn / omega, q));
    }
    return closed;
}
