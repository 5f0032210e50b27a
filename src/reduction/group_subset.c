/* Subsets of a group's generators (group.h): for Chaplygin's case subalgebras of dimension f, transversal to D at all
 * sample points, the best by a list of criteria (merit); otherwise ones that act freely.
 *
 * Of a group s x z with s semisimple, so(3) of a ball joint, say, the generators need not lie in s or in z: the turn of
 * a cart turns the ball with it.  Each x is c + y with c in s and [y, s] = 0,
 *
 *     k(c, s_j) = k(x, s_j) for a basis s_j of s, k the Killing form,
 *
 * which decides c, since k is not degenerate on s and k(y, s_j) = 0.  The subsets of the y and of a basis of s are
 * tried, too: all of s normalises those of the y. */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "reduction/chain.h"
#include "reduction/group.h"
#include "reduction/subspace.h"

static bool inside(size_t d, const double *vector, size_t count, const size_t *subset)
{
    for (size_t k = 0; k < d; k++) {
        bool member = false;
        for (size_t i = 0; i < count; i++) member |= subset[i] == k;
        if (!member && vector[k] != 0) return false;
    }
    return true;
}

static bool subalgebra(const nh_algebra *g, size_t count, const size_t *subset)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (!inside(g->d, g->c + (subset[i] * g->d + subset[j]) * g->d, count, subset)) return false;
    return true;
}

/* How many of the subset's generators move only coordinates that the system calls dependent. */
static size_t along_dependents(const nh_action *g, size_t count, const size_t *subset)
{
    const nh_kinetic *k = g->kinetic;
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        bool only = true;
        for (size_t s = 0; s < k->m; s++)
            only &= k->dependent[s] || nh_is_zero(k->dag, g->generator[subset[i]].component[s]);
        n += only;
    }
    return n;
}

/* How many of the subset's generators move one coordinate only. */
static size_t plain_ones(const nh_action *g, size_t count, const size_t *subset)
{
    const nh_kinetic *k = g->kinetic;
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        size_t moved = 0;
        for (size_t s = 0; s < k->m; s++) moved += !nh_is_zero(k->dag, g->generator[subset[i]].component[s]);
        n += moved == 1;
    }
    return n;
}

/* The number of generators of the subset that do not commute with all of it.  A group that is not abelian is divided
 * out as a whole. */
static size_t interacting(const nh_algebra *g, size_t count, const size_t *subset)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        bool acts = false;
        for (size_t j = 0; j < count; j++)
            for (size_t k = 0; k < g->d; k++) acts |= g->c[(subset[i] * g->d + subset[j]) * g->d + k] != 0;
        n += acts;
    }
    return n;
}

static size_t local_ones(const nh_action *g, size_t count, const size_t *subset)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++) n += g->generator[subset[i]].local;
    return n;
}

/* Criteria for a subset, the first ones first; of those that agree in all, one that is not much more nearly along D
 * (`size`, sigma_min) than the best so far, the last: the shape keeps coordinates that the file names first. */
typedef struct {
    size_t local, normal, first, interacting, along, plain;
    double size;
} merit;

/* > 0: a is better; 0: they agree in all but the size. */
static int compare(const merit *a, const merit *b)
{
    const size_t more[] = {b->local, a->normal, a->first, a->interacting, a->along, a->plain},
                 less[] = {a->local, b->normal, b->first, b->interacting, b->along, b->plain};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++)
        if (more[i] != less[i]) return more[i] > less[i] ? 1 : -1;
    return 0;
}

static bool next_subset(size_t d, size_t count, size_t *index)
{
    for (size_t i = count; i-- > 0;) {
        if (index[i] >= d - count + i) continue;
        index[i]++;
        for (size_t j = i + 1; j < count; j++) index[j] = index[j - 1] + 1;
        return true;
    }
    return false;
}

/* omega(e_a) at every sample point, forms and generators of length one in units in which the metric has diagonal one,
 * so that lengths and angles compare: f x d each, column by column. */
