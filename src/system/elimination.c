/* elimination: the chart of coordinate velocities; which velocities depend on the others, and how. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/text.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "system/domain.h"
#include "system/constraint_samples.h"
#include "system/embedding_internal.h"

enum { most_subsets = 2000 };
static const double much_worse = 1e-3;

/* |det F_S| / sqrt(det F F^T), in [0, 1] by Cauchy and Binet; here through singular values.  Velocities are measured in
 * their units, so that those of lengths and angles compare, whatever the unit of length. */
static double volume(size_t rows, size_t columns, double *a)
{
    double *s = nh_alloc_array(rows + columns, sizeof *s), product = 1;
    if (!nh_svd(rows, columns, a, s, NULL, NULL)) product = 0;
    for (size_t i = 0; i < rows && i < columns; i++) product *= s[i];
    nh_free(s);
    return product;
}

typedef struct {
    double least, largest; /* over the probes */
    bool constant;         /* the determinant is the same everywhere and no constraint has a pole: no singular point */
} score;

static score subset_score(const nh_constraint_samples *c, const size_t *subset)
{
    static const double same = 1e-12;
    score s = {.least = INFINITY};
    double *a = nh_alloc_array(c->k * c->m + 1, sizeof *a), small = INFINITY, large = 0;
    for (size_t p = 0; p < c->count; p++) {
        const double *F = c->F + p * c->k * c->m;
        for (size_t j = 0; j < c->k * c->k; j++)
            a[j] = F[subset[j / c->k] * c->k + j % c->k] * c->unit[subset[j / c->k]];
        double part = volume(c->k, c->k, a);
        for (size_t j = 0; j < c->k * c->m; j++) a[j] = F[j] * c->unit[j / c->k];
        double whole = fmax(volume(c->k, c->m, a), 1e-300);
        s.least = fmin(s.least, part / whole);
        s.largest = fmax(s.largest, part / whole);
        small = fmin(small, part);
        large = fmax(large, part);
    }
    s.constant = c->count > 1 && small > large * (1 - same) && c->entire;
    nh_free(a);
    return s;
}

static bool next_subset(size_t k, size_t m, size_t *subset)
{
    for (size_t i = k; i-- > 0;) {
        if (subset[i] == m - k + i) continue;
        subset[i]++;
        for (size_t j = i + 1; j < k; j++) subset[j] = subset[j - 1] + 1;
        return true;
    }
    return false;
}

/* Constraints written as x' = ..., whose left sides do not occur on the right, show which velocities the user takes as
 * dependent. */
static bool written_explicitly(const nh_constraint_samples *c, size_t *out)
{
    const nh_system *system = c->system;
    for (size_t a = 0; a < c->k; a++) {
        out[a] = c->m;
        for (size_t i = 0; i < c->m; i++)
            if (system->constraint[a].lhs == system->coordinate[i].v) out[a] = i;
        if (out[a] == c->m) return false;
        for (size_t b = 0; b < a; b++)
            if (out[b] == out[a]) return false;
    }
    for (size_t a = 0; a < c->k; a++)
        for (size_t b = 0; b < c->k; b++)
            if (nh_depends(system->dag, system->constraint[a].rhs, system->coordinate[out[b]].v)) return false;
    return true;
}

/* A chart without singular points and without divisions, where there is one that is not much worse; z, and not y, of
 * z = x^2 + y^2. */
static bool better(score a, score b)
{
    bool a_usable = a.largest >= nh_chart_least_pivot, b_usable = b.largest >= nh_chart_least_pivot;
    if (a_usable != b_usable) return a_usable; /* a chart that breaks down all over the sampling domain is none */
    if (a.constant != b.constant) {
        const score *constant = a.constant ? &a : &b, *other = a.constant ? &b : &a;
        return (constant->least > much_worse * other->least) == a.constant;
    }
    /* of equally good coordinates the later one depends: users list first those that move freely */
    return a.least > b.least * (1 - 1e-9);
}

