/* companion: c and z of one exact relation. [docs/method.md, (15c)]
 *
 *     find_functions           zeta = M^-1 Y(Phi) at the parameters' values; its terms w_a and numbers z_a
 *     identities               n + a functions, linear in fresh symbols y_0 .. y_n that keep the equations apart
 *     nh_fixed_relation        the relation among these functions, over the field of the parameters
 *     without_common_factor    c without the factor that all c_k share */
#include "integrals/companion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/normal.h"
#include "exact/relation.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/terms.h"

/* most terms of a field; largest complexity of a component before and after simplification */
enum { most_functions = 40, longest = 3000, widest = 120 };

/* The terms of the field's components: number z times w in component i. */
typedef struct {
    size_t count, component[most_functions];
    nh_ex w[most_functions];
    double z[most_functions];
} functions;

/* A term of component i, as number times function; false where it is a sum, or there are too many. */
static bool add_function(nh_dag *d, functions *f, size_t component, nh_ex term)
{
    nh_kind kind = nh_kind_of(d, term);
    if (kind == NH_SUM || f->count == most_functions) return false;
    nh_num c = kind == NH_PRODUCT ? nh_constant_of(d, term) : kind == NH_NUMBER ? nh_number_of(d, term) : nh_num_int(1);
    if (nh_num_is(c, 0)) return true;
    f->component[f->count] = component;
    f->z[f->count] = nh_num_value(c);
    f->w[f->count++] = nh_mul(d, nh_number(d, nh_num_inv(c)), term);
    return true;
}

/* The terms of M^-1 Y(Phi) with all parameters at their values; false where they are long. */
static bool find_functions(const nh_model *model, nh_ex phi, functions *f)
{
    nh_dag *d = model->dag;
    nh_ex *zeta = nh_alloc_array(2 * model->n + 1, sizeof *zeta), *right = zeta + model->n;
    for (size_t j = 0; j < model->n; j++) right[j] = nh_model_Y(model, j, phi);
    nh_lu_solve(model->M_lu, right, zeta);
    bool good = true;
    for (size_t i = 0; i < model->n && good; i++) {
        nh_ex *part, e = nh_simplify_short(d, nh_fixed_values(model, NULL, zeta[i]), longest);
        good = nh_complexity(d, e) <= widest;
        if (!good) break;
        size_t n = nh_terms_of(d, e, &part);
        for (size_t k = n > 1 ? 1 : 0; k < n && good; k++) good = add_function(d, f, i, part[k]);
        nh_free(part);
    }
    nh_free(zeta);
    return good;
}

/* y_0 X_0(b) + sum_j y_j Y_j(b) and y_0 A_i w - sum_j y_j M_ij w: one identity for all equations. */
static void identities(const nh_model *model, size_t n, const nh_ex *term, const functions *f, nh_ex *e)
{
    nh_dag *d = model->dag;
    nh_ex *y = nh_alloc_array(model->n + 1, sizeof *y);
    for (size_t j = 0; j <= model->n; j++) y[j] = nh_symbol_fresh(d, "y");
    for (size_t k = 0; k < n; k++) {
        e[k] = nh_mul(d, y[model->n], nh_model_X0(model, term[k]));
        for (size_t j = 0; j < model->n; j++) e[k] = nh_add(d, e[k], nh_mul(d, y[j], nh_model_Y(model, j, term[k])));
    }
    for (size_t a = 0; a < f->count; a++) {
        size_t i = f->component[a];
        nh_ex sum = nh_mul(d, y[model->n], model->A[i]);
        for (size_t j = 0; j < model->n; j++) sum = nh_sub(d, sum, nh_mul(d, y[j], model->M[i * model->n + j]));
        e[n + a] = nh_mul(d, f->w[a], sum);
    }
    nh_free(y);
}

