/* Conserved momenta f^a J_a of fields f^a e_a (momenta.h; docs/method.md, sec. 9):
 *
 *      columns       b_j(q) e_a, b_j products of at most two functions of the library
 *      rows          at each sample point omega(f^a e_a) = 0 and sym_ij X_i(f^a) K(X_j, e_a) = 0, X_i a basis of D
 *      null space -> coefficients, exact where relations are found -> momenta
 *      sort_out      drops functions of those found before and of what constraints keep constant (ranks modulo primes);
 *                    c^a J_a with constants on the submanifold is named after its symmetry
 *
 * With affine constraints, magnetic terms or forces f is constant, and f^a e_a . Q has to vanish. */
#include "reduction/momenta.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "reduction/library.h"
#include "reduction/relative.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

/* Columns: library functions b_j(q) times generators e_a.  The library is that of generators, with `component` the
   generator's number. */
typedef struct {
    const nh_action *g;
    const nh_kinetic *k;
    const nh_options *options;
    nh_library l;
    size_t m, d, f, n;
    nh_relative rows;
} search;

/* Orthonormal for K basis of D at a place: X (m x r). */
static size_t distribution_basis(const search *s, const double *K, const double *omega, double *X)
{
    size_t m = s->m, f = s->f;
    double *forms = nh_alloc_array(f * m + 1, sizeof *forms), *scale = nh_alloc_array(m, sizeof *scale);
    for (size_t i = 0; i < m; i++) scale[i] = 1 / sqrt(K[i * (m + 1)]);
    for (size_t a = 0; a < f; a++) {
        double size = 0;
        for (size_t i = 0; i < m; i++) size = hypot(size, omega[a * m + i] * scale[i]);
        for (size_t i = 0; i < m; i++) forms[a + i * f] = size > 0 ? omega[a * m + i] * scale[i] / size : 0;
    }
    size_t r = nh_kernel(f, m, forms, s->options->group, X, NULL, NULL);
    for (size_t j = 0; j < r; j++)
        for (size_t i = 0; i < m; i++) X[i + j * m] *= scale[i];
    nh_free(forms);
    nh_free(scale);
    return r;
}

/* Rows at a place from K, omega, E, b and its derivatives: omega(f^a e_a) = 0, sym_ij X_i(f^a) K(X_j, e_a) = 0; values
   of the field, in units of K. */
static void place_rows(search *s, const double *K, const double *omega, const double *E, const double *b,
                       const double *db)
{
    size_t m = s->m, d = s->d, f = s->f, n = s->n;
    double *X = nh_alloc_array(m * m + m * d + 1, sizeof *X), *KXe = X + m * m;
    size_t r = distribution_basis(s, K, omega, X);
    for (size_t i = 0; i < f; i++) {
        double *row = nh_relative_condition(&s->rows), size = 0;
        for (size_t q = 0; q < m; q++) size = hypot(size, omega[i * m + q] / sqrt(K[q * (m + 1)]));
        for (size_t c = 0; c < n; c++)
            for (size_t q = 0; q < m; q++) row[c] += b[c] * omega[i * m + q] * E[q + s->l.component[c] * m] / size;
    }
    for (size_t j = 0; j < r; j++)
        for (size_t a = 0; a < d; a++) {
            KXe[j + a * r] = 0;
            for (size_t p = 0; p < m; p++)
                for (size_t q = 0; q < m; q++) KXe[j + a * r] += X[p + j * m] * K[p * m + q] * E[q + a * m];
        }
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j <= i; j++) {
            double *row = nh_relative_condition(&s->rows);
            for (size_t c = 0; c < n; c++) {
                double along_i = 0, along_j = 0;
                for (size_t q = 0; q < m; q++)
                    along_i += db[c * m + q] * X[q + i * m], along_j += db[c * m + q] * X[q + j * m];
                row[c] = (along_i * KXe[j + s->l.component[c] * r] + along_j * KXe[i + s->l.component[c] * r]) / 2;
            }
        }
    for (size_t q = 0; q < m; q++) {
        double *row = nh_relative_value(&s->rows);
        for (size_t c = 0; c < n; c++) row[c] = b[c] * E[q + s->l.component[c] * m] * sqrt(K[q * (m + 1)]);
    }
    nh_free(X);
}