static double best_subset(const nh_constraint_samples *c, size_t *out)
{
    size_t *subset = nh_alloc_array(c->k + 1, sizeof *subset), tried = 0;
    score best = {.least = -1};
    for (size_t i = 0; i < c->k; i++) subset[i] = i;
    do {
        score at = subset_score(c, subset);
        if (best.least < 0 || better(at, best)) {
            best = at;
            memcpy(out, subset, c->k * sizeof *out);
        }
    } while (++tried < most_subsets && next_subset(c->k, c->m, subset));
    nh_free(subset);
    return best.least;
}

/* Where the user sets parameters: the velocities that suit the values of the file, unless they are much worse, so that
 * the formulas are the same for all values. */
static double best_dependent(const nh_constraint_samples *c, size_t *out)
{
    nh_constraint_samples written;
    double best = best_subset(c, out);
    if (!nh_constraint_samples_init_written(&written, c->system, c->seed)) return best;
    size_t *usual = nh_alloc_array(c->k + 1, sizeof *usual);
    double least = written.count && best_subset(&written, usual) > 0 ? subset_score(c, usual).least : 0;
    if (least > much_worse * best) {
        memcpy(out, usual, c->k * sizeof *out);
        best = least;
    }
    nh_free(usual);
    nh_constraint_samples_clear(&written);
    return best;
}

/* Do the constraints determine these velocities at almost all states?  Of nonlinear constraints by numbers. */
static bool determined(const nh_constraint_samples *c, const size_t *subset, double largest)
{
    static const double undetermined = 1e-12;
    size_t rank;
    return nh_constraint_samples_rank(c, c->k, c->k, subset, &rank) ? rank == c->k : largest >= undetermined;
}

/* The velocities that the user named or wrote, unless that chart breaks down all over the sampling domain: then another
 * one is chosen.  False: the constraints do not determine those. */
static bool choose_dependent(const nh_constraint_samples *c, size_t *out, double *pivot, bool *replaced)
{
    bool listed = c->system->dependents > 0, named = listed || written_explicitly(c, out);
    if (listed) memcpy(out, c->system->dependent, c->k * sizeof *out);
    score at = named ? subset_score(c, out) : (score){0};
    if (named && !determined(c, out, at.largest)) return false;
    *replaced = named && at.largest < nh_chart_least_pivot;
    *pivot = named && !*replaced ? at.least : best_dependent(c, out);
    if ((named && !*replaced) || determined(c, out, 1)) return true;
    for (size_t i = 0; i < c->k; i++) out[i] = i; /* the best ones by numbers were those of rounding */
    while (!determined(c, out, 0))
        if (!next_subset(c->k, c->m, out)) return false;
    return true;
}

/* ---- building the chart ---- */

static bool is_dependent(const size_t *dependent, size_t k, size_t i)
{
    size_t a = 0;
    while (a < k && dependent[a] != i) a++;
    return a < k;
}

static void copy_probes(nh_chart *chart, const nh_constraint_samples *c)
{
    const nh_coordinate *coordinate = c->system->coordinate;
    for (size_t p = 0; p < c->count; p++) {
        const double *from = c->point + p * c->width, *v = from + 1 + c->m;
        double *to = chart->probe + p * chart->width, *w = to + 1 + c->m;
        memcpy(to, from, (1 + c->m) * sizeof *to);
        for (size_t i = 0; i < chart->n; i++)
            for (size_t j = 0; j < c->m; j++)
                if (chart->w[i] == coordinate[j].v) w[i] = v[j];
        for (size_t a = 0; a < chart->implicit; a++) w[chart->n + a] = v[chart->dependent[a]];
    }
    chart->probes = c->count;
}

