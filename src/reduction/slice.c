/* The data of a symmetric system on a slice y = y0 (slice.h; docs/method.md, sec. 9).
 *
 *      Q (m)        orbit of G           frame at sigma(x):   Fr = [ d/dx^1 .. d/dx^n | e_1 .. e_d ]     m x m
 *       |  .........|.........
 *       | /         |         /          Kf = Fr^T K Fr = [ K_xx  K_xe ]      omf = omega Fr = [ om_x  om_e ]
 *       |/    sigma(x)       /                            [ K_ex  K_ee ]
 *       +-----------o-------/  y = y0
 *                   x (n)
 *
 * First the coordinates y: of all sets of d rows of E, scaled by the metric to columns of length one, that whose
 * least singular value over the places is the largest; of nearly equal ones the coordinates that the file calls
 * dependent. Then y0: simple values where K, V and the constraints are regular, so that entries are exact and can be
 * simplified. */
#include "reduction/slice.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "reduction/subspace.h"

enum { trial_places = 10, most_subsets = 4000 };

/* ---- which coordinates ---- */

/* E in units of the metric, columns of length one, at some places (places x m): places x (m x d). */
static double *scaled_generators(const nh_action *g, size_t places, const double *place)
{
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d;
    double *E = nh_alloc_array(places * m * d + 1, sizeof *E), *K = nh_alloc_array(places * m * m, sizeof *K);
    for (size_t p = 0; p < places; p++) nh_kinetic_values(k, m * m, k->K, place + p * m, K + p * m * m);
    for (size_t p = 0; p < places; p++) {
        double *e = E + p * m * d;
        nh_action_values(g, place + p * m, e);
        for (size_t a = 0; a < d; a++) {
            double size = 0;
            for (size_t s = 0; s < m; s++) {
                double unit = K[p * m * m + s * (m + 1)];
                e[s + a * m] *= unit > 0 ? sqrt(unit) : 1;
                size = hypot(size, e[s + a * m]);
            }
            for (size_t s = 0; s < m && size > 0; s++) e[s + a * m] /= size;
        }
    }
    nh_free(K);
    return E;
}

/* The least singular value of these rows of E over the places. */
static double worst_minor(size_t m, size_t d, size_t places, const double *E, const size_t *rows)
{
    double *minor = nh_alloc_array(d * d + d + 1, sizeof *minor), *s = minor + d * d, least = INFINITY;
    for (size_t p = 0; p < places && d; p++) {
        for (size_t i = 0; i < d; i++)
            for (size_t a = 0; a < d; a++) minor[i + a * d] = E[p * m * d + rows[i] + a * m];
        nh_singular_values(d, d, minor, s);
        least = fmin(least, s[d - 1]);
    }
    nh_free(minor);
    return least;
}

/* The next set of d indices below m in lexicographic order; false behind the last. */
static bool next_subset(size_t m, size_t d, size_t *index)
{
    for (size_t i = d; i-- > 0;) {
        if (index[i] >= m - d + i) continue;
        index[i]++;
        for (size_t j = i + 1; j < d; j++) index[j] = index[j - 1] + 1;
        return true;
    }
    return false;
}

/* `avoid`: rows that are taken only where others are far worse; NULL: none. */
static void choose(const nh_action *g, size_t places, const double *place, const size_t *avoid, size_t *shape,
                   size_t *along)
{
    static const double nearly = 1.05; /* of nearly equal rows the preferred ones, then the first */
    static const double avoided = 0.02;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d, trials = 0;
    size_t *rows = nh_alloc_array(d + 1, sizeof *rows);
    double *E = scaled_generators(g, places, place), best = -1;
    for (size_t i = 0; i < d; i++) rows[i] = i;
    do {
        double value = worst_minor(m, d, places, E, rows);
        for (size_t i = 0; i < d; i++)
            if (k->dependent[rows[i]]) value *= 1 + 0.5 / (double)d;
        if (avoid && !memcmp(avoid, rows, d * sizeof *rows)) value *= avoided;
        if (value <= best * nearly) continue;
        best = value;
        memcpy(along, rows, d * sizeof *along);
    } while (++trials < most_subsets && next_subset(m, d, rows));
    for (size_t s = 0, n = 0; s < m; s++) {
        bool group = false;
        for (size_t a = 0; a < d; a++) group |= along[a] == s;
        if (!group) shape[n++] = s;
    }
    nh_free(rows);
    nh_free(E);
}

