/* Functions for the components of infinitesimal generators (the levels: library.h).
 *
 *      column k = (function b_k of q, coordinate i_k):   the field b_k d/dq^(i_k)
 *
 *      for each coordinate j: factors of this level      1, sin q, cos q, q, .., those of the system in q_j alone
 *      for each component i: products of the factors of the coordinates on which it depends, by the jets
 *
 * Functions with a pole near the sample points are left out, because their columns would dominate the others. */
#include "reduction/library.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"

enum { most_factors = 24, covectors = 6 /* the level of fields with simple covectors */, polynomials = 7 };

typedef struct {
    size_t count;
    nh_ex e[most_factors];
} factors;

/* Adds a factor that is not there. */
static void put(factors *f, nh_ex e)
{
    for (size_t i = 0; i < f->count; i++)
        if (f->e[i] == e) return;
    if (f->count < most_factors) f->e[f->count++] = e;
}

/* Does e depend on coordinate j and on no other? */
static bool of_one(const nh_kinetic *k, nh_ex e, size_t j)
{
    for (size_t s = 0; s < k->m; s++)
        if (nh_depends(k->dag, e, k->q[s]) != (s == j)) return false;
    return true;
}

/* Those of the Lagrangian and of the constraints; the caller frees them. */
static nh_ex *functions_of_system(const nh_kinetic *k, size_t *count)
{
    nh_ex *out = NULL;
    NH_LIST(call);
    size_t capacity = 0, n = 0;
    for (size_t a = 0; a <= k->f; a++) {
        nh_ex of = a < k->f ? k->force[a] : k->model->system->lagrangian;
        size_t more = nh_functions_in(k->dag, of, &call);
        nh_grow(&out, &capacity, n + more + 1, sizeof *out);
        for (size_t i = 0; i < more; i++) out[n++] = call[i];
    }
    *count = n;
    return out;
}

/* Is the call e a sine, a cosine or a tangent? */
static bool circular(const nh_dag *d, nh_ex e)
{
    nh_function f = nh_function_of(d, e);
    return f == NH_SIN || f == NH_COS || f == NH_TAN;
}

static void put_circular(nh_dag *d, factors *f, nh_ex angle, int level)
{
    nh_ex s = nh_call(d, NH_SIN, angle), c = nh_call(d, NH_COS, angle), twice = nh_mul(d, nh_int(d, 2), angle);
    put(f, s);
    put(f, c);
    if (level == 2 || level == 4) {
        put(f, nh_div(d, nh_int(d, 1), s));
        put(f, nh_div(d, c, s));
        put(f, nh_div(d, nh_int(d, 1), c));
        put(f, nh_div(d, s, c));
    } else if (level == 3) {
        put(f, nh_mul(d, angle, s));
        put(f, nh_mul(d, angle, c));
    } else if (level >= 5) {
        put(f, nh_call(d, NH_SIN, twice));
        put(f, nh_call(d, NH_COS, twice));
    }
}

/* g, g' and g'/g (cosh, sinh, tanh), for covectors g g': Christoffel symbols are made of them; of an exponential also
   1/g and roots (logarithmic coordinates). */
static void put_with_slopes(const nh_kinetic *k, factors *f, nh_ex g, nh_ex q, bool for_covectors)
{
    nh_ex slope = nh_simplify(k->dag, nh_diff(k->dag, g, q));
    put(f, g);
    for (int half = -2; half <= 1 && nh_function_of(k->dag, g) == NH_EXP; half++)
        if (half) put(f, nh_call(k->dag, NH_EXP, nh_mul(k->dag, nh_ratio(k->dag, half, 2), nh_child(k->dag, g, 0))));
    put(f, slope);
    put(f, for_covectors ? nh_mul(k->dag, slope, g) : nh_div(k->dag, slope, g));
}

/* What sin and cos are for rotations: exp(q) and exp(-q) for the boosts of an indefinite metric, and the rates, and
 * half of them, of exponentials of the other coordinates. */