static void collect(search *s)
{
    const nh_kinetic *k = s->k;
    size_t m = s->m, d = s->d, f = s->f, n = s->n, total = m * m + f * m + m * d + n * (1 + m), at = 0;
    size_t places = k->places;
    nh_ex *e = nh_alloc_array(total, sizeof *e);
    memcpy(e, k->K, m * m * sizeof *e), at += m * m;
    memcpy(e + at, k->omega, f * m * sizeof *e), at += f * m;
    for (size_t a = 0; a < d; a++, at += m) memcpy(e + at, s->g->generator[a].component, m * sizeof *e);
    memcpy(e + at, s->l.function, n * sizeof *e), at += n;
    for (size_t c = 0; c < n; c++)
        for (size_t q = 0; q < m; q++) e[at++] = nh_diff(k->dag, s->l.function[c], k->q[q]);
    double *v = nh_alloc_array(total * places, sizeof *v);
    nh_kinetic_sample(k, total, e, places, v);
    for (size_t p = 0; p < places && nh_relative_wants_more(&s->rows); p++) {
        const double *z = v + p * total, *E = z + m * m + f * m, *b = E + m * d;
        if (isfinite(nh_largest(total, z))) place_rows(s, z, z + m * m, E, b, b + n);
    }
    nh_free(e);
    nh_free(v);
}

/* ---- from vectors to momenta ---- */

/* xi . K v */
static nh_ex momentum_of(const nh_kinetic *k, const nh_ex *xi)
{
    nh_dag *d = k->dag;
    nh_ex J = nh_int(d, 0);
    for (size_t r = 0; r < k->m; r++)
        for (size_t q = 0; q < k->m; q++)
            if (!nh_is_zero(d, xi[r]) && !nh_is_zero(d, k->K[r * k->m + q]))
                J = nh_add(d, J, nh_mul(d, nh_mul(d, xi[r], k->K[r * k->m + q]), k->v[q]));
    return J;
}

static void fill(const search *s, nh_momentum *p)
{
    const nh_kinetic *k = s->k;
    nh_dag *dag = k->dag;
    p->field = nh_arena_alloc(k->arena, s->m * sizeof *p->field);
    for (size_t q = 0; q < s->m; q++) {
        p->field[q] = nh_int(dag, 0);
        for (size_t a = 0; a < s->d; a++)
            p->field[q] = nh_add(dag, p->field[q], nh_mul(dag, p->f[a], s->g->generator[a].component[q]));
        p->field[q] = nh_simplify(dag, p->field[q]);
    }
    p->value = nh_simplify(dag, momentum_of(k, p->field));
}

/* The conditions on column c, told apart by the marks: omega(b_c e_a), and (b_c)' J_a for v in D, as functions on the
   submanifold. */
static nh_ex conditions(const search *s, size_t c, const nh_ex *mark)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    const nh_ex *field = s->g->generator[s->l.component[c]].component;
    nh_ex sum = nh_int(d, 0), along = nh_diff_along(d, s->l.function[c], s->m, k->q, k->v);
    for (size_t i = 0; i < s->f; i++)
        for (size_t q = 0; q < s->m; q++)
            sum = nh_add(d, sum,
                         nh_mul(d, mark[i], nh_mul(d, k->omega[i * s->m + q], nh_mul(d, s->l.function[c], field[q]))));
    if (nh_is_zero(d, along)) return sum;
    nh_ex rate = nh_mul(d, along, momentum_of(k, field));
    return nh_add(d, sum, nh_mul(d, mark[s->f], nh_chart_compose(k->model->chart, rate)));
}