void nh_slice_choose(const nh_action *g, size_t *shape, size_t *along)
{
    const nh_kinetic *k = g->kinetic;
    choose(g, k->places < trial_places ? k->places : trial_places, k->place, NULL, shape, along);
}

void nh_slice_choose_at(const nh_action *g, const double *q, const size_t *avoid, size_t *shape, size_t *along)
{
    choose(g, 1, q, avoid, shape, along);
}

/* ---- data ---- */

static nh_ex tidy(const nh_slice *s, nh_ex e) { return s->tidy ? nh_simplify(s->dag, e) : e; }

/* a^T B c for vectors given as columns of a frame: frame[s*m + j] is component s of vector j. */
static void frame_metric(nh_slice *s, const nh_ex *frame, const nh_ex *K)
{
    nh_dag *d = s->dag;
    size_t m = s->m;
    nh_ex *half = nh_alloc_array(m * m, sizeof *half);
    for (size_t r = 0; r < m; r++)
        for (size_t j = 0; j < m; j++) {
            half[r * m + j] = nh_int(d, 0);
            for (size_t q = 0; q < m; q++)
                if (!nh_is_zero(d, frame[q * m + j]))
                    half[r * m + j] = nh_add(d, half[r * m + j], nh_mul(d, K[r * m + q], frame[q * m + j]));
        }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t r = 0; r < m; r++)
                if (!nh_is_zero(d, frame[r * m + i]))
                    sum = nh_add(d, sum, nh_mul(d, frame[r * m + i], half[r * m + j]));
            s->K[i * m + j] = s->K[j * m + i] = tidy(s, sum);
        }
    nh_free(half);
}

/* omf = omega Fr, f x m. */
static void frame_forms(nh_slice *s, const nh_ex *frame, const nh_ex *omega)
{
    nh_dag *d = s->dag;
    for (size_t a = 0; a < s->f; a++)
        for (size_t j = 0; j < s->m; j++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t r = 0; r < s->m; r++)
                if (!nh_is_zero(d, frame[r * s->m + j]))
                    sum = nh_add(d, sum, nh_mul(d, omega[a * s->m + r], frame[r * s->m + j]));
            s->omega[a * s->m + j] = tidy(s, sum);
        }
}

/* y as an expression: a whole number or pi/2 exactly; `tidy` ends where it is neither. */
static nh_ex exact(nh_slice *s, double y)
{
    static const double right_angle = 1.5707963267948966;
    if (y == right_angle) return nh_mul(s->dag, nh_ratio(s->dag, 1, 2), nh_pi(s->dag));
    s->tidy &= y == round(y);
    return nh_real(s->dag, y);
}

