/* Numbers x for which e_1 .. e_n are related, from doubles to expressions of the parameters (relation_unknown.h):
 *
 *    1. the values of all constant generators at the point, in doubles
 *    2. the rows a_i(p, x) of the relation; all must vanish at the point up to rounding
 *    3. n - 1 of them that are independent at the point, by elimination in doubles, sparse ones first
 *    4. c(p, x): their null vector, exact
 *    5. R_i(p, x) = sum_j a_ij c_j of the rows that were not chosen
 *    6. x_k: the common zero of the R_i that lies at the point (common_zero.h) */
#include "exact/relation_unknown.h"

#include <math.h>
#include <string.h>

#include "exact/common_zero.h"
#include "exact/normal_quotient_internal.h"
#include "exact/relation_internal.h"
#include "exact/relation_rows.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_columns = 40, most_equations = 8 };
/* bounds for the remainder of a row, and of the relation at the point */
static const double independent = 1e-5, related = 1e-6;

typedef struct {
    const nh_unknown_numbers *numbers;
    nh_relation_question question;
    nh_relation_system system;
    nh_relation_rows rows;
    double *value; /* values of the generators at the point */
    const double *c;
    size_t n;
} problem;

/* ---- the point ---- */

/* The values of the constant kernels at the point; the others, and spare ones, are zero and do not occur. */
static void values_of_kernels(problem *p)
{
    const nh_unknown_numbers *s = p->numbers;
    const nh_kernels *k = &p->question.form.kernels;
    size_t all = s->parameters + s->unknowns, generators = (size_t)p->system.field->generators;
    nh_ex *kernel = nh_alloc_array(k->count + 1, sizeof *kernel);
    for (size_t g = 0; g < k->count; g++)
        kernel[g] = p->system.constant[g] ? nh_kernel_power(k, g, 1) : nh_int(s->dag, 0);
    p->value = nh_alloc_array(generators + k->count + 1, sizeof *p->value);
    nh_ex *symbol = nh_alloc_array(all + 1, sizeof *symbol);
    double *value = nh_alloc_array(all + 1, sizeof *value);
    memcpy(symbol, s->parameter, s->parameters * sizeof *symbol);
    memcpy(symbol + s->parameters, s->unknown, s->unknowns * sizeof *symbol);
    memcpy(value, s->parameter_value, s->parameters * sizeof *value);
    memcpy(value + s->parameters, s->value, s->unknowns * sizeof *value);
    nh_tape_constants(s->dag, k->count, kernel, all, symbol, value, p->value);
    nh_free(symbol);
    nh_free(value);
    nh_free(kernel);
}

/* The constant part of a term in doubles. */
static double term_value(const problem *p, const nh_relation_term *t)
{
    nh_quotient_field *f = p->system.field;
    const fmpz_mpoly_struct *poly = p->system.value[t->column]->num;
    fmpz_t c;
    fmpz_init(c);
    fmpz_mpoly_get_term_exp_ui(f->exponent, poly, t->index, f->ctx);
    fmpz_mpoly_get_term_coeff_fmpz(c, poly, t->index, f->ctx);
    double v = fmpz_get_d(c);
    for (slong g = 0; g < f->generators; g++)
        if (p->system.constant[g] && f->exponent[g]) v *= pow(p->value[g], (double)f->exponent[g]);
    fmpz_clear(c);
    return v;
}

/* a_ij c_j, relative to the terms that they are sums of; returns their sum, which vanishes where there is a
 * relation. */
static double row_at_point(const problem *p, size_t i, double *v)
{
    const nh_relation_row *row = &p->rows.row[i];
    double size = 0, sum = 0;
    memset(v, 0, p->n * sizeof *v);
    for (size_t t = row->first; t < row->last; t++) {
        double term = term_value(p, &p->rows.term[t]) * p->c[p->rows.term[t].column];
        v[p->rows.term[t].column] += term;
        size += fabs(term);
    }
    for (size_t j = 0; j < p->n && size > 0; j++) sum += v[j] /= size;
    return sum;
}

/* ---- independent rows ---- */

/* Eliminates v by the rows in `reduced`, each with 1 at its pivot; if something remains, it becomes the next of
 * them. */
static bool insert(size_t n, double *reduced, size_t *pivot, size_t rank, double *v)
{
    size_t best = 0;
    for (size_t i = 0; i < rank; i++) {
        double factor = v[pivot[i]];
        for (size_t j = 0; j < n; j++) v[j] -= factor * reduced[i * n + j];
    }
    for (size_t j = 1; j < n; j++)
        if (fabs(v[j]) > fabs(v[best])) best = j;
    if (!(fabs(v[best]) > independent)) return false;
    for (size_t j = 0; j < n; j++) reduced[rank * n + j] = v[j] / v[best];
    pivot[rank] = best;
    return true;
}

/* Chooses n - 1 rows that are independent at the point, sparse ones first; the relation must hold in all rows. */
static bool choose_rows(problem *p, size_t *chosen)
{
    size_t n = p->n, rank = 0;
    double *reduced = nh_alloc_array((n + 1) * n, sizeof *reduced), *v = reduced + n * n;
    size_t *pivot = nh_alloc_array(n + 1, sizeof *pivot);
    bool good = true;
    for (size_t i = 0; i < p->rows.rows && good; i++) {
        good = fabs(row_at_point(p, i, v)) <= related;
        if (good && rank < n && insert(n, reduced, pivot, rank, v)) chosen[rank++] = i;
    }
    nh_free(reduced);
    nh_free(pivot);
    return good && rank == n - 1;
}