static void put_boosts(const nh_kinetic *k, factors *f, size_t n, const nh_ex *found, size_t j)
{
    nh_dag *d = k->dag;
    for (size_t i = 0; i <= n; i++)
        for (size_t s = 0; s < k->m; s++) {
            bool one = i == n && s == j; /* the rate 1 */
            nh_ex rate = nh_int(d, 1);
            if (i < n && s != j && nh_function_of(d, found[i]) == NH_EXP && of_one(k, found[i], s))
                one = !nh_depends(d, rate = nh_diff(d, nh_child(d, found[i], 0), k->q[s]), k->q[s]);
            for (int half = -2; half <= 2 && one; half++)
                if (half && (i < n || half % 2 == 0))
                    put(f, nh_call(d, NH_EXP, nh_mul(d, nh_ratio(d, half, 2), nh_mul(d, rate, k->q[j]))));
        }
}

/* Leaves out functions that come near a pole at the sample points: they would dominate the others. */
static void drop_wild(const nh_kinetic *k, factors *f)
{
    static const double tame = 30;
    double *value = nh_alloc_array(f->count * k->places, sizeof *value);
    size_t kept = 0;
    nh_kinetic_sample(k, f->count, f->e, k->places, value);
    for (size_t i = 0; i < f->count; i++) {
        double most = 0, mean = 0;
        for (size_t p = 0; p < k->places; p++) {
            double x = fabs(value[p * f->count + i]);
            most = x <= most ? most : x;
            mean += x / (double)k->places;
        }
        if (isfinite(most) && isfinite(mean) && most <= tame * mean) f->e[kept++] = f->e[i];
    }
    f->count = kept;
    nh_free(value);
}

static void factors_of(const nh_kinetic *k, size_t j, int level, factors *f)
{
    nh_dag *d = k->dag;
    size_t n;
    nh_ex *found = functions_of_system(k, &n);
    bool angle = k->angle[j], turned = angle;
    f->count = 0;
    for (size_t i = 0; i < n; i++) turned |= circular(d, found[i]) && nh_depends(d, nh_child(d, found[i], 0), k->q[j]);
    /* together with sines these are nearly dependent on a short interval */
    bool powers = !turned || level == 3 || level == 5;
    for (size_t i = 0; i < n && level == covectors; i++) powers &= !of_one(k, found[i], j);
    put(f, nh_int(d, 1));
    if (powers) put(f, k->q[j]);
    if (powers && level > 1 && !(angle && level < 5)) put(f, nh_powi(d, k->q[j], 2));
    if (turned || level == 4) put_circular(d, f, k->q[j], level);
    for (size_t i = 0; i < n; i++) {
        if (!of_one(k, found[i], j)) continue;
        if (circular(d, found[i])) put_circular(d, f, nh_child(d, found[i], 0), level);
        else if (level >= 5) put_with_slopes(k, f, found[i], k->q[j], level == covectors);
    }
    if (level >= 5 && !k->metric) put_boosts(k, f, n, found, j);
    drop_wild(k, f);
    nh_free(found);
}

/* Adds a column for one component. */
static void add(nh_library *l, const nh_kinetic *k, nh_ex e, size_t component)
{
    size_t was = l->capacity, same = l->capacity, also = l->capacity;
    nh_grow(&l->function, &was, l->count + 1, sizeof *l->function);
    nh_grow(&l->component, &same, l->count + 1, sizeof *l->component);
    nh_grow(&l->complexity, &also, l->count + 1, sizeof *l->complexity);
    l->capacity = was;
    l->function[l->count] = e;
    l->component[l->count] = component;
    l->complexity[l->count++] = nh_is_number(k->dag, e, 1) ? 0 : (double)nh_complexity(k->dag, e);
}

/* The coordinates on which a component depends, from the jets: B^i_j anywhere.  Scales of the metric make the entries
 * comparable.  A component with a slope is not zero, even if it is small relative to the length of the box: a rotation
 * of a short plane together with a rotor of great inertia. */