void nh_slice_init(nh_slice *s, const nh_action *g, const size_t *shape, const size_t *along, const double *y0)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *dag = k->dag;
    size_t m = k->m, d = g->d, f = k->f, n = m - d;
    *s = (nh_slice){.action = g, .kinetic = k, .dag = dag, .m = m, .f = f, .n = n, .d = d};
    s->shape = nh_arena_alloc(k->arena, (m + 1) * sizeof *s->shape);
    s->along = s->shape + n;
    s->y0 = nh_arena_alloc(k->arena, (d + 1) * sizeof *s->y0);
    memcpy(s->shape, shape, n * sizeof *shape);
    memcpy(s->along, along, d * sizeof *along);
    memcpy(s->y0, y0, d * sizeof *y0);
    s->x = nh_arena_alloc(k->arena, (n + m * d + m * m + f * m + d + m + f + 1) * sizeof *s->x);
    s->E = s->x + n;
    s->K = s->E + m * d;
    s->omega = s->K + m * m;
    s->y = s->omega + f * m;
    s->a = s->y + d;
    s->b = s->a + m;
    nh_ex *from = nh_alloc_array(2 * d + 2 * m * m + f * m + 1, sizeof *from), *to = from + d, *frame = to + d,
          *K = frame + m * m, *omega = K + m * m;
    s->tidy = true;
    for (size_t a = 0; a < d; a++) {
        from[a] = k->q[along[a]];
        to[a] = s->y[a] = exact(s, y0[a]);
    }
    for (size_t i = 0; i < n; i++) s->x[i] = k->q[shape[i]];
    for (size_t r = 0; r < m; r++) {
        for (size_t a = 0; a < d; a++)
            s->E[r * d + a] = tidy(s, nh_substitute(dag, g->generator[a].component[r], d, from, to));
        for (size_t i = 0; i < n; i++) frame[r * m + i] = nh_int(dag, shape[i] == r);
        for (size_t a = 0; a < d; a++) frame[r * m + n + a] = s->E[r * d + a];
    }
    for (size_t i = 0; i < m * m; i++) K[i] = nh_substitute(dag, k->K[i], d, from, to);
    for (size_t i = 0; i < f * m; i++) omega[i] = nh_substitute(dag, k->omega[i], d, from, to);
    s->V = tidy(s, nh_substitute(dag, k->V, d, from, to));
    frame_metric(s, frame, K);
    frame_forms(s, frame, omega);
    for (size_t i = 0; i < f; i++) s->b[i] = nh_substitute(dag, k->b[i], d, from, to);
    for (size_t j = 0; j < m; j++) {
        s->a[j] = nh_int(dag, 0);
        for (size_t r = 0; r < m; r++)
            if (!nh_is_zero(dag, frame[r * m + j]))
                s->a[j] = nh_add(dag, s->a[j], nh_mul(dag, frame[r * m + j], nh_substitute(dag, k->a[r], d, from, to)));
        s->a[j] = tidy(s, s->a[j]);
    }
    nh_free(from);
}

double nh_slice_pivot_score(void *slice, nh_ex e)
{
    const nh_slice *s = slice;
    double value;
    if (!s->pivots) return nh_chart_pivot_score(s->kinetic->model->chart, e);
    nh_kinetic_values(s->kinetic, 1, &e, s->pivots, &value);
    return isfinite(value) ? fabs(value) : 0;
}

bool nh_slice_components(const nh_slice *s, const double *q, const double *v, double *u)
{
    size_t m = s->m, d = s->d;
    double *frame = nh_alloc_array(m * m + m * d + 1, sizeof *frame), *E = frame + m * m, rcond;
    nh_action_values(s->action, q, E);
    for (size_t i = 0; i < s->n; i++) frame[s->shape[i] + i * m] = 1;
    memcpy(frame + s->n * m, E, m * d * sizeof *frame);
    memcpy(u, v, m * sizeof *u);
    bool good = nh_solve(m, frame, 1, u, &rcond) && rcond > 1e-12;
    nh_free(frame);
    return good;
}

void nh_slice_place(const nh_slice *s, const double *x, double *q)
{
    for (size_t i = 0; i < s->n; i++) q[s->shape[i]] = x[i];
    for (size_t a = 0; a < s->d; a++) q[s->along[a]] = s->y0[a];
}

/* ---- values of y0 ---- */

/* Of a Chaplygin system: are the orbits through q transverse to D there? */
static bool transverse_at(const nh_action *g, const double *q, const double *E)
{
    static const double transverse = 1e-3;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, f = k->f;
    if (!g->chaplygin || g->d != f || !f) return true;
    double *omega = nh_alloc_array(f * m + f * f + f, sizeof *omega), *on = omega + f * m, *sv = on + f * f;
    nh_kinetic_values(k, f * m, k->omega, q, omega);
    for (size_t i = 0; i < f; i++)
        for (size_t a = 0; a < f; a++)
            for (size_t s = 0; s < m; s++) on[i + a * f] += omega[i * m + s] * E[s + a * m];
    nh_singular_values(f, f, on, sv);
    bool good = sv[f - 1] > transverse * sv[0];
    nh_free(omega);
    return good;
}

/* sigma_min / sigma_max of f forms (row by row) in these units. */
static double evenness(size_t f, size_t m, const double *omega, const double *unit)
{
    double *a = nh_alloc_array(f * m + m + 1, sizeof *a), *sv = a + f * m;
    for (size_t i = 0; i < f * m; i++) a[i] = omega[i] * unit[i % m];
    nh_singular_values(m, f, a, sv); /* the transposed matrix, column by column */
    double even = f ? sv[f - 1] / sv[0] : 1;
    nh_free(a);
    return isfinite(even) ? even : 0;
}

