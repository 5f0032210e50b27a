/* total_derivative: terms of L that are linear in the velocities, a_s v^s, and the terms of the potential; the former
 * are integrated, term by term:
 *
 *     F = int (a term of a_s) dq^s;   dF/dt = F_t + F_q v is taken away where every one of its terms is a term of L
 *
 * [docs/method.md, sec. 4] */
#include "integrals/total_derivative.h"

#include <string.h>

#include "base/memory.h"
#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/terms.h"

enum { longest = 3000, most_terms = 40 };

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t m;
    nh_ex *a, *rest; /* m coefficients of v^s and the terms without v, written out as sums; room for as many */
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

/* The number of terms of e, a constant included. */
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
    const nh_system *system = x->o->system;
    for (size_t s = 0; s <= x->m; s++) {
        nh_ex slope = canonical(x, nh_diff(x->d, F, s < x->m ? system->coordinate[s].q : system->t));
        x->rest[s] = canonical(x, nh_sub(x->d, x->a[s], slope));
        if (count_terms(x, x->rest[s]) + count_terms(x, slope) != count_terms(x, x->a[s])) return false;
    }
    for (size_t s = 0; s <= x->m; s++) x->a[s] = x->rest[s];
    return true;
}

/* Is it at most linear in all velocities? */
static bool is_linear(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    const nh_coordinate *coordinate = model->system->coordinate;
    bool linear = true;
    for (size_t i = 0; i < model->m && linear; i++) {
        nh_ex slope = nh_diff(d, e, coordinate[i].v);
        for (size_t j = 0; j < model->m && linear; j++) linear = !nh_depends(d, slope, coordinate[j].v);
    }
    return linear;
}

/* The terms of L, as it is written, that are at most linear in the velocities.  What squares add to these belongs to
 * the squares: without it momenta in moving coordinates are longer. */
static nh_ex linear_terms(const nh_model *model)
{
    nh_dag *d = model->dag;
    nh_ex *term, sum = nh_int(d, 0);
    size_t count = nh_terms_of(d, model->system->lagrangian, &term);
    for (size_t i = count > 1; i < count; i++) /* the first one is L itself */
        if (is_linear(model, term[i])) sum = nh_add(d, sum, term[i]);
    nh_free(term);
    return sum;
}

static int unknown_sign(void *context, nh_ex e)
{
    (void)context, (void)e;
    return 0;
}

/* Integrals of the terms of one coefficient; true where one was taken away. */
static bool integrate(parts *x, size_t s)
{
    const nh_system *system = x->o->system;
    nh_ex *term, *constant = nh_alloc_array(system->parameters + x->m + 1, sizeof *constant);
    size_t count = terms_of(x, x->a[s], &term), constants = system->parameters;
    bool found = false;
    memcpy(constant, x->o->parameter, constants * sizeof *constant);
    for (size_t r = 0; r <= x->m; r++)
        if (r != s) constant[constants++] = r < x->m ? system->coordinate[r].q : system->t;
    nh_integration along = {.dag = x->d,
                            .x = system->coordinate[s].q,
                            .constants = constants,
                            .constant = constant,
                            .max_terms = most_terms,
                            .sign = unknown_sign};
    for (size_t i = 0; i < count && count <= most_terms && !nh_is_zero(x->d, x->a[s]); i++) {
        nh_ex F;
        found |= nh_antiderivative(&along, term[i], &F) && take_away(x, F);
    }
    nh_free(constant);
    nh_free(term);
    return found;
}

nh_ex nh_total_derivative_removed(const nh_model *model)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    nh_ex L = system->lagrangian;
    if (!nh_complexity_within(d, L, longest)) return L;
    nh_ex from = linear_terms(model), *a = nh_alloc_array(4 * model->m + 2, sizeof *a), *rest = a + model->m + 1,
          *v = rest + model->m + 1, *zero = v + model->m;
    parts x = {.o = model, .d = d, .m = model->m, .a = a, .rest = rest};
    bool some = false, found = false;
    for (size_t s = 0; s < model->m; s++) {
        v[s] = system->coordinate[s].v;
        zero[s] = nh_int(d, 0);
        some |= nh_depends(d, from, v[s]);
    }
    for (size_t s = 0; s < model->m && some; s++) a[s] = canonical(&x, nh_diff(d, from, v[s]));
    nh_ex potential = nh_substitute(d, from, model->m, v, zero);
    if (some) a[model->m] = canonical(&x, potential);
    for (size_t s = 0; s < model->m && some; s++) found |= integrate(&x, s);
    if (found) {
        L = nh_add(d, nh_sub(d, L, from), canonical(&x, potential) == a[model->m] ? potential : a[model->m]);
        for (size_t s = 0; s < model->m; s++) L = nh_add(d, L, nh_mul(d, a[s], v[s]));
    }
    nh_free(a);
    return L;
}