/* The coefficients of the vector v; the pivot is its most complex column. */
static nh_proof coefficients(const search *s, const double *v, const size_t *order, nh_ex *c)
{
    nh_dag *d = s->k->dag;
    nh_ex *e = nh_alloc_array(s->n + s->f + 1, sizeof *e), *mark = e + s->n;
    size_t pivot = 0;
    nh_section_marks(d, s->f + 1, mark);
    for (size_t j = 0; j < s->n; j++) e[j] = v[j] == 0 ? nh_int(d, 0) : conditions(s, j, mark);
    for (size_t at = 0; at < s->n; at++)
        if (v[order[at]] != 0) pivot = order[at];
    nh_proof proof = nh_section_coefficients(s->k, s->n, e, v, pivot, s->options, c);
    nh_free(e);
    return proof;
}

/* The simplest term, of the last generator, gets no minus sign. */
static void normalise(const search *s, nh_ex *c)
{
    double complexity = INFINITY;
    size_t simplest = 0;
    for (size_t j = 0; j < s->n; j++) {
        if (nh_is_zero(s->k->dag, c[j]) || s->l.complexity[j] > complexity) continue;
        complexity = s->l.complexity[j];
        simplest = j;
    }
    if (!nh_section_negative(s->k->dag, c[simplest])) return;
    for (size_t j = 0; j < s->n; j++) c[j] = nh_neg(s->k->dag, c[j]);
}

/* ---- which gauge momenta are new ---- */

/* Fields that span D with all its brackets, the directions of the leaves in which motions stay, and their number; X has
 * room for m + 1 of them (m components each). */
static size_t leaves(const search *s, nh_ex *X)
{
    const nh_kinetic *k = s->k;
    const nh_chart *chart = k->model->chart;
    size_t m = s->m, n = chart->n, rank;
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < m; i++) X[j * m + i] = nh_diff(k->dag, chart->rho[i], chart->w[j]);
    for (size_t b = 1; b < n && n < m; b++)
        for (size_t a = 0; a < b && n < m; a++) {
            nh_field_bracket(k, X + a * m, X + b * m, X + n * m);
            if (nh_kinetic_rank(k, n + 1, m, X, &rank) && rank > n) n++;
        }
    return n;
}

/* Is the last of these momenta a function of the others and of what constraints keep constant?  Then the derivatives
 * along the leaves and by the velocities are dependent. */
static bool depends(const search *s, const nh_momenta *all)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    const nh_chart *chart = k->model->chart;
    size_t m = s->m, rows = all->count, with, without;
    nh_ex *X = nh_alloc_array((m + 1) * m, sizeof *X);
    size_t n = leaves(s, X), columns = n + chart->n, at = 0;
    nh_ex *e = nh_alloc_array(rows * columns, sizeof *e);
    for (size_t i = 0; i < rows; i++) {
        nh_ex J = nh_chart_compose(chart, all->momentum[i].value);
        for (size_t j = 0; j < n; j++) e[at++] = nh_diff_along(d, J, m, k->q, X + j * m);
        for (size_t j = 0; j < chart->n; j++) e[at++] = nh_diff(d, J, chart->w[j]);
    }
    bool old = nh_kinetic_rank(k, rows, columns, e, &with) && nh_kinetic_rank(k, rows - 1, columns, e, &without) &&
               with == without;
    nh_free(e);
    nh_free(X);
    return old;
}

