#include "search/dependence.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "exact/relation.h"
#include "graph/dag.h"
#include "problem/analysis_file.h"
#include "search/current_list.h"

enum { most_currents = 6, point_factor = 3 };

/* Monomials of degree <= 2 in phi_1..phi_r and the dependent one (last), the ones with it last. */
typedef struct {
    size_t count;
    nh_ex *name_of; /* monomials in the symbols Phi1, ... */
    nh_ex *value;   /* the same in the currents */
} monomials;

/* The product of two names, and of two currents. */
static void add(nh_dag *d, monomials *m, nh_ex pa, nh_ex pb, nh_ex va, nh_ex vb)
{
    m->name_of[m->count] = nh_mul(d, pa, pb);
    m->value[m->count++] = nh_mul(d, va, vb);
}

static monomials build(nh_analysis *result, size_t n, const nh_ex *symbol, const nh_ex *phi)
{
    nh_dag *d = result->question->model->dag;
    size_t most = (n + 1) * (n + 2) / 2;
    monomials m = {0, nh_alloc_array(most, sizeof(nh_ex)), nh_alloc_array(most, sizeof(nh_ex))};
    nh_ex one = nh_int(d, 1);
    add(d, &m, one, one, one, one);
    for (size_t i = 0; i < n; i++) add(d, &m, symbol[i], one, phi[i], one);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) add(d, &m, symbol[i], symbol[j], phi[i], phi[j]);
    return m;
}

/* The null vector of the monomials' values with the fewest entries: the columns are added one by one until they first
 * become dependent. */
static bool numeric_relation(const nh_points *points, const nh_model *model, const monomials *m, bool *used)
{
    size_t count = points->count, n = m->count;
    double *value = nh_alloc_array(n * count, sizeof *value), *a = nh_alloc_array(n * count, sizeof *a),
           *b = nh_alloc_array(count, sizeof *b);
    bool found = false;
    nh_points_evaluate(points, model, n, m->value, value);
    for (size_t j = 0; j < n; j++) {
        double size = 0;
        for (size_t p = 0; p < count; p++) size += value[j * count + p] * value[j * count + p];
        for (size_t p = 0; p < count && size > 0; p++) value[j * count + p] /= sqrt(size);
        if (!isfinite(size)) break;
    }
    for (size_t j = 1; j < n && !found; j++) {
        memcpy(a, value, j * count * sizeof *a);
        memcpy(b, value + j * count, count * sizeof *b);
        if (count <= j || nh_least_squares(count, j, a, 1, b, count, 1e-12) < (int)j) break;
        double worst = 0;
        for (size_t p = 0; p < count; p++) {
            double rest = value[j * count + p];
            for (size_t i = 0; i < j; i++) rest -= b[i] * value[i * count + p];
            worst = fmax(worst, fabs(rest) * sqrt((double)count));
        }
        found = worst < 1e-9;
        for (size_t i = 0; i < j && found; i++) used[i] = fabs(b[i]) > 1e-9;
        used[j] = found;
    }
    nh_free(b);
    nh_free(a);
    nh_free(value);
    return found;
}

/* "Phi4^2 = ..." with exact coefficients, or NULL. */
static const char *exact_relation(nh_analysis *result, const monomials *m, const bool *used, nh_ex own)
{
    nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    nh_ex *value = nh_alloc_array(m->count, sizeof *value), *name = nh_alloc_array(m->count, sizeof *name),
          *c = nh_alloc_array(m->count, sizeof *c);
    size_t n = 0, pivot = 0;
    for (size_t j = 0; j < m->count; j++) {
        if (!used[j]) continue;
        if (nh_depends(d, m->name_of[j], own)) pivot = n;
        value[n] = m->value[j];
        name[n++] = m->name_of[j];
    }
    const char *text = NULL;
    bool exact = nh_relation_find(d, n, value, model->system->parameters, model->parameter,
                                  (size_t)result->question->options.proof_terms, c) == NH_RELATION_UNIQUE;
    if (exact && !nh_is_zero(d, c[pivot])) {
        nh_ex right = nh_int(d, 0);
        for (size_t j = 0; j < n; j++)
            if (j != pivot) right = nh_sub(d, right, nh_mul(d, nh_simplify(d, nh_div(d, c[j], c[pivot])), name[j]));
        char *left = nh_print_string(d, name[pivot]), *rest = nh_print_string(d, right);
        text = nh_arena_printf(result->arena, "%s = %s", left, rest);
        nh_free(left);
        nh_free(rest);
    }
    nh_free(c);
    nh_free(name);
    nh_free(value);
    return text;
}