/* ---- equations for the unknowns ---- */

static bool is_chosen(const problem *p, const size_t *chosen, size_t row)
{
    for (size_t i = 0; i + 1 < p->n; i++)
        if (chosen[i] == row) return true;
    return false;
}

/* R_i = sum_j a_ij c_j of the rows that are not chosen. */
static size_t equations(problem *p, const size_t *chosen, const nh_quotient **c, const nh_quotient **out)
{
    nh_quotient_field *f = p->system.field;
    size_t count = 0;
    for (size_t i = 0; i < p->rows.rows && count < most_equations; i++) {
        if (is_chosen(p, chosen, i)) continue;
        const nh_quotient *sum = nh_quotient_number(f, nh_num_int(0));
        for (size_t j = 0; j < p->n; j++) {
            const nh_quotient *a = nh_relation_rows_entry(&p->rows, i, j);
            if (a && c[j]) sum = nh_quotient_add(f, sum, nh_quotient_mul(f, a, c[j]));
        }
        if (nh_quotient_field_state_of(f) != NH_FIELD_FINE) return 0;
        if (!nh_quotient_is_zero(f, sum)) out[count++] = sum;
    }
    return count;
}

/* ---- solutions as expressions ---- */

/* prod_i root_i^(power_i/2), as an expression. */
static bool root_product(problem *p, const nh_zero_root *root, nh_ex *out)
{
    nh_dag *d = p->numbers->dag;
    nh_ex e, product = nh_int(d, 1), under_one = product;
    /* sums under one root, or each under its own; symbols under their own, as in monomials */
    bool joint = !nh_quotient_is_zero(p->system.field, root->rational);
    for (size_t i = 0; i < root->roots; i++) {
        if (!nh_relation_question_emit(&p->question, root->root[i], &e)) return false;
        if (joint && nh_kind_of(d, e) != NH_SYMBOL) under_one = nh_mul(d, under_one, e);
        else product = nh_mul(d, product, nh_pow(d, e, nh_ratio(d, joint ? 1 : root->power[i], 2)));
    }
    *out = nh_mul(d, product, nh_sqrt(d, under_one));
    return true;
}

/* (rational + factor prod_i root_i^(1/2))^(1/outer), as an expression. */
static bool emit(problem *p, const nh_zero_root *root, nh_ex *out)
{
    nh_dag *d = p->numbers->dag;
    nh_ex factor, product;
    if (!nh_relation_question_emit(&p->question, root->rational, out)) return false;
    if (root->factor) {
        if (!nh_relation_question_emit(&p->question, root->factor, &factor) || !root_product(p, root, &product))
            return false;
        *out = nh_add(d, *out, nh_mul(d, factor, product));
    }
    if (root->outer == 2) *out = nh_sqrt(d, *out);
    return true;
}

/* ---- the whole ---- */

/* x[k] for each unknown, whose generator is a plain kernel. */
static bool solve_for(problem *p, size_t count, const nh_quotient *const *equation, nh_ex *x)
{
    size_t generator[NH_MOST_UNKNOWN];
    const nh_unknown_numbers *s = p->numbers;
    for (size_t k = 0; k < s->unknowns; k++) {
        const nh_kernels *kernels = &p->question.form.kernels;
        generator[k] = 0;
        while (generator[k] < kernels->count && !(kernels->item[generator[k]].kind == NH_KERNEL_PLAIN &&
                                                  kernels->item[generator[k]].atom == s->unknown[k]))
            generator[k]++;
        if (generator[k] == kernels->count) return false;
    }
    nh_zero_point point = {p->system.field, p->value, s->unknowns, generator};
    for (size_t k = 0; k < s->unknowns; k++) {
        nh_zero_root root;
        if (!nh_common_zero(&point, count, equation, k, &root) || !emit(p, &root, &x[k])) return false;
    }
    return true;
}

static bool ask(problem *p, nh_ex *x)
{
    const nh_quotient *equation[most_equations], *c[most_columns];
    size_t chosen[most_columns + 1], count = 0;
    bool support[most_columns];
    memset(support, 1, sizeof support);
    nh_relation_rows_init(&p->rows, &p->system);
    if (nh_relation_rows_choose_point(&p->rows) && nh_relation_rows_rank(&p->rows, support, chosen) == p->n &&
        choose_rows(p, chosen) && nh_relation_solve_rows(&p->rows, chosen, c))
        count = equations(p, chosen, c, equation);
    bool good = count > 0 && solve_for(p, count, equation, x);
    nh_relation_rows_clear(&p->rows);
    return good;
}

bool nh_relation_unknown(const nh_unknown_numbers *s, size_t n, const nh_ex *e, const double *c, nh_ex *x)
{
    if (n == 0 || n > most_columns || s->unknowns == 0 || s->unknowns > NH_MOST_UNKNOWN) return false;
    size_t all = s->parameters + s->unknowns;
    nh_ex *constant = nh_alloc_array(all, sizeof *constant);
    memcpy(constant, s->parameter, s->parameters * sizeof *constant);
    memcpy(constant + s->parameters, s->unknown, s->unknowns * sizeof *constant);
    problem p = {.numbers = s, .c = c, .n = n};
    nh_relation_question_init(&p.question, s->dag, n, all, constant, s->max_terms);
    bool good = nh_relation_question_read(&p.question, e);
    if (good) {
        p.system = nh_relation_question_system(&p.question);
        values_of_kernels(&p);
        good = ask(&p, x);
    }
    nh_free(p.value);
    nh_relation_question_clear(&p.question);
    nh_free(constant);
    return good;
}