static double *on_constraints(const nh_action *g)
{
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, f = k->f, d = g->d, total = m * d + f * m + m;
    nh_ex *e = nh_alloc_array(total + 1, sizeof *e);
    double *z = nh_alloc_array(k->places * total + 1, sizeof *z),
           *out = nh_alloc_array(k->places * f * d + 1, sizeof *out);
    for (size_t a = 0; a < d; a++) memcpy(e + a * m, g->generator[a].component, m * sizeof *e);
    memcpy(e + m * d, k->omega, f * m * sizeof *e);
    for (size_t s = 0; s < m; s++) e[m * d + f * m + s] = k->K[s * (m + 1)];
    nh_kinetic_sample(k, total, e, k->places, z);
    for (size_t p = 0; p < k->places; p++)
        for (size_t i = 0; i < f; i++)
            for (size_t a = 0; a < d; a++) {
                const double *E = z + p * total + a * m, *omega = z + p * total + m * d + i * m,
                             *K = z + p * total + m * d + f * m;
                double sum = 0, length = 0, size = 0;
                for (size_t s = 0; s < m; s++) {
                    double unit = K[s] > 0 ? sqrt(K[s]) : 1;
                    sum += omega[s] * E[s];
                    length = hypot(length, E[s] * unit);
                    size = hypot(size, omega[s] / unit);
                }
                out[p * f * d + i + a * f] = length > 0 && size > 0 ? sum / (length * size) : 0;
            }
    nh_free(e);
    nh_free(z);
    return out;
}

/* The least sigma_min / sigma_max of omega on the subset: where it is not zero, the orbits complement D everywhere.
 * *size: the least sigma_min, which tells fields along D from others for one constraint, too. */
static double transversality(const nh_action *g, const double *on, const size_t *subset, double *size)
{
    size_t f = g->kinetic->f, d = g->d;
    double *a = nh_alloc_array(f * f + f + 1, sizeof *a), *s = a + f * f, least = INFINITY;
    *size = INFINITY;
    for (size_t p = 0; p < g->kinetic->places; p++) {
        for (size_t j = 0; j < f; j++) memcpy(a + j * f, on + p * f * d + subset[j] * f, f * sizeof *a);
        nh_singular_values(f, f, a, s);
        least = fmin(least, s[0] > 0 ? s[f - 1] / s[0] : 0);
        *size = fmin(*size, s[f - 1]);
    }
    nh_free(a);
    return least;
}

/* ---- the first joint ---- */

/* Values at the sample points, places x m, in units in which fields compare. */
static void sample_field(const nh_kinetic *k, const nh_ex *component, double *out)
{
    double *unit = nh_alloc_array(k->m, sizeof *unit);
    nh_kinetic_sizes(k, k->places, unit);
    nh_kinetic_sample(k, k->m, component, k->places, out);
    for (size_t i = 0; i < k->places * k->m; i++) out[i] /= unit[i % k->m];
    nh_free(unit);
}

/* Which generators are displacements that the joints on the ground allow, of everything behind them
 * [ChhabraEmami2014, theorem 4.1]: constant combinations of these at the sample points. */
void nh_group_first_joint(const nh_action *g, bool *first)
{
    static const double small = 1e-9;
    const nh_kinetic *k = g->kinetic;
    memset(first, 0, g->d * sizeof *first);
    nh_chain_symmetries *c = nh_chain_first_joint(k->model->system);
    size_t rows = k->places * k->m;
    if (!c) return;
    double *a = nh_alloc_array(rows * (2 * c->fields + 1) + 1, sizeof *a), *u = a + rows * c->fields,
           *x = u + rows * c->fields;
    for (size_t i = 0; i < c->fields; i++) sample_field(k, c->field[i].component, a + i * rows);
    size_t rank = nh_span(rows, c->fields, a, small, u);
    for (size_t i = 0; i < g->d && rank; i++) {
        sample_field(k, g->generator[i].component, x);
        double size = nh_largest(rows, x);
        nh_project_off(rows, 1, x, rank, u);
        first[i] = nh_largest(rows, x) <= small * size;
    }
    nh_free(a);
    nh_chain_symmetries_free(c);
}

/* ---- generators that commute with a semisimple ideal ---- */

/* A basis of the semisimple ideals among the pieces: their bases side by side. */
static size_t semisimple(const nh_group *g, double *out)
{
    static const double small = 1e-9;
    size_t d = g->action.d, n = 0;
    double *radical = nh_alloc_array(d * d + 1, sizeof *radical);
    for (size_t i = 0; i < g->report.pieces; i++) {
        const nh_algebra_piece *p = &g->report.piece[i];
        if (p->dimension < 3) continue;
        nh_algebra part = nh_algebra_change(&g->action.algebra, p->dimension, p->basis, NULL);
        if (nh_algebra_radical(&part, small, radical) == 0) {
            memcpy(out + n * d, p->basis, p->dimension * d * sizeof *out);
            nh_column_echelon(d, p->dimension, small, out + n * d);
            n += p->dimension;
        }
        nh_algebra_clear(&part);
    }
    nh_free(radical);
    return n;
}