static bool *dependence(const nh_kinetic *k, const nh_jets *jets, bool *nonzero)
{
    static const double small = 1e-7;
    size_t m = k->m, size = m + m * m;
    bool *out = nh_alloc_array(m * m, sizeof *out);
    double *K = nh_alloc_array(m * m + m, sizeof *K), *scale = K + m * m;
    if (!jets)
        for (size_t i = 0; i < m * m; i++) out[i] = nonzero[i % m] = true;
    if (jets) nh_kinetic_values(k, m * m, k->K, jets->place, K);
    for (size_t i = 0; i < m; i++) {
        scale[i] = K[i * (m + 1)];
        for (size_t j = 0; j < m && !k->metric; j++) scale[i] = fmax(scale[i], fabs(K[i * m + j]));
    }
    double length = nh_kinetic_length(k, scale);
    for (size_t i = 0; i < m; i++) scale[i] = length / sqrt(scale[i]);
    for (size_t p = 0; jets && p < jets->places; p++)
        for (size_t c = 0; c < jets->dimension; c++) {
            const double *jet = jets->moved + (p * jets->dimension + c) * size;
            for (size_t i = 0; i < m; i++) {
                nonzero[i] |= fabs(jet[i]) > small * scale[i];
                for (size_t j = 0; j < m; j++) {
                    bool slope = fabs(jet[m + i + m * j]) * scale[j] > small * scale[i];
                    out[i + m * j] |= slope;
                    nonzero[i] |= slope;
                }
            }
        }
    nh_free(K);
    return out;
}

/* Products over the coordinates in `on`, at most `together` of them not constant. */
static void products(nh_library *l, const nh_kinetic *k, const factors *f, const bool *on, size_t j, nh_ex so_far,
                     size_t together, size_t component, size_t most)
{
    while (j < k->m && !on[j]) j++;
    if (l->count >= most) return;
    if (j == k->m) {
        add(l, k, so_far, component);
        return;
    }
    for (size_t i = 0; i < (together ? f[j].count : 1); i++)
        products(l, k, f, on, j + 1, nh_mul(k->dag, so_far, f[j].e[i]), together - (i > 0 && together), component,
                 most);
}

/* Monomials of total degree `degree` at most, of those in `on`. */
static void monomials(nh_library *l, const nh_kinetic *k, const bool *on, size_t j, nh_ex so_far, int degree,
                      size_t component, size_t most)
{
    while (j < k->m && !on[j]) j++;
    if (l->count >= most) return;
    if (j == k->m) {
        add(l, k, so_far, component);
        return;
    }
    for (int power = 0; power <= degree; power++)
        monomials(l, k, on, j + 1, nh_mul(k->dag, so_far, nh_powi(k->dag, k->q[j], power)), degree - power, component,
                  most);
}

/* The divisor of components at the level of covectors: K_ii where K is diagonal, else its determinant; 0 where that is
 * a number or unknown. */
static nh_ex divisor(const nh_kinetic *k, size_t i)
{
    nh_dag *d = k->dag;
    size_t m = k->m;
    bool diagonal = k->invertible;
    nh_ex e = 0;
    for (size_t r = 0; r < m; r++)
        for (size_t s = 0; s < r; s++) diagonal &= nh_is_zero(d, k->K[r * m + s]);
    if (diagonal) e = k->K[i * m + i];
    else if (k->invertible && m == 2) e = nh_sub(d, nh_mul(d, k->K[0], k->K[3]), nh_mul(d, k->K[1], k->K[2]));
    e = e ? nh_simplify_short(d, e, 0) : 0;
    for (size_t s = 0; s < m && e; s++)
        if (nh_depends(d, e, k->q[s])) return e;
    return 0;
}

/* Columns from `first` on: each function over `by`. */
static void divide(nh_library *l, const nh_kinetic *k, size_t first, nh_ex by)
{
    for (size_t j = first; j < l->count; j++) {
        l->function[j] = nh_div(k->dag, l->function[j], by);
        l->complexity[j] = (double)nh_complexity(k->dag, l->function[j]);
    }
}

void nh_library_init(nh_library *l, const nh_kinetic *k, const nh_jets *jets, int level, size_t together, size_t most)
{
    size_t m = k->m;
    *l = (nh_library){0};
    bool *nonzero = nh_alloc_array(m + m, sizeof *nonzero), *on = nonzero + m, *depends = dependence(k, jets, nonzero);
    factors *f = nh_alloc_array(m, sizeof *f);
    for (size_t j = 0; j < m; j++) factors_of(k, j, level, &f[j]);
    for (size_t i = 0; i < m; i++) {
        size_t count = 0, first = l->count;
        for (size_t j = 0; j < m; j++) count += on[j] = depends[i + m * j];
        if (nonzero[i] && level == polynomials) monomials(l, k, on, 0, nh_int(k->dag, 1), m <= 3 ? 5 : 3, i, most);
        else if (nonzero[i])
            products(l, k, f, on, 0, nh_int(k->dag, 1), jets && count < together ? count : together, i, most);
        nh_ex by = level == covectors && nonzero[i] ? divisor(k, i) : 0;
        if (by) divide(l, k, first, by);
        if (by) products(l, k, f, on, 0, nh_int(k->dag, 1), jets && count < together ? count : together, i, most);
    }
    nh_free(nonzero);
    nh_free(depends);
    nh_free(f);
}