/* Constants c with J = c^a J_a on the submanifold: but for a factor J is the momentum of the symmetry c^a e_a. */
static bool of_generators(const search *s, nh_momentum *p)
{
    const nh_kinetic *k = s->k;
    nh_dag *dag = k->dag;
    const nh_chart *chart = k->model->chart;
    size_t d = s->d, count;
    nh_ex *J = nh_alloc_array(d + 1, sizeof *J);
    for (size_t a = 0; a < d; a++) J[a] = nh_chart_compose(chart, momentum_of(k, s->g->generator[a].component));
    J[d] = nh_chart_compose(chart, p->value);
    const nh_ex *c = nh_section_relations(k, d + 1, 1, J, s->options, &count), *use = NULL;
    for (size_t j = 0; j < count && c && !use; j++)
        if (!nh_is_zero(dag, c[j * (d + 1) + d])) use = c + j * (d + 1);
    size_t first = 0;
    while (use && first < d && nh_is_zero(dag, use[first])) first++;
    use = first < d ? use : NULL;
    for (size_t a = 0; a < d && use; a++) p->f[a] = nh_simplify(dag, nh_div(dag, use[a], use[first]));
    if (use) fill(s, p);
    nh_free(J);
    return use != NULL;
}

/* The last momentum is kept if it is new, and called what it is: of a symmetry where it is that of one. */
static void sort_out(const search *s, nh_momenta *all)
{
    nh_generator g;
    nh_momentum *p = &all->momentum[all->count - 1];
    if (p->horizontal) return;
    if (depends(s, all)) {
        all->count--;
        return;
    }
    nh_generator_init(&g, s->k, NULL, p->field, s->options);
    p->horizontal = g.invariant && nh_generator_proof(s->k, &g).proved;
    p->gauge = !p->horizontal && !of_generators(s, p);
}

static void take(search *s, size_t count, double *v, nh_momenta *out)
{
    nh_dag *dag = s->k->dag;
    size_t *order = nh_library_order(&s->l);
    nh_ex *exact = nh_alloc_array(s->n + 1, sizeof *exact);
    double *size = nh_alloc_array(s->n + 1, sizeof *size);
    nh_relative_sizes(&s->rows, size);
    /* the most complex columns as pivots: the rest of each vector is then the simplest */
    nh_relative_echelon(s->n, count, order, size, v);
    out->momentum = nh_arena_alloc(s->k->arena, (count + 1) * sizeof *out->momentum);
    for (size_t r = count; r-- > 0;) {
        nh_momentum *p = &out->momentum[out->count++];
        *p = (nh_momentum){.horizontal = true, .proof = coefficients(s, v + r * s->n, order, exact)};
        normalise(s, exact);
        p->f = nh_arena_alloc(s->k->arena, (s->d + 1) * sizeof *p->f);
        for (size_t a = 0; a < s->d; a++) p->f[a] = nh_int(dag, 0);
        for (size_t c = 0; c < s->n; c++) {
            if (v[c + r * s->n] == 0) continue;
            size_t a = s->l.component[c];
            p->f[a] = nh_add(dag, p->f[a], nh_mul(dag, exact[c], s->l.function[c]));
            p->horizontal &= s->l.complexity[c] == 0;
        }
        fill(s, p);
        sort_out(s, out);
    }
    nh_free(size);
    nh_free(exact);
    nh_free(order);
}

size_t nh_momenta_unproved(nh_momenta *out, const nh_action *g)
{
    const nh_kinetic *k = g->kinetic;
    size_t n = 0;
    for (size_t i = 0; i < out->count; i++) {
        nh_momentum *p = &out->momentum[i];
        for (size_t a = 0; a < g->d; a++)
            if (!nh_is_zero(k->dag, p->f[a]))
                p->proof = nh_proof_both(k->model, p->proof, nh_generator_proof(k, &g->generator[a]));
        n += !p->proof.proved;
    }
    return n;
}

void nh_momenta_confirm(nh_momenta *out, const nh_model *model, const nh_options *options)
{
    size_t kept = 0;
    for (size_t i = 0; i < out->count; i++) {
        nh_momentum *p = &out->momentum[i];
        if (!p->proof.proved)
            p->proof = nh_prove_current(model, nh_chart_compose(model->chart, p->value), true, options);
        if (p->proof.proved || !p->proof.refuted) out->momentum[kept++] = *p;
    }
    out->count = kept;
}