/* Linear in the dependent velocities: v_dep = -G^-1 f(v_dep = 0), G = df/dv_dep. */
static bool solve_linear(nh_chart *chart, const nh_constraint_samples *c, const nh_ex *G, const nh_ex *f)
{
    const nh_system *system = c->system;
    nh_dag *d = system->dag;
    nh_ex *zero = nh_alloc_array(c->k + 1, sizeof *zero), *u = nh_alloc_array(c->k + 1, sizeof *u),
          *b = nh_alloc_array(c->k + 1, sizeof *b);
    for (size_t a = 0; a < c->k; a++) u[a] = system->coordinate[chart->dependent[a]].v;
    for (size_t a = 0; a < c->k; a++) b[a] = nh_neg(d, nh_substitute(d, f[a], c->k, u, zero));
    nh_lu *lu = nh_lu_create(d, c->k, G, nh_embedding_score_at_start, chart, NULL);
    if (lu) nh_lu_solve(lu, b, b);
    for (size_t a = 0; a < c->k && lu; a++) chart->rho[chart->dependent[a]] = nh_simplify(d, b[a]);
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(zero);
    nh_free(u);
    nh_free(b);
    return good;
}

/* f = sum_j c_j u^j, a polynomial of degree 1 to most_degree in u: u^degree = -(c_0 + ... + c_(degree-1) u^(degree-1))
   / c_degree.  False: it is none. */
static bool relate(nh_dag *d, nh_ex f, nh_ex u)
{
    enum { most_degree = 8 };
    nh_ex slope = f, zero = nh_int(d, 0), sum = zero, c = zero, power = nh_int(d, 1);
    for (unsigned j = 0; j <= most_degree; j++) {
        c = nh_simplify(d, nh_substitute(d, slope, 1, &u, &zero));
        slope = nh_simplify(d, nh_div(d, nh_diff(d, slope, u), nh_int(d, (int64_t)j + 1))); /* f^(j+1) / (j+1)! */
        if (nh_is_zero(d, slope)) {
            if (j == 0 || nh_is_zero(d, c)) return false;
            nh_relate(d, u, j, nh_simplify(d, nh_neg(d, nh_div(d, sum, c))));
            return true;
        }
        sum = nh_add(d, sum, nh_mul(d, c, power));
        power = nh_mul(d, power, u);
    }
    return false;
}

/* Rules for implicit velocities, for normal forms: from a constraint that is a polynomial in one of them, and contains
 * no other one without a rule. */
static void relate_implicit(nh_chart *chart, size_t k, const nh_ex *f)
{
    nh_dag *d = chart->system->dag;
    bool *known = nh_alloc_array(2 * k + 1, sizeof *known), *used = known + k, more = true;
    while (more) {
        more = false;
        for (size_t a = 0; a < k; a++) {
            size_t open = 0, which = 0;
            for (size_t i = 0; i < k && !used[a]; i++)
                if (!known[i] && nh_depends(d, f[a], chart->u[i])) open++, which = i;
            if (open != 1 || !relate(d, f[a], chart->u[which])) continue;
            used[a] = known[which] = more = true;
        }
    }
    nh_free(known);
}

/* Nonlinear: k dependent velocities stay, as implicit symbols with du/dz = -G^-1 df/dz. */
static bool keep_implicit(nh_chart *chart, const nh_constraint_samples *c, size_t k, const nh_ex *G, const nh_ex *f)
{
    const nh_system *system = c->system;
    nh_dag *d = system->dag;
    relate_implicit(chart, k, f);
    size_t explicit_width = chart->width - k;
    nh_lu *lu = nh_lu_create(d, k, G, nh_embedding_score, chart, NULL);
    if (!lu) return false;
    nh_ex *b = nh_alloc_array(k * explicit_width + 1, sizeof *b);
    for (size_t j = 0; j < explicit_width; j++) { /* all partial derivatives before the first rule is set */
        for (size_t a = 0; a < k; a++) b[j * k + a] = nh_neg(d, nh_diff(d, f[a], chart->symbol[j]));
        nh_lu_solve(lu, b + j * k, b + j * k);
    }
    for (size_t j = 0; j < explicit_width; j++)
        for (size_t a = 0; a < k; a++) nh_diff_rule(d, chart->u[a], chart->symbol[j], b[j * k + a]);
    nh_lu_free(lu);
    nh_free(b);
    nh_ex *out = nh_alloc_array(k + k * k, sizeof *out);
    for (size_t a = 0; a < k; a++) {
        out[a] = chart->residual[a] = f[a];
        for (size_t i = 0; i < k; i++) out[k + a + i * k] = G[a * k + i];
    }
    const nh_ex *symbols;
    const double *values;
    nh_system_bindings(system, &symbols, &values);
    chart->newton = nh_tape_create(d, chart->width, chart->symbol, k + k * k, out, system->parameters, symbols, values);
    nh_free(out);
    return true;
}

