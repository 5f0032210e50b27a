#include "reduction/section.h"

#include <math.h>

#include "exact/normal.h"
#include "integrals/fixed.h"
#include "integrals/recognise.h"

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