void nh_momenta_mark(nh_momenta *out, const nh_kinetic *k)
{
    nh_dag *d = k->dag;
    size_t n = k->m + 1;
    nh_ex *from = nh_alloc_array(2 * n, sizeof *from), *to = from + n;
    for (size_t s = 0; s < k->m; s++) from[s] = k->v[s], to[s] = nh_real(d, k->speed[s]);
    from[k->m] = k->model->system->t, to[k->m] = nh_real(d, k->time[0]);
    for (size_t i = 0; i < out->count; i++) {
        nh_ex value = nh_substitute(d, out->momentum[i].value, n, from, to);
        out->momentum[i].local =
            nh_kinetic_many_valued(k, k->m, out->momentum[i].field) || nh_kinetic_many_valued(k, 1, &value);
    }
    nh_free(from);
}

/* ---- other systems: affine constraints, a part of L linear in the velocities, forces ---- */

/* f^a e_a and f^a e_a . (K v + a). */
static void fill_general(const nh_action *g, nh_momentum *p)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = k->dag;
    p->field = nh_arena_alloc(k->arena, k->m * sizeof *p->field);
    p->value = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++) {
        nh_ex component = nh_int(d, 0), momentum = k->a[s];
        for (size_t a = 0; a < g->d; a++)
            component = nh_add(d, component, nh_mul(d, p->f[a], g->generator[a].component[s]));
        for (size_t r = 0; r < k->m; r++) momentum = nh_add(d, momentum, nh_mul(d, k->K[s * k->m + r], k->v[r]));
        p->field[s] = nh_simplify(d, component);
        if (!nh_is_zero(d, p->field[s])) p->value = nh_add(d, p->value, nh_mul(d, p->field[s], momentum));
    }
}

/* The conditions on generator a, told apart by the marks: omega(e_a) = 0 and e_a . Q = 0. */
static nh_ex general_conditions(const nh_action *g, size_t a, const nh_ex *mark)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = k->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++) {
        nh_ex x = g->generator[a].component[s];
        for (size_t i = 0; i < k->f; i++)
            sum = nh_add(d, sum, nh_mul(d, mark[i], nh_mul(d, k->omega[i * k->m + s], x)));
        if (k->forced) sum = nh_add(d, sum, nh_mul(d, mark[k->f], nh_mul(d, k->Q[s], x)));
    }
    return sum;
}

nh_proof nh_momenta_horizontal(const nh_action *g, const double *c, bool offset, const nh_options *options, nh_ex *out)
{
    static const double rounding = 1e-14;
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = k->dag;
    size_t n = g->d + offset;
    nh_ex *e = nh_alloc_array(2 * n + k->f + 1, sizeof *e), *exact = e + n, *mark = exact + n;
    double *v = nh_alloc_array(n + 1, sizeof *v);
    nh_section_marks(d, k->f + 1, mark);
    for (size_t a = 0; a < g->d; a++) e[a] = general_conditions(g, a, mark);
    if (offset) e[g->d] = nh_section_marked(d, k->f, mark, k->b);
    if (offset) v[g->d] = 1;
    nh_proof proof = {0};
    for (int noisy = 0; noisy < 2 && !proof.proved; noisy++) { /* small coefficients may be rounding errors */
        for (size_t a = 0; a < g->d; a++) v[a] = fabs(c[a]) <= (noisy ? options->same : rounding) ? 0 : c[a];
        proof = nh_section_coefficients(k, n, e, v, offset ? g->d : nh_section_pivot(n, v), options, exact);
    }
    memcpy(out, exact, g->d * sizeof *out);
    nh_free(v);
    nh_free(e);
    return proof;
}

