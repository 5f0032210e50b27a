/* L is split into its kinetic, its linear part and its potential; terms of the linear part are integrated. */
#include "integrals/total_derivative.h"

#include <string.h>

#include "base/memory.h"
#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "graph/diff.h"
#include "graph/terms.h"

enum { largest_form = 2000, longest = 3000, most_terms = 40 };

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t m;
    nh_ex *a, *rest; /* m coefficients of v^s and the potential, written out as sums; room for as many */
} parts;

static nh_ex canonical(const parts *x, nh_ex e) { return nh_canonical_sum(x->d, e); }

/* The terms of a sum that is written out, a constant included; the caller frees *out. */
static size_t terms_of(const parts *x, nh_ex e, nh_ex **out)
{
    nh_ex *term, constant = nh_int(x->d, 0);
    size_t count = nh_terms_of(x->d, e, &term), n = 0;
    for (size_t i = 1; i < count; i++) constant = nh_add(x->d, constant, term[i]);
    constant = count > 1 ? canonical(x, nh_sub(x->d, e, constant)) : e;
    *out = nh_alloc_array(count + 1, sizeof **out);
    for (size_t i = 1; i < count; i++) (*out)[n++] = term[i];
    if (!nh_is_zero(x->d, constant)) (*out)[n++] = constant;
    nh_free(term);
    return n;
}

static size_t count_terms(const parts *x, nh_ex e)
{
    nh_ex *term;
    size_t count = terms_of(x, e, &term);
    nh_free(term);
    return count;
}

/* Takes dF/dt away where nothing but terms of L disappears. */
static bool take_away(parts *x, nh_ex F)
{
    const nh_system *y = x->o->system;
    for (size_t s = 0; s <= x->m; s++) {
        nh_ex slope = canonical(x, nh_diff(x->d, F, s < x->m ? y->coordinate[s].q : y->t));
        x->rest[s] = canonical(x, nh_sub(x->d, x->a[s], slope));
        if (count_terms(x, x->rest[s]) + count_terms(x, slope) != count_terms(x, x->a[s])) return false;
    }
    for (size_t s = 0; s <= x->m; s++) x->a[s] = x->rest[s];
    return true;
}

static nh_ex kinetic(const nh_model *o, const nh_ex *v, const nh_ex *zero)
{
    nh_dag *d = o->dag;
    nh_ex T = nh_int(d, 0);
    for (size_t i = 0; i < o->m; i++)
        for (size_t j = i; j < o->m; j++) {
            nh_ex M = nh_diff(d, nh_diff(d, o->system->lagrangian, v[i]), v[j]);
            M = nh_substitute(d, M, o->m, v, zero);
            T = nh_add(d, T, nh_product(d, 4, (nh_ex[]){i == j ? nh_ratio(d, 1, 2) : nh_int(d, 1), M, v[i], v[j]}));
        }
    return T;
}

static int unknown_sign(void *context, nh_ex e)
{
    (void)context, (void)e;
    return 0;
}

/* Integrals of the terms of one coefficient; true where one was taken away. */
static bool integrate(parts *x, size_t s)
{
    const nh_system *y = x->o->system;
    nh_ex *term, *constant = nh_alloc_array(y->parameters + x->m + 1, sizeof *constant);
    size_t count = terms_of(x, x->a[s], &term), constants = y->parameters;
    bool found = false;
    memcpy(constant, x->o->parameter, constants * sizeof *constant);
    for (size_t r = 0; r <= x->m; r++)
        if (r != s) constant[constants++] = r < x->m ? y->coordinate[r].q : y->t;
    nh_integration along = {.dag = x->d, .x = y->coordinate[s].q, .constants = constants, .constant = constant,
                            .max_terms = most_terms, .sign = unknown_sign};
    for (size_t i = 0; i < count && count <= most_terms && !nh_is_zero(x->d, x->a[s]); i++) {
        nh_ex F;
        found |= nh_antiderivative(&along, term[i], &F) && take_away(x, F);
    }
    nh_free(constant);
    nh_free(term);
    return found;
}

nh_ex nh_total_derivative_removed(const nh_model *o)
{
    nh_dag *d = o->dag;
    nh_ex L = o->system->lagrangian, *a = nh_alloc_array(5 * o->m + 2, sizeof *a), *rest = a + o->m + 1;
    nh_ex *v = rest + o->m + 1, *zero = v + o->m, *linear = zero + o->m, out = L;
    parts x = {.o = o, .d = d, .m = o->m, .a = a, .rest = rest};
    bool some = false, found = false;
    for (size_t s = 0; s < o->m; s++) v[s] = o->system->coordinate[s].v, zero[s] = nh_int(d, 0);
    for (size_t s = 0; s < o->m && nh_complexity_within(d, L, longest); s++) {
        linear[s] = nh_substitute(d, nh_diff(d, L, v[s]), o->m, v, zero);
        some |= !nh_is_zero(d, linear[s]);
    }
    if (!some) {
        nh_free(a);
        return L;
    }
    nh_ex potential = nh_substitute(d, L, o->m, v, zero);
    for (size_t s = 0; s < o->m; s++) a[s] = canonical(&x, linear[s]);
    a[o->m] = canonical(&x, potential);
    for (size_t s = 0; s < o->m; s++) found |= integrate(&x, s);
    if (found) {
        nh_ex T = kinetic(o, v, zero), all = nh_add(d, T, potential);
        for (size_t s = 0; s < o->m; s++) all = nh_add(d, all, nh_mul(d, linear[s], v[s]));
        if (nh_normal_is_zero(d, nh_sub(d, L, all), largest_form) == NH_ZERO) {
            out = nh_add(d, T, nh_canonical_sum(d, potential) == a[o->m] ? potential : a[o->m]);
            for (size_t s = 0; s < o->m; s++) out = nh_add(d, out, nh_mul(d, a[s], v[s]));
        }
    }
    nh_free(a);
    return out;
}
