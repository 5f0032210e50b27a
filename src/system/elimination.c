/* elimination: the chart of coordinate velocities; which velocities depend on the others, and how. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/text.h"
#include "expr/diff.h"
#include "expr/normal.h"
#include "expr/solve.h"
#include "system/cloud.h"
#include "system/embedding_internal.h"

enum { most_subsets = 2000 };

/* ---- which velocities to eliminate ---- */

/* |det F_S| / sqrt(det F F^T), in [0, 1] by Cauchy and Binet; here through singular values. */
static double volume(size_t rows, size_t columns, double *a)
{
    double *s = nh_alloc_array(rows + columns, sizeof *s), product = 1;
    if (!nh_svd(rows, columns, a, s, NULL, NULL)) product = 0;
    for (size_t i = 0; i < rows && i < columns; i++) product *= s[i];
    nh_free(s);
    return product;
}

/* The least over the probes; *largest gets the largest. */
static double subset_score(const nh_cloud *c, const size_t *subset, double *largest)
{
    double least = INFINITY;
    *largest = 0;
    double *a = nh_alloc_array(c->k * c->m + 1, sizeof *a);
    for (size_t p = 0; p < c->count; p++) {
        const double *F = c->F + p * c->k * c->m;
        for (size_t j = 0; j < c->k; j++) memcpy(a + j * c->k, F + subset[j] * c->k, c->k * sizeof *a);
        double part = volume(c->k, c->k, a);
        memcpy(a, F, c->k * c->m * sizeof *a);
        double whole = fmax(volume(c->k, c->m, a), 1e-300);
        least = fmin(least, part / whole);
        *largest = fmax(*largest, part / whole);
    }
    nh_free(a);
    return least;
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

/* Constraints written as  x' = ...  with the left sides not occurring on the right tell what the user had in mind. */
static bool written_explicitly(const nh_cloud *c, size_t *out)
{
    const nh_system *s = c->system;
    for (size_t a = 0; a < c->k; a++) {
        out[a] = c->m;
        for (size_t i = 0; i < c->m; i++)
            if (s->constraint[a].lhs == s->coordinate[i].v) out[a] = i;
        if (out[a] == c->m) return false;
        for (size_t b = 0; b < a; b++)
            if (out[b] == out[a]) return false;
    }
    for (size_t a = 0; a < c->k; a++)
        for (size_t b = 0; b < c->k; b++)
            if (nh_depends(s->dag, s->constraint[a].rhs, s->coordinate[out[b]].v)) return false;
    return true;
}

static double best_dependent(const nh_cloud *c, size_t *out)
{
    size_t *subset = nh_alloc_array(c->k + 1, sizeof *subset), tried = 0;
    double best = -1, largest;
    for (size_t i = 0; i < c->k; i++) subset[i] = i;
    do {
        double score = subset_score(c, subset, &largest);
        if (score > best * (1 - 1e-9) || best < 0) { /* later coordinates win ties: users list first what moves freely */
            best = score;
            memcpy(out, subset, c->k * sizeof *out);
        }
    } while (++tried < most_subsets && next_subset(c->k, c->m, subset));
    nh_free(subset);
    return best;
}

/* What the user named or wrote, unless that breaks down all over the sampling domain: then another chart takes over. */
static double choose_dependent(const nh_cloud *c, size_t *out, bool *replaced)
{
    static const double undetermined = 1e-12;
    const nh_system *s = c->system;
    double largest;
    if (s->dependents) memcpy(out, s->dependent, c->k * sizeof *out);
    *replaced = false;
    if (!s->dependents && !written_explicitly(c, out)) return best_dependent(c, out);
    double least = subset_score(c, out, &largest);
    *replaced = largest > undetermined && largest < nh_chart_least_pivot;
    return *replaced ? best_dependent(c, out) : least;
}

/* ---- building the chart ---- */

static bool is_dependent(const size_t *dependent, size_t k, size_t i)
{
    for (size_t a = 0; a < k; a++)
        if (dependent[a] == i) return true;
    return false;
}

static void copy_probes(nh_chart *chart, const nh_cloud *c)
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
static bool solve_linear(nh_chart *chart, const nh_cloud *c, const nh_ex *G, const nh_ex *f)
{
    const nh_system *s = c->system;
    nh_dag *d = s->dag;
    nh_ex *zero = nh_alloc_array(c->k + 1, sizeof *zero), *u = nh_alloc_array(c->k + 1, sizeof *u), *b = nh_alloc_array(c->k + 1, sizeof *b);
    for (size_t a = 0; a < c->k; a++) u[a] = s->coordinate[chart->dependent[a]].v;
    for (size_t a = 0; a < c->k; a++) b[a] = nh_neg(d, nh_substitute(d, f[a], c->k, u, zero));
    nh_lu *lu = nh_lu_create(d, c->k, G, nh_embedding_score, chart, NULL);
    if (lu) nh_lu_solve(lu, b, b);
    for (size_t a = 0; a < c->k && lu; a++) chart->rho[chart->dependent[a]] = nh_simplify(d, b[a]);
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(zero);
    nh_free(u);
    nh_free(b);
    return good;
}

/* Nonlinear: the dependent velocities stay, as implicit symbols with du/dz = -G^-1 df/dz. */
static bool keep_implicit(nh_chart *chart, const nh_cloud *c, const nh_ex *G, const nh_ex *f)
{
    const nh_system *s = c->system;
    nh_dag *d = s->dag;
    size_t k = c->k, explicit_width = chart->width - k;
    nh_lu *lu = nh_lu_create(d, k, G, nh_embedding_score, chart, NULL);
    if (!lu) return false;
    nh_ex *b = nh_alloc_array(k * explicit_width + 1, sizeof *b);
    for (size_t j = 0; j < explicit_width; j++) { /* all partial derivatives before the first rule */
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
    nh_system_bindings(s, &symbols, &values);
    chart->newton = nh_tape_create(d, chart->width, chart->symbol, k + k * k, out, s->parameters, symbols, values);
    nh_free(out);
    return true;
}

/* The branch that most points of the domain lie on, counting those in the user's range for u: the sign of df/du. */
static int branch_of(const nh_cloud *c, size_t which)
{
    double low, high;
    long balance = 0;
    if (c->system->branch) return c->system->branch;
    nh_embedding_range(c->system, c->system->coordinate[which].v, &low, &high);
    for (size_t p = 0; p < c->count; p++) {
        const double *z = c->point + p * c->width;
        double u = z[1 + c->m + which], inside = u >= low && u <= high ? 1000 : 1;
        nh_tape_eval(c->tape, c->work, z, c->out);
        balance += (long)(c->out[c->k + which * c->k] > 0 ? inside : -inside);
    }
    return balance >= 0 ? 1 : -1;
}

/* One constraint a u^2 + b u + c = 0: u = (-b + s sqrt(b^2 - 4 a c)) / (2 a), so that everything that follows is explicit. */
static bool quadratic_root(const nh_cloud *c, size_t which, int branch, nh_ex *out, nh_ex *radicand, nh_ex *in_velocities)
{
    const nh_system *s = c->system;
    nh_dag *d = s->dag;
    if (c->k != 1) return false;
    nh_ex u = s->coordinate[which].v, zero = nh_int(d, 0), f = nh_sub(d, s->constraint[0].lhs, s->constraint[0].rhs);
    nh_ex slope = nh_diff(d, f, u), a = nh_simplify(d, nh_mul(d, nh_ratio(d, 1, 2), nh_diff(d, slope, u)));
    if (nh_depends(d, a, u) || nh_is_zero(d, a)) return false;
    nh_ex b = nh_simplify(d, nh_substitute(d, slope, 1, &u, &zero)), rest = nh_substitute(d, f, 1, &u, &zero);
    nh_ex under = nh_simplify(d, nh_sub(d, nh_powi(d, b, 2), nh_mul(d, nh_int(d, 4), nh_mul(d, a, rest))));
    nh_ex root = nh_mul(d, nh_int(d, branch), nh_sqrt(d, under));
    nh_ex linear = nh_add(d, nh_mul(d, nh_int(d, 2), nh_mul(d, a, u)), b); /* 2 a u + b = branch * sqrt(under) */
    *out = nh_simplify(d, nh_div(d, nh_sub(d, root, b), nh_mul(d, nh_int(d, 2), a)));
    *radicand = under;
    *in_velocities = nh_mul(d, nh_int(d, branch), linear);
    return true;
}

static const char *chart_name(const nh_chart *chart, char *buffer, size_t size)
{
    size_t at = (size_t)snprintf(buffer, size, "coordinate velocities (");
    for (size_t i = 0; i < chart->n && at < size; i++)
        at += (size_t)snprintf(buffer + at, size - at, "%s%s", i ? ", " : "", nh_name_of(chart->system->dag, chart->w[i]));
    if (at < size) snprintf(buffer + at, size - at, ")");
    return buffer;
}

static nh_chart *build(const nh_cloud *c, const size_t *dependent, double pivot, nh_error *error)
{
    nh_system *s = c->system;
    nh_dag *d = s->dag;
    size_t k = c->k, m = c->m;
    nh_ex *f = nh_alloc_array(k + k * k + 1, sizeof *f), *G = f + k;
    bool linear = true;
    for (size_t a = 0; a < k; a++) {
        f[a] = nh_sub(d, s->constraint[a].lhs, s->constraint[a].rhs);
        for (size_t i = 0; i < k; i++) {
            G[a * k + i] = nh_diff(d, f[a], s->coordinate[dependent[i]].v);
            for (size_t j = 0; j < k; j++) linear &= !nh_depends(d, G[a * k + i], s->coordinate[dependent[j]].v);
        }
    }
    nh_ex root = 0, radicand = 0, in_velocities = 0;
    int branch = linear ? 0 : branch_of(c, dependent[0]);
    bool quadratic = !linear && quadratic_root(c, dependent[0], branch, &root, &radicand, &in_velocities), implicit = !linear && !quadratic;
    nh_chart *chart = nh_embedding_new(s, "", m - k, implicit ? k : 0);
    memcpy(chart->dependent, dependent, k * sizeof *dependent);
    chart->pivot = pivot;
    size_t n = 0;
    for (size_t i = 0; i < m; i++) {
        chart->rho[i] = s->coordinate[i].v;
        if (is_dependent(dependent, k, i)) continue;
        chart->free[n] = i;
        chart->w[n++] = s->coordinate[i].v;
    }
    nh_ex *v = nh_alloc_array(k + 1, sizeof *v);
    for (size_t a = 0; a < k && implicit; a++) {
        v[a] = s->coordinate[dependent[a]].v;
        chart->rho[dependent[a]] = chart->u[a] = nh_symbol_fresh(d, nh_name_of(d, v[a]));
    }
    for (size_t a = 0; a < k + k * k && implicit; a++) f[a] = nh_substitute(d, f[a], k, v, chart->u);
    if (quadratic) {
        chart->rho[dependent[0]] = root;
        chart->branch = branch;
        chart->radicand = radicand;
        chart->root = in_velocities;
    }
    nh_free(v);
    nh_embedding_symbols(chart);
    copy_probes(chart, c);
    char buffer[400];
    chart->name = nh_arena_strdup(chart->arena, chart_name(chart, buffer, sizeof buffer));
    bool good = k == 0 || quadratic || (linear ? solve_linear(chart, c, G, f) : keep_implicit(chart, c, G, f));
    nh_free(f);
    if (good) return chart;
    nh_chart_free(chart);
    nh_deck_fail(s->deck, s->constraint[0].node, 0, error, "the constraints cannot be solved for the chosen dependent velocities");
    nh_error_hint(error, "name others under `dependent:`, or leave it out");
    return NULL;
}

bool nh_embedding_ranks(nh_system *system, uint64_t seed, nh_error *error)
{
    nh_cloud c;
    if (system->constraints == 0) return true;
    nh_cloud_init(&c, system, system->constraints, seed);
    bool good = c.count == 0 || nh_cloud_check_rank(&c, seed, error); /* no point found says nothing: the user's chart has points */
    nh_cloud_clear(&c);
    return good;
}

nh_chart *nh_embedding_coordinates(nh_system *system, uint64_t seed, nh_error *error)
{
    nh_cloud c;
    nh_cloud_init(&c, system, system->constraints, seed);
    nh_chart *chart = NULL;
    size_t *dependent = nh_alloc_array(c.k + 1, sizeof *dependent);
    bool replaced = false;
    if (c.k == 0 || nh_cloud_check_rank(&c, seed, error)) {
        double pivot = c.k ? choose_dependent(&c, dependent, &replaced) : 1;
        if (pivot < 1e-12) {
            nh_deck_fail(system->deck, system->constraint[0].node, 0, error, "the constraints do not determine the velocities named under `dependent:`");
            nh_error_hint(error, "name others, or leave `dependent:` out");
        } else {
            chart = build(&c, dependent, pivot, error);
            if (chart) chart->replaced = replaced;
        }
    }
    nh_free(dependent);
    nh_cloud_clear(&c);
    return chart;
}