/* The coefficients c without their common factor: the relation of -sum_k (c_k/c_p) y_k and the y_k. */
static void without_common_factor(const nh_model *model, size_t n, nh_ex *c, const nh_options *options)
{
    nh_dag *d = model->dag;
    size_t p = 0;
    while (p < n && nh_is_zero(d, c[p])) p++;
    if (p == n) return;
    nh_ex *e = nh_alloc_array(2 * n + 1, sizeof *e), *out = e + n, sum = nh_int(d, 0);
    for (size_t k = 0; k < n; k++) {
        e[k] = nh_symbol_fresh(d, "y");
        if (k != p) sum = nh_sub(d, sum, nh_mul(d, nh_div(d, c[k], c[p]), e[k]));
    }
    e[p] = n > 1 ? sum : nh_int(d, 0);
    size_t terms = (size_t)options->proof_terms, all = model->system->parameters;
    bool good = nh_relation_find(d, n, e, all, model->parameter, terms, out) == NH_RELATION_UNIQUE;
    if (good) memcpy(c, out, n * sizeof *c);
    nh_free(e);
}

nh_fixed nh_companion_relation(const nh_model *model, size_t n, const nh_ex *term, const nh_options *options,
                               nh_ex *coefficient)
{
    nh_dag *d = model->dag;
    nh_fixed found = {0};
    functions f = {0};
    nh_ex phi = nh_int(d, 0);
    double *like = nh_alloc_array(n + most_functions + 1, sizeof *like);
    nh_ex *e = nh_alloc_array(2 * (n + most_functions) + 1, sizeof *e), *c = e + n + most_functions;
    bool good = model->n > 0;
    for (size_t k = 0; k < n && good; k++) {
        good = nh_kind_of(d, coefficient[k]) == NH_NUMBER;
        if (!good) break;
        like[k] = nh_num_value(nh_number_of(d, coefficient[k]));
        phi = nh_add(d, phi, nh_mul(d, coefficient[k], nh_fixed_values(model, NULL, term[k])));
    }
    if (good && find_functions(model, phi, &f)) {
        identities(model, n, term, &f, e);
        memcpy(like + n, f.z, f.count * sizeof *like);
        found = nh_fixed_relation(model, n + f.count, e, like, options, c);
    }
    if (found.too_large) found = (nh_fixed){0};
    if (found.found) without_common_factor(model, n, c, options);
    if (found.found) memcpy(coefficient, c, n * sizeof *c);
    nh_free(e);
    nh_free(like);
    return found;
}

/* ---- at other values ---- */

/* Replaces each value by one of two digits; different values stay different. */
static void shorten(size_t n, const double *value, double *out)
{
    for (size_t i = 0; i < n; i++) {
        int place = value[i] == 0 ? 0 : (int)floor(log10(fabs(value[i]))) - 1;
        double digits = round(value[i] * pow(10, -place)), unit = pow(10, abs(place));
        for (size_t j = 0; j <= i; j++) {
            /* a quotient of whole numbers is the double nearest to the decimal */
            out[i] = place < 0 ? digits / unit : digits * unit;
            if (j == i || out[j] != out[i] || value[j] == value[i]) continue;
            digits++;
            j = SIZE_MAX; /* start again from the first parameter */
        }
    }
}

nh_fixed nh_companion_relation_nearby(const nh_model *model, size_t n, const nh_ex *term, const nh_ex *rate,
                                      const double *like, const nh_options *options, nh_ex *coefficient)
{
    size_t all = model->system->parameters;
    double *value = nh_alloc_array(all + 1, sizeof *value);
    nh_ex *c = nh_alloc_array(n + 1, sizeof *c);
    nh_model nearby = *model;
    shorten(all, model->parameter_value, value);
    nearby.parameter_value = value;
    nh_fixed found = nh_fixed_relation(&nearby, n, rate, NULL, options, c);
    if (found.found) found = nh_companion_relation(&nearby, n, term, options, c);
    if (!found.all_parameters || !nh_fixed_is_like(model, n, c, like)) found = (nh_fixed){0};
    if (found.found) memcpy(coefficient, c, n * sizeof *c);
    nh_free(c);
    nh_free(value);
    return found;
}