/* c: the parts in s (d x n) of the unit vectors, n x d. */
static bool parts_in(const nh_algebra *g, size_t n, const double *s, double *c)
{
    size_t d = g->d;
    double *killing = nh_alloc_array(2 * d * d + n * n + n * d + 1, sizeof *killing), *k = killing + d * d,
           *gram = k + d * d, *row = gram + n * n;
    nh_algebra_killing(g, killing);
    nh_multiply(d, n, d, killing, s, k);
    for (size_t i = 0; i < n; i++) {
        for (size_t a = 0; a < d; a++) row[i + a * n] = k[a + i * d];
        for (size_t j = 0; j < n; j++)
            for (size_t a = 0; a < d; a++) gram[i + j * n] += s[a + i * d] * k[a + j * d];
    }
    memcpy(c, row, n * d * sizeof *c);
    bool good = nh_solve(n, gram, d, c, NULL);
    nh_free(killing);
    return good;
}

/* Columns t (d x d): the generators, those of s x z in neither replaced by their parts in z.  False where nothing would
 * change, or a coefficient is no short fraction: sums would not be exact. */
static bool commuting_basis(const nh_group *g, double *t)
{
    static const double small = 1e-8, parts = 16;
    size_t d = g->action.d, changed = 0, rank;
    double *s = nh_alloc_array(3 * d * d + 1, sizeof *s), *c = s + d * d, *u = c + d * d;
    size_t n = g->missing || !g->action.closes ? 0 : semisimple(g, s);
    bool good = n && n < d && parts_in(&g->action.algebra, n, s, c);
    for (size_t a = 0; a < d && good; a++) {
        double *x = t + a * d;
        memset(x, 0, d * sizeof *x);
        x[a] = 1;
        for (size_t i = 0; i < n * d; i++) x[i % d] -= s[i] * c[i / d + a * n];
        for (size_t i = 0; i < d; i++) {
            double nearest = round(x[i] * parts) / parts;
            good &= fabs(x[i] - nearest) <= small;
            x[i] = nearest;
        }
        if (nh_largest(d, x) == 0) x[a] = 1; /* it lies in s */
        for (size_t i = 0; i < d; i++) changed += x[i] != (i == a);
    }
    rank = good && changed ? nh_span(d, d, t, small, u) : 0;
    nh_free(s);
    return rank == d;
}

/* ---- Chaplygin's case ---- */

/* The best subset of the generators of an action. */
static bool best_subset(const nh_action *g, const nh_options *options, size_t *index, merit *best)
{
    enum { most_trials = 20000 };
    static const double comparable = 0.5; /* part of the best */
    size_t d = g->d, f = g->kinetic->f, trials = 0, *subset = nh_alloc_array(d + f + 1, sizeof *subset);
    double *on = on_constraints(g), *rest = nh_alloc_array(d * d + 1, sizeof *rest);
    bool found = false, *first = nh_alloc_array(d + 1, sizeof *first);
    nh_group_first_joint(g, first);
    for (size_t i = 0; i < f && i <= d; i++) subset[i] = i;
    if (f > 0 && f <= d && g->closes) do {
            if (!subalgebra(&g->algebra, f, subset)) continue;
            merit m = {.local = local_ones(g, f, subset),
                       .normal = nh_group_normaliser(&g->algebra, f, subset, rest),
                       .interacting = interacting(&g->algebra, f, subset),
                       .along = along_dependents(g, f, subset),
                       .plain = plain_ones(g, f, subset)};
            bool transversal = transversality(g, on, subset, &m.size) > options->transversal;
            for (size_t i = 0; i < f; i++) m.first += first[subset[i]];
            int sign = found ? compare(&m, best) : 1;
            if (!transversal || sign < 0 || (sign == 0 && m.size < comparable * best->size)) continue;
            if (sign == 0) m.size = fmax(best->size, m.size);
            *best = m;
            found = true;
            memcpy(index, subset, f * sizeof *index);
        } while (++trials < most_trials && next_subset(d, f, subset));
    nh_free(subset);
    nh_free(rest);
    nh_free(first);
    nh_free(on);
    return found;
}