/* The branch that most points of the domain lie on, counting those in the user's range for u: the sign of 2 a u + b. */
static int branch_of(const nh_constraint_samples *c, size_t which, nh_ex linear)
{
    const nh_system *system = c->system;
    const nh_ex *symbols;
    const double *values;
    double low, high, slope;
    long balance = 0;
    if (system->branch) return system->branch;
    nh_ex *in = nh_alloc_array(c->width, sizeof *in);
    in[0] = system->t;
    for (size_t i = 0; i < c->m; i++) in[1 + i] = system->coordinate[i].q, in[1 + c->m + i] = system->coordinate[i].v;
    nh_system_bindings(system, &symbols, &values);
    nh_domain_range(system, system->coordinate[which].v, &low, &high);
    nh_tape *tape = nh_tape_create(system->dag, c->width, in, 1, &linear, system->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < c->count; p++) {
        const double *z = c->point + p * c->width;
        double u = z[1 + c->m + which], inside = u >= low && u <= high ? 1000 : 1;
        nh_tape_eval(tape, work, z, &slope);
        balance += (long)(slope > 0 ? inside : -inside);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
    return balance >= 0 ? 1 : -1;
}

/* f = a u^2 + b u + c with u the velocity `which`: u = (-b + s sqrt(b^2 - 4 a c)) / (2 a), so that everything that
   follows is explicit. */
static bool quadratic_root(const nh_constraint_samples *sample, size_t which, nh_ex f, nh_quadratic *q)
{
    const nh_system *system = sample->system;
    nh_dag *d = system->dag;
    nh_ex u = system->coordinate[which].v, zero = nh_int(d, 0), slope = nh_diff(d, f, u);
    q->a = nh_simplify(d, nh_mul(d, nh_ratio(d, 1, 2), nh_diff(d, slope, u)));
    if (nh_depends(d, q->a, u) || nh_is_zero(d, q->a)) return false;
    q->b = nh_simplify(d, nh_substitute(d, slope, 1, &u, &zero));
    q->c = nh_substitute(d, f, 1, &u, &zero);
    q->radicand = nh_simplify(d, nh_sub(d, nh_powi(d, q->b, 2), nh_mul(d, nh_int(d, 4), nh_mul(d, q->a, q->c))));
    q->linear = nh_add(d, nh_mul(d, nh_int(d, 2), nh_mul(d, q->a, u)), q->b); /* = branch * sqrt(radicand) */
    q->branch = branch_of(sample, which, q->linear);
    nh_ex root = nh_mul(d, nh_int(d, q->branch), nh_sqrt(d, q->radicand));
    q->u = nh_simplify(d, nh_div(d, nh_sub(d, root, q->b), nh_mul(d, nh_int(d, 2), q->a)));
    return true;
}

/* ---- several constraints, some of them linear ---- */

typedef struct {
    size_t k, left;    /* constraints; those not solved yet, which are the first in f and dependent */
    nh_ex *f;          /* k: what must vanish; of solved ones: what their velocity is */
    size_t *dependent; /* k */
} triangle;

static bool contains_only_parameters(const nh_constraint_samples *c, nh_ex e)
{
    const nh_system *system = c->system;
    bool only = !nh_depends(system->dag, e, system->t);
    for (const nh_coordinate *at = system->coordinate; at < system->coordinate + c->m && only; at++)
        only = !nh_depends(system->dag, e, at->q) && !nh_depends(system->dag, e, at->v);
    return only;
}

/* Substitutes u', with f_a = slope u' + rest and the slope a number or a parameter, in all other constraints: it
 * depends on the rest. */
static bool solve_one(const nh_constraint_samples *c, triangle *t)
{
    const nh_system *system = c->system;
    nh_dag *d = system->dag;
    nh_ex zero = nh_int(d, 0);
    for (size_t a = 0; a < t->left; a++)
        for (size_t i = 0; i < t->left; i++) {
            nh_ex u = system->coordinate[t->dependent[i]].v, slope = nh_simplify(d, nh_diff(d, t->f[a], u));
            if (nh_is_zero(d, slope) || !contains_only_parameters(c, slope)) continue;
            nh_ex value = nh_simplify(d, nh_neg(d, nh_div(d, nh_substitute(d, t->f[a], 1, &u, &zero), slope)));
            size_t last = --t->left, which = t->dependent[i];
            t->f[a] = t->f[last];
            t->dependent[i] = t->dependent[last];
            t->f[last] = value;
            t->dependent[last] = which;
            for (size_t b = 0; b < t->k; b++)
                if (b != last) t->f[b] = nh_substitute(d, t->f[b], 1, &u, &value);
            return true;
        }
    return false;
}

static const char *chart_name(const nh_chart *chart, char *buffer, size_t size)
{
    size_t at = (size_t)snprintf(buffer, size, "coordinate velocities (");
    for (size_t i = 0; i < chart->n && at < size; i++)
        at += (size_t)snprintf(buffer + at, size - at, "%s%s", i ? ", " : "",
                               nh_name_of(chart->system->dag, chart->w[i]));
    if (at < size) snprintf(buffer + at, size - at, ")");
    return buffer;
}

/* df/dv_dep of what is left, by rows; are all its entries free of those velocities? */
static bool slopes(const nh_constraint_samples *c, const triangle *t, nh_ex *G)
{
    const nh_system *system = c->system;
    bool linear = true;
    for (size_t a = 0; a < t->left; a++)
        for (size_t i = 0; i < t->left; i++) {
            G[a * t->left + i] = nh_diff(system->dag, t->f[a], system->coordinate[t->dependent[i]].v);
            for (size_t j = 0; j < t->left; j++)
                linear &= !nh_depends(system->dag, G[a * t->left + i], system->coordinate[t->dependent[j]].v);
        }
    return linear;
}

/* The independent velocities are known. */
static nh_chart *chart_of(const nh_constraint_samples *c, const triangle *t, size_t implicit, double pivot)
{
    nh_system *system = c->system;
    nh_chart *chart = nh_embedding_new(system, "", c->m - c->k, implicit);
    char buffer[400];
    size_t n = 0;
    memcpy(chart->dependent, t->dependent, c->k * sizeof *t->dependent);
    chart->pivot = pivot;
    for (size_t i = 0; i < c->m; i++) {
        chart->rho[i] = system->coordinate[i].v;
        if (is_dependent(t->dependent, c->k, i)) continue;
        chart->free[n] = i;
        chart->w[n++] = system->coordinate[i].v;
    }
    for (size_t a = 0; a < implicit; a++) {
        size_t i = t->dependent[a];
        chart->rho[i] = chart->u[a] = nh_symbol_fresh(system->dag, nh_name_of(system->dag, system->coordinate[i].v));
    }
    nh_embedding_symbols(chart);
    copy_probes(chart, c);
    chart->name = nh_arena_strdup(chart->arena, chart_name(chart, buffer, sizeof buffer));
    return chart;
}

/* Writes the velocities that were solved before in terms of the remaining ones. */
static void put_solved(nh_chart *chart, const triangle *t)
{
    const nh_system *system = chart->system;
    for (size_t a = t->left; a < t->k; a++) {
        nh_ex e = t->f[a];
        for (size_t i = 0; i < t->left; i++)
            e = nh_substitute(system->dag, e, 1, &system->coordinate[t->dependent[i]].v, &chart->rho[t->dependent[i]]);
        chart->rho[t->dependent[a]] = nh_simplify(system->dag, e);
    }
}

/* Solves linear constraints all at once; of others the linear ones first.  A single remaining constraint that is
 * quadratic gives a root; otherwise the remaining velocities stay implicit. */
static nh_chart *solved(const nh_constraint_samples *c, triangle *t, nh_ex *G, double pivot)
{
    nh_dag *d = c->system->dag;
    nh_quadratic root;
    bool linear = slopes(c, t, G), good = true;
    while (!linear && solve_one(c, t)) continue;
    bool quadratic = !linear && t->left == 1 && quadratic_root(c, t->dependent[0], t->f[0], &root);
    size_t implicit = linear || quadratic ? 0 : t->left;
    if (!linear) slopes(c, t, G);
    nh_chart *chart = chart_of(c, t, implicit, pivot);
    nh_ex *v = nh_alloc_array(implicit + 1, sizeof *v);
    for (size_t a = 0; a < implicit; a++) v[a] = c->system->coordinate[t->dependent[a]].v;
    for (size_t a = 0; a < implicit * implicit; a++) G[a] = nh_substitute(d, G[a], implicit, v, chart->u);
    for (size_t a = 0; a < implicit; a++) t->f[a] = nh_substitute(d, t->f[a], implicit, v, chart->u);
    if (quadratic) nh_branches_quadratic(chart, t->dependent[0], &root);
    else if (linear && c->k) good = solve_linear(chart, c, G, t->f);
    else if (implicit) good = keep_implicit(chart, c, implicit, G, t->f);
    if (!linear) put_solved(chart, t);
    nh_free(v);
    if (good) nh_branches_note(chart);
    if (good) return chart;
    nh_chart_free(chart);
    return NULL;
}

static nh_chart *build(const nh_constraint_samples *c, const size_t *dependent, double pivot, nh_error *error)
{
    nh_system *system = c->system;
    const size_t k = c->k;
    nh_ex *f = nh_alloc_array(k + k * k + 1, sizeof *f);
    triangle t = {.k = k, .left = k, .f = f, .dependent = nh_alloc_array(k + 1, sizeof *t.dependent)};
    memcpy(t.dependent, dependent, k * sizeof *dependent);
    for (size_t a = 0; a < k; a++) f[a] = nh_sub(system->dag, system->constraint[a].lhs, system->constraint[a].rhs);
    nh_chart *chart = solved(c, &t, f + k, pivot);
    nh_free(t.dependent);
    nh_free(f);
    if (chart) return chart;
    nh_deck_fail(system->deck, system->constraint[0].node, 0, error,
                 "the constraints cannot be solved for the chosen dependent velocities");
    nh_error_hint(error, "name other velocities under `dependent:`, or remove that key");
    return NULL;
}

bool nh_embedding_ranks(nh_system *system, uint64_t seed, nh_error *error)
{
    nh_constraint_samples c;
    if (system->constraints == 0) return true;
    nh_constraint_samples_init(&c, system, system->constraints, seed);
    /* without a point nothing is decided: the chart of the user has points */
    bool good = c.count == 0 || nh_constraint_samples_check_rank(&c, seed, error);
    nh_constraint_samples_clear(&c);
    return good;
}

nh_chart *nh_embedding_coordinates(nh_system *system, uint64_t seed, nh_error *error)
{
    nh_constraint_samples c;
    nh_constraint_samples_init(&c, system, system->constraints, seed);
    nh_chart *chart = NULL;
    size_t *dependent = nh_alloc_array(c.k + 1, sizeof *dependent);
    bool replaced = false;
    if (c.k == 0 || nh_constraint_samples_check_rank(&c, seed, error)) {
        double pivot = 1;
        if (c.k && !choose_dependent(&c, dependent, &pivot, &replaced)) {
            nh_deck_fail(system->deck, system->constraint[0].node, 0, error,
                         "the constraints do not determine the velocities named under `dependent:`");
            nh_error_hint(error, "name other velocities, or remove `dependent:`");
        } else {
            chart = build(&c, dependent, pivot, error);
            if (chart) chart->replaced = replaced;
            if (chart && c.k) chart->regular = subset_score(&c, dependent).constant;
        }
    }
    nh_free(dependent);
    nh_constraint_samples_clear(&c);
    return chart;
}