/* The independent ones among the first `count` currents. */
static size_t independent_ones(nh_analysis *result, size_t count, nh_ex *symbol, nh_ex *phi)
{
    size_t n = 0;
    for (const nh_current *g = result->list->found; g < result->list->found + count && n < most_currents; g++) {
        if (g->independence != NH_INDEPENDENT || g->series) continue;
        symbol[n] = nh_symbol_fresh(result->question->model->dag, g->name);
        phi[n++] = g->phi;
    }
    return n;
}

/* Of the second degree, for the last of n; or NULL. */
static const char *relate(nh_analysis *result, const nh_points *points, size_t n, const nh_ex *symbol, const nh_ex *phi)
{
    monomials m = build(result, n, symbol, phi);
    bool *used = nh_alloc_array(m.count, sizeof *used);
    const char *text = numeric_relation(points, result->question->model, &m, used)
                           ? exact_relation(result, &m, used, symbol[n - 1])
                           : NULL;
    nh_free(used);
    nh_free(m.name_of);
    nh_free(m.value);
    return text;
}

static nh_points *points_for_relations(const nh_analysis *result)
{
    size_t monomial_count = (most_currents + 2) * (most_currents + 3) / 2;
    nh_error ignored;
    nh_error_clear(&ignored);
    return nh_points_create(result->question->model, point_factor * monomial_count, 1,
                            (uint64_t)result->question->options.seed + 303, &ignored);
}

void nh_dependence_relations(nh_analysis *result)
{
    const nh_current_list *list = result->list;
    nh_ex symbol[most_currents + 1], phi[most_currents + 1];
    nh_points *points = NULL;
    for (size_t k = 0; k < list->count; k++) {
        if (list->found[k].independence != NH_DEPENDENT) continue;
        if (!points) points = points_for_relations(result);
        if (!points) break;
        size_t n = independent_ones(result, k, symbol, phi);
        symbol[n] = nh_symbol_fresh(result->question->model->dag, list->found[k].name);
        phi[n++] = list->found[k].phi;
        nh_current_list_describe(result, &list->found[k])->relation = relate(result, points, n, symbol, phi);
    }
    nh_points_free(points);
}

/* ---- with the currents that the system's file knows ---- */

enum { most_known = 6 };

/* The known currents that can be written in the chart, as "[Phi3]" where the file says Phi3: the found ones may have
 * the same names. */
static size_t known_currents(nh_analysis *result, nh_ex *symbol, nh_ex *phi, const char **doc)
{
    nh_model *model = result->question->model;
    const nh_system *system = model->system;
    size_t n = 0;
    nh_error ignored;
    nh_error_clear(&ignored);
    for (size_t k = 0; k < system->currents && n < most_known; k++) {
        if (!nh_analysis_file_to_chart(model, system->current[k].value, &phi[n], &ignored)) continue;
        doc[n] = system->current[k].doc;
        symbol[n++] = nh_symbol_fresh(model->dag, nh_arena_printf(result->arena, "[%s]", system->current[k].name));
    }
    return n;
}