/* K, V and the constraints are finite at q; no direction is far shorter there, and the constraints are not far more
 * dependent, than at the sample point p. */
static bool metric_regular(const nh_kinetic *k, const double *p, const double *q)
{
    static const double far = 1e-3;
    size_t m = k->m, f = k->f, total = m * m + f * m + 1;
    nh_ex *e = nh_alloc_array(total, sizeof *e);
    double *at = nh_alloc_array(2 * total + 2 * m + 1, sizeof *at), *usual = at + total, *unit = usual + total,
           *sv = unit + m;
    memcpy(e, k->K, m * m * sizeof *e);
    memcpy(e + m * m, k->omega, f * m * sizeof *e);
    e[total - 1] = k->V;
    nh_kinetic_values(k, total, e, q, at);
    nh_kinetic_values(k, total, e, p, usual);
    bool told = nh_largest(m * m, usual) > 0, good = nh_all_finite(total, at); /* not where time occurs */
    for (size_t i = 0; i < m; i++) {
        for (size_t j = 0; j < m; j++) unit[i] = i == j || !k->metric ? fmax(unit[i], fabs(usual[i * m + j])) : unit[i];
        unit[i] = unit[i] > 0 ? 1 / sqrt(unit[i]) : 1;
    }
    for (size_t i = 0; i < m * m; i++) at[i] *= unit[i / m] * unit[i % m];
    if (k->invertible && good) nh_singular_values(m, m, at, sv);
    good = good && (!k->invertible || sv[m - 1] > far * far * sv[0]);
    good = good && evenness(f, m, at + m * m, unit) > far * evenness(f, m, usual + m * m, unit);
    nh_free(e);
    nh_free(at);
    return good || !told;
}

/* Are E on these rows and the data of the system regular on the slice y, beside the first few sample points? */
static bool regular_at(const nh_action *g, const size_t *along, const double *y)
{
    enum { trials = 8 };
    static const double regular = 1e-3;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d, singular = 0, tried = k->places < trials ? k->places : trials;
    double *q = nh_alloc_array(m, sizeof *q), *minor = nh_alloc_array(d * d + m * d + d + 1, sizeof *minor);
    double *E = minor + d * d, *sv = E + m * d;
    bool good = true;
    for (size_t p = 0; p < tried && good && d; p++) {
        memcpy(q, k->place + p * m, m * sizeof *q);
        for (size_t a = 0; a < d; a++) q[along[a]] = y[a];
        nh_action_values(g, q, E);
        for (size_t i = 0; i < d; i++)
            for (size_t a = 0; a < d; a++) minor[i + a * d] = E[along[i] + a * m];
        good = nh_all_finite(m * d, E);
        /* slices may meet such places, but must not lie in them */
        singular += good && !(metric_regular(k, k->place + p * m, q) && transverse_at(g, q, E));
        nh_singular_values(d, d, minor, sv);
        good = good && sv[d - 1] > regular * sv[0];
    }
    nh_free(q);
    nh_free(minor);
    return good && 2 * singular <= tried;
}

bool nh_slice_nice(const nh_action *g, const size_t *along, double *y)
{
    static const double values[] = {0, 1.5707963267948966, 1};
    enum { most = 2000 };
    size_t d = g->d, trials = 1;
    for (size_t a = 0; a < d && trials < most; a++) trials *= 3;
    for (size_t trial = 0; trial < trials && trial < most; trial++) {
        size_t code = trial;
        bool allowed = true;
        for (size_t a = 0; a < d; a++, code /= 3) {
            y[a] = values[code % 3];
            allowed &= code % 3 != 1 || g->kinetic->angle[along[a]];
        }
        if (allowed && regular_at(g, along, y)) return true;
    }
    return false;
}

bool nh_slice_moves(const nh_slice *s, size_t i)
{
    for (size_t a = 0; a < s->d; a++)
        if (!nh_is_zero(s->dag, s->action->generator[a].component[s->shape[i]])) return true;
    return false;
}
