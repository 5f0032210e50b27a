#include "reduction/section.h"

#include <math.h>
#include <string.h>

#include "exact/normal.h"
#include "exact/relation_space.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/fixed.h"
#include "integrals/recognise.h"
#include "reduction/subspace.h"

nh_ex nh_section_marked(nh_dag *d, size_t n, const nh_ex *mark, const nh_ex *e)
{
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(d, sum, nh_mul(d, mark[i], e[i]));
    return sum;
}

void nh_section_marks(nh_dag *d, size_t n, nh_ex *mark)
{
    for (size_t i = 0; i < n; i++) mark[i] = nh_symbol_fresh(d, "mark");
}

size_t nh_section_pivot(size_t n, const double *v)
{
    size_t best = 0;
    for (size_t j = 0; j < n; j++) {
        if (v[j] == 1) return j;
        if (fabs(v[j]) > fabs(v[best])) best = j;
    }
    return best;
}

bool nh_section_negative(const nh_dag *d, nh_ex e)
{
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_SUM) return nh_num_value(nh_coefficient_of(d, e, 0)) < 0;
    return nh_num_value(kind == NH_NUMBER    ? nh_number_of(d, e)
                        : kind == NH_PRODUCT ? nh_constant_of(d, e)
                                             : nh_num_int(1)) < 0;
}

/* A simple number near this one. */
static nh_ex recognised(nh_dag *d, double value, const nh_options *options)
{
    nh_num x;
    nh_ex e;
    if (nh_recognise_ratio(value, 1000, options->same, &x)) return nh_number(d, x);
    if (nh_recognise_ratio(value, 100000, options->same / 1000, &x)) return nh_number(d, x); /* the proof decides */
    return nh_recognise_number(d, value, options->recognise, &e) ? e : nh_real(d, value);
}

static nh_proof by_numbers(const nh_kinetic *k, size_t n, const nh_ex *e, const double *v, const nh_options *options,
                           nh_ex *c)
{
    nh_dag *d = k->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t j = 0; j < n; j++) {
        c[j] = v[j] == 0 ? nh_int(d, 0) : recognised(d, v[j], options);
        sum = nh_add(d, sum, nh_mul(d, c[j], e[j]));
    }
    return nh_prove_zero(k->model, 1, &sum, true, options);
}

nh_proof nh_section_coefficients(const nh_kinetic *k, size_t n, const nh_ex *e, const double *v, size_t pivot,
                                 const nh_options *options, nh_ex *c)
{
    nh_dag *d = k->dag;
    size_t count = 0, at = 0, *index = nh_alloc_array(n + 1, sizeof *index);
    nh_ex *own = nh_alloc_array(2 * n + 1, sizeof *own), *found = own + n;
    double *like = nh_alloc_array(n + 1, sizeof *like);
    bool free = true; /* no condition restricts the coefficients: any values satisfy it */
    for (size_t j = 0; j < n; j++) {
        if (v[j] == 0) continue;
        if (j == pivot) at = count;
        own[count] = e[j];
        like[count] = v[j];
        index[count++] = j;
        free &= nh_is_zero(d, e[j]);
    }
    nh_proof proof = {0};
    nh_fixed how = nh_fixed_relation(k->model, count, own, like, options, found);
    bool good = how.found && !how.too_large && !nh_is_zero(d, found[at]);
    for (size_t j = 0; j < n && good; j++) c[j] = nh_int(d, 0);
    for (size_t j = 0; j < count && good; j++) c[index[j]] = nh_simplify(d, nh_div(d, found[j], found[at]));
    if (good) proof = (nh_proof){.proved = true, .all_parameters = how.all_parameters, .fixed = how.fixed};
    else proof = by_numbers(k, n, e, v, options, c);
    if (free) proof = (nh_proof){.proved = true, .all_parameters = true};
    nh_free(like);
    nh_free(own);
    nh_free(index);
    return proof;
}

/* ---- all of them ---- */

nh_ex *nh_section_relations(const nh_kinetic *k, size_t columns, size_t rows, const nh_ex *entry,
                            const nh_options *options, size_t *count)
{
    const nh_model *model = k->model;
    const nh_chart *chart = model->chart;
    nh_ex *e = nh_alloc_array(columns * rows + 2 * k->m + chart->n + 1, sizeof *e), *variable = e + columns * rows,
          *found = NULL;
    size_t variables = 2 * k->m;
    memcpy(variable, k->q, k->m * sizeof *e);
    memcpy(variable + k->m, k->v, k->m * sizeof *e);
    for (size_t i = 0; i < chart->n && chart->quasi; i++) variable[variables++] = chart->w[i];
    if (!k->autonomous) variable[variables++] = model->system->t;
    nh_relation_columns q = {
        k->dag, columns, rows, e, variables, variable, 0, model->parameter, (size_t)options->proof_terms};
    for (size_t i = 0; i < columns * rows; i++) e[i] = nh_model_values(model, entry[i]);
    nh_relation_space *all = columns && rows ? nh_relation_space_of(k->arena, &q) : NULL;
    *count = all && !all->obstacle ? all->proved : 0;
    if (all && !all->obstacle && all->proved == all->bound) found = all->coefficient;
    if (found && *count && model->system->parameters) { /* with parameters, where as many hold for all values */
        q.entry = entry;
        q.parameters = model->system->parameters;
        nh_relation_space *free = nh_relation_space_of(k->arena, &q);
        if (!free->obstacle && free->proved == *count) found = free->coefficient;
    }
    nh_free(e);
    return found;
}

bool nh_section_combinations(const nh_kinetic *k, size_t columns, size_t rows, const nh_ex *entry,
                             const nh_options *options, double *c, size_t *count)
{
    static const double rounding = 1e-14;
    const nh_ex *exact = nh_section_relations(k, columns, rows, entry, options, count);
    for (size_t i = 0; exact && i < *count * columns; i++) c[i] = nh_model_number(k->model, exact[i]);
    if (exact) nh_column_echelon(columns, *count, rounding, c);
    return exact != NULL;
}