/* "Phi2 = -[Phi3]" where the last of n + 1 is a constant multiple of the k-th, or NULL. */
static const char *multiple(nh_analysis *result, const nh_points *points, size_t n, size_t k, const nh_ex *symbol,
                            const nh_ex *phi)
{
    monomials two = {2, (nh_ex[]){symbol[k], symbol[n]}, (nh_ex[]){phi[k], phi[n]}};
    bool both[2] = {false, false};
    return numeric_relation(points, result->question->model, &two, both) ? exact_relation(result, &two, both, symbol[n])
                                                                         : NULL;
}

/* Is it a constant multiple of one of them, or a sum of multiples? */
static const char *combination(nh_analysis *result, const nh_points *points, size_t n, const nh_ex *symbol,
                               const nh_ex *phi)
{
    nh_ex name[most_known + 1], value[most_known + 1];
    bool used[most_known + 1] = {false};
    for (size_t k = 0; k < n; k++) {
        const char *text = multiple(result, points, n, k, symbol, phi);
        if (text) return text;
    }
    memcpy(name, symbol, (n + 1) * sizeof *name);
    memcpy(value, phi, (n + 1) * sizeof *value);
    monomials all = {n + 1, name, value};
    return numeric_relation(points, result->question->model, &all, used) && used[n]
               ? exact_relation(result, &all, used, symbol[n])
               : NULL;
}

/* Is it the product or the quotient of two of them, up to a constant factor? */
static const char *product(nh_analysis *result, const nh_points *points, size_t n, const nh_ex *symbol,
                           const nh_ex *phi)
{
    nh_dag *d = result->question->model->dag;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t quotient = j <= i ? 0 : 1; quotient < 2; quotient++) {
                if (quotient && i == j) continue;
                nh_ex name = quotient ? nh_div(d, symbol[i], symbol[j]) : nh_mul(d, symbol[i], symbol[j]);
                nh_ex value = quotient ? nh_div(d, phi[i], phi[j]) : nh_mul(d, phi[i], phi[j]);
                monomials two = {2, (nh_ex[]){name, symbol[n]}, (nh_ex[]){value, phi[n]}};
                bool used[2] = {false, false};
                const char *text = numeric_relation(points, result->question->model, &two, used)
                                       ? exact_relation(result, &two, used, symbol[n])
                                       : NULL;
                if (text) return text;
            }
    return NULL;
}

void nh_dependence_on_known(nh_analysis *result)
{
    nh_model *model = result->question->model;
    nh_ex symbol[most_known + 1], phi[most_known + 1];
    const char *doc[most_known];
    size_t n = model->system->currents ? known_currents(result, symbol, phi, doc) : 0;
    nh_points *points = NULL;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (n)
        points = nh_points_create(model, point_factor * (most_known + 1), 1,
                                  (uint64_t)result->question->options.seed + 307, &ignored);
    for (size_t k = 0; k < result->list->count && points; k++) {
        nh_current *f = nh_current_list_describe(result, &result->list->found[k]);
        if (f->series) continue;
        symbol[n] = nh_symbol_fresh(model->dag, f->name);
        phi[n] = f->phi;
        for (size_t i = 0; i < n && !f->doc; i++)
            if (*doc[i] && multiple(result, points, n, i, symbol, phi)) f->doc = doc[i];
        if (f->meaning[0] || f->symbol) continue;
        f->known = combination(result, points, n, symbol, phi);
        if (!f->known) f->known = product(result, points, n, symbol, phi);
    }
    nh_points_free(points);
}

const char *nh_dependence_on_found(nh_analysis *result, const char *name, nh_ex value)
{
    nh_ex symbol[most_currents + 1], phi[most_currents + 1];
    nh_points *points = points_for_relations(result);
    size_t n = independent_ones(result, result->list->count, symbol, phi);
    symbol[n] = nh_symbol_fresh(result->question->model->dag, nh_arena_printf(result->arena, "[%s]", name));
    phi[n] = value;
    const char *text = points ? combination(result, points, n, symbol, phi) : NULL;
    if (points && !text) text = product(result, points, n, symbol, phi);
    if (points && !text) text = relate(result, points, n + 1, symbol, phi);
    nh_points_free(points);
    return text;
}