/* 1/2 v K v + V. */
static nh_ex energy_of(const nh_kinetic *k)
{
    nh_dag *d = k->dag;
    nh_ex E = k->V;
    for (size_t r = 0; r < k->m; r++)
        for (size_t s = 0; s <= r; s++)
            E = nh_add(
                d, E,
                nh_mul(d, nh_mul(d, nh_ratio(d, r == s ? 1 : 2, 2), k->K[r * k->m + s]), nh_mul(d, k->v[r], k->v[s])));
    return E;
}

/* The momenta of horizontal symmetries, of which only proved ones are taken; room for `more` others. */
static void find_horizontal(nh_momenta *out, const nh_action *g, size_t more, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    double *c = nh_alloc_array(g->d * g->d + 1, sizeof *c);
    size_t n = nh_action_horizontal(g, options, c);
    *out = (nh_momenta){.momentum = nh_arena_alloc(k->arena, (n + more + 1) * sizeof *out->momentum)};
    for (size_t j = 0; j < n; j++) {
        nh_momentum *p = &out->momentum[out->count];
        *p = (nh_momentum){.horizontal = true, .f = nh_arena_alloc(k->arena, (g->d + 1) * sizeof *p->f)};
        p->proof = nh_momenta_horizontal(g, c + j * g->d, false, options, p->f);
        fill_general(g, p);
        p->value = nh_simplify(k->dag, p->value);
        out->count += p->proof.proved;
    }
    nh_free(c);
}

/* Horizontal symmetries with coefficients that are small beside others are lost in the fit. */
static void complete_horizontal(nh_momenta *found, const nh_action *g, const nh_options *options)
{
    nh_momenta all;
    size_t horizontal = 0;
    for (size_t i = 0; i < found->count; i++)
        horizontal += found->momentum[i].horizontal && found->momentum[i].proof.proved;
    find_horizontal(&all, g, found->count, options);
    if (all.count <= horizontal) return;
    for (size_t i = 0; i < found->count; i++)
        if (!found->momentum[i].horizontal) all.momentum[all.count++] = found->momentum[i];
    *found = all;
}

static void find_general(nh_momenta *out, const nh_action *g, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = k->dag;
    double *c = nh_alloc_array(g->d + 1, sizeof *c);
    find_horizontal(out, g, 1, options);
    if (!k->linear && !k->forced && nh_action_moving(g, c)) {
        nh_momentum *p = &out->momentum[out->count];
        *p = (nh_momentum){.moving = true, .f = nh_arena_alloc(k->arena, (g->d + 1) * sizeof *p->f)};
        p->proof = nh_momenta_horizontal(g, c, true, options, p->f);
        fill_general(g, p);
        p->value = nh_simplify(d, nh_sub(d, energy_of(k), p->value));
        out->count += p->proof.proved;
    }
    nh_free(c);
}

bool nh_momenta_find(nh_momenta *out, const nh_action *g, const nh_options *options, nh_error *error)
{
    enum { most_columns = 420 };
    const nh_kinetic *k = g->kinetic;
    bool good = true;
    size_t most = 0;
    *out = (nh_momenta){0};
    if (!k->reducible) {
        if (g->d) find_general(out, g, options);
        return true;
    }
    for (int level = 1; level <= 3 && good && g->d; level++) { /* 2: with 1/sin and the like; 3: products of two */
        search s = {.g = g, .k = k, .options = options, .m = k->m, .d = g->d, .f = k->f};
        nh_momenta found = {0};
        size_t count;
        nh_library_for(&s.l, k, g->d, level == 3 ? 1 : level, level == 3 ? 2 : 1, most_columns);
        s.n = s.rows.columns = s.l.count;
        collect(&s);
        double *vector = nh_relative_null(&s.rows, options, &count, NULL, NULL, error);
        good = vector != NULL;
        if (good && count > most) take(&s, count, vector, &found), *out = found, most = count;
        nh_free(vector);
        nh_relative_clear(&s.rows);
        nh_library_clear(&s.l);
    }
    if (good && k->f) complete_horizontal(out, g, options);
    return good;
}