bool nh_group_chaplygin(const nh_group *g, const nh_options *options, double *t)
{
    size_t d = g->action.d, f = g->kinetic->f, *index = nh_alloc_array(d + f + 1, sizeof *index);
    double *basis = nh_alloc_array(d * d + 1, sizeof *basis);
    merit best = {0}, other = {0};
    bool found = best_subset(&g->action, options, index, &best);
    memset(t, 0, d * f * sizeof *t);
    for (size_t i = 0; i < f && found; i++) t[index[i] + i * d] = 1;
    if (f && f <= d && commuting_basis(g, basis)) {
        nh_action a;
        nh_action_sub(&a, &g->action, d, basis, options);
        if (best_subset(&a, options, index, &other) && (!found || compare(&other, &best) > 0)) {
            for (size_t i = 0; i < f; i++) memcpy(t + i * d, basis + index[i] * d, d * sizeof *t);
            found = true;
        }
        nh_action_clear(&a);
    }
    nh_free(index);
    nh_free(basis);
    return found;
}

size_t nh_group_subalgebras(const nh_group *g, size_t size, double *most)
{
    enum { most_trials = 20000 };
    size_t d = g->action.d, count = 0, trials = 0, *subset = nh_alloc_array(d + size + 1, sizeof *subset);
    double *on = on_constraints(&g->action), size_of;
    *most = 0;
    for (size_t i = 0; i < size && i <= d; i++) subset[i] = i;
    if (size > 0 && size <= d && g->action.closes) do {
            if (!subalgebra(&g->action.algebra, size, subset)) continue;
            count++;
            *most = fmax(*most, transversality(&g->action, on, subset, &size_of));
        } while (++trials < most_trials && next_subset(d, size, subset));
    nh_free(subset);
    nh_free(on);
    return count;
}

/* ---- subgroups that act freely ---- */

/* The least sigma_min / sigma_max of some columns of E, made of length one, over places (m x d each). */
static double independence(size_t m, size_t d, size_t places, const double *E, size_t count, const size_t *subset)
{
    double *a = nh_alloc_array(m * count + count + 1, sizeof *a), *s = a + m * count, least = INFINITY;
    for (size_t p = 0; p < places; p++) {
        for (size_t j = 0; j < count; j++) {
            const double *e = E + p * m * d + subset[j] * m;
            double size = 0;
            for (size_t i = 0; i < m; i++) size = hypot(size, e[i]);
            for (size_t i = 0; i < m; i++) a[i + j * m] = size > 0 ? e[i] / size : 0;
        }
        nh_singular_values(m, count, a, s);
        least = fmin(least, s[0] > 0 ? s[count - 1] / s[0] : 0);
    }
    nh_free(a);
    return least;
}

/* The first subset of this size that generates a free action, with or without local symmetries in it; *trials: how many
 * more may be tried. */
static bool free_of_size(const nh_group *g, const nh_options *options, const double *E, bool local, size_t size,
                         size_t *trials, size_t *index)
{
    const nh_action *a = &g->action;
    for (size_t i = 0; i < size; i++) index[i] = i;
    do {
        if ((local_ones(a, size, index) > 0) != local) continue;
        if (*trials == 0) return false;
        --*trials;
        if (subalgebra(&a->algebra, size, index) &&
            independence(g->kinetic->m, a->d, g->kinetic->places, E, size, index) > options->group)
            return true;
    } while (next_subset(a->d, size, index));
    return false;
}

size_t nh_group_free_subset(const nh_group *g, const nh_options *options, size_t *index)
{
    enum { most_trials = 20000 };
    const nh_kinetic *k = g->kinetic;
    size_t d = g->action.d, trials = most_trials, found = 0;
    nh_ex *e = nh_alloc_array(k->m * d + 1, sizeof *e), *K = nh_alloc_array(k->m + 1, sizeof *K);
    double *E = nh_alloc_array(k->places * k->m * d + 1, sizeof *E),
           *metric = nh_alloc_array(k->places * k->m + 1, sizeof *metric);
    for (size_t a = 0; a < d; a++) memcpy(e + a * k->m, g->action.generator[a].component, k->m * sizeof *e);
    for (size_t s = 0; s < k->m; s++) K[s] = k->K[s * (k->m + 1)];
    nh_kinetic_sample(k, k->m * d, e, k->places, E);
    nh_kinetic_sample(k, k->m, K, k->places, metric);
    for (size_t i = 0; i < k->places * k->m * d; i++) { /* in units in which the metric has diagonal one */
        double unit = metric[i / (k->m * d) * k->m + i % k->m];
        E[i] *= unit > 0 ? sqrt(unit) : 1;
    }
    for (size_t size = g->action.orbit; size > 0 && !found; size--)
        if (free_of_size(g, options, E, false, size, &trials, index) ||
            free_of_size(g, options, E, true, size, &trials, index))
            found = size;
    nh_free(e);
    nh_free(E);
    nh_free(metric);
    nh_free(K);
    return found;
}