static void swap(nh_library *l, size_t i, size_t j)
{
    nh_ex e = l->function[i];
    size_t c = l->component[i];
    double x = l->complexity[i];
    l->function[i] = l->function[j], l->function[j] = e;
    l->component[i] = l->component[j], l->component[j] = c;
    l->complexity[i] = l->complexity[j], l->complexity[j] = x;
}

void nh_library_for(nh_library *l, const nh_kinetic *k, size_t components, int level, size_t together, size_t most)
{
    size_t m = k->m;
    bool *on = nh_alloc_array(m, sizeof *on);
    factors *f = nh_alloc_array(m, sizeof *f);
    *l = (nh_library){0};
    for (size_t j = 0; j < m; j++) {
        factors_of(k, j, level, &f[j]);
        on[j] = true;
    }
    for (size_t a = 0; a < components; a++)
        products(l, k, f, on, 0, nh_int(k->dag, 1), together, a, (a + 1) * most / (components ? components : 1));
    for (size_t i = 1; i < l->count; i++) /* the simple ones first: of dependent columns the first ones stay */
        for (size_t j = i; j > 0 && l->complexity[j - 1] > l->complexity[j]; j--) swap(l, j - 1, j);
    nh_free(on);
    nh_free(f);
}

void nh_library_put_before(nh_library *l, const nh_kinetic *k, size_t count, const nh_ex *component)
{
    nh_library out = {0};
    const nh_ex **whole = nh_alloc_array(count + l->count + 1, sizeof *whole);
    for (size_t c = 0; c < count; c++) {
        add(&out, k, nh_int(k->dag, 0), 0);
        out.complexity[c] = 0;
        whole[c] = component + c * k->m;
        for (size_t i = 0; i < k->m; i++)
            if (!nh_is_number(k->dag, whole[c][i], 1) && !nh_is_zero(k->dag, whole[c][i]))
                out.complexity[c] += (double)nh_complexity(k->dag, whole[c][i]);
    }
    for (size_t j = 0; j < l->count; j++) {
        whole[out.count] = l->whole ? l->whole[j] : NULL;
        add(&out, k, l->function[j], l->component[j]);
        out.complexity[out.count - 1] = l->complexity[j];
    }
    nh_library_clear(l);
    *l = out;
    l->whole = whole;
}

nh_ex nh_library_component(const nh_library *l, nh_dag *d, size_t column, size_t i)
{
    if (l->whole && l->whole[column]) return l->whole[column][i];
    return i == l->component[column] ? l->function[column] : nh_int(d, 0);
}

void nh_library_pick(nh_library *out, const nh_library *l, size_t n, const size_t *index)
{
    *out = (nh_library){.count = n,
                        .capacity = n,
                        .function = nh_alloc_array(n + 1, sizeof *out->function),
                        .component = nh_alloc_array(n + 1, sizeof *out->component),
                        .complexity = nh_alloc_array(n + 1, sizeof *out->complexity)};
    if (l->whole) out->whole = nh_alloc_array(n + 1, sizeof *out->whole);
    for (size_t i = 0; i < n; i++) {
        if (l->whole) out->whole[i] = l->whole[index[i]];
        out->function[i] = l->function[index[i]];
        out->component[i] = l->component[index[i]];
        out->complexity[i] = l->complexity[index[i]];
    }
}

size_t *nh_library_order(const nh_library *l)
{
    size_t *order = nh_alloc_array(l->count + 1, sizeof *order);
    for (size_t i = 0; i < l->count; i++) {
        size_t j = i;
        for (; j > 0 && l->complexity[order[j - 1]] > l->complexity[i]; j--) order[j] = order[j - 1];
        order[j] = i;
    }
    return order;
}

void nh_library_clear(nh_library *l)
{
    nh_free(l->function);
    nh_free(l->component);
    nh_free(l->complexity);
    nh_free(l->whole);
    *l = (nh_library){0};
}
