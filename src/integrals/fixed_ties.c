#include "integrals/fixed_ties.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/num.h"

enum { most_fixed = 8, most_factors = 3, highest = 2, largest_ratio = 12, proposals = 400, most_monomials = 12 };

typedef struct {
    const nh_model *o;
    size_t n;
    const size_t *fixed;
    nh_num value[most_fixed];
    size_t count;
    const nh_ex **out;
} list;

static nh_ex symbol(const list *l, size_t k) { return l->o->parameter[l->fixed[k]]; }

static bool is_zero(nh_num x) { return nh_num_is(x, 0); }

/* All fixed parameters by their values, the others free. */
static nh_ex *by_values(const list *l)
{
    size_t all = l->o->system->parameters;
    nh_ex *e = nh_arena_alloc(l->o->arena, (all + 1) * sizeof *e);
    memcpy(e, l->o->parameter, all * sizeof *e);
    for (size_t k = 0; k < l->n; k++) e[l->fixed[k]] = nh_number(l->o->dag, l->value[k]);
    return e;
}

static void propose(list *l, const nh_ex *e)
{
    size_t all = l->o->system->parameters;
    for (size_t i = 0; i < l->count; i++)
        if (!memcmp(l->out[i], e, all * sizeof *e)) return;
    if (l->count < NH_MOST_TIES) l->out[l->count++] = e;
}

/* ---- the same value, the same multiple ---- */

/* The value of `only` and what has the same, or all such groups (`only` = n). */
static void tie_equal(list *l, size_t only)
{
    nh_ex *e = by_values(l);
    bool any = false;
    for (size_t k = 0; k < l->n; k++) {
        if (is_zero(l->value[k]) || (only < l->n && !nh_num_equal(l->value[k], l->value[only]))) continue;
        size_t first = 0;
        while (!nh_num_equal(l->value[first], l->value[k])) first++;
        if (first == k) continue;
        e[l->fixed[first]] = symbol(l, first);
        e[l->fixed[k]] = symbol(l, first);
        any = true;
    }
    if (any) propose(l, e);
}

static bool is_simple(nh_num r, int64_t most)
{
    return nh_num_short(r) && llabs((long long)r.p) <= most && r.q <= most && r.p != 0;
}

static void tie_multiples(list *l)
{
    nh_ex *e = by_values(l);
    size_t base = l->n, tied = 0;
    for (size_t k = 0; k < l->n; k++)
        if (!is_zero(l->value[k]) &&
            (base == l->n || fabs(nh_num_value(l->value[k])) < fabs(nh_num_value(l->value[base]))))
            base = k;
    for (size_t k = 0; k < l->n && base < l->n; k++) {
        nh_num ratio = nh_num_mul(l->value[k], nh_num_inv(l->value[base]));
        if (k == base || !is_simple(ratio, largest_ratio)) continue;
        e[l->fixed[k]] = nh_mul(l->o->dag, nh_number(l->o->dag, ratio), symbol(l, base));
        tied++;
    }
    if (tied == 0) return;
    e[l->fixed[base]] = symbol(l, base);
    propose(l, e);
}

/* ---- products of powers ---- */

typedef struct {
    int cost;
    const nh_ex *e;
} monomial;

/* Sorts the least first; equal ones keep their order. */
static void keep(monomial *best, size_t *count, int cost, const nh_ex *e)
{
    size_t at = *count;
    while (at > 0 && best[at - 1].cost > cost) at--;
    if (at == most_monomials) return;
    if (*count < most_monomials) (*count)++;
    for (size_t i = *count - 1; i > at; i--) best[i] = best[i - 1];
    best[at] = (monomial){cost, e};
}

/* p_i = r prod_j p_j^power_j, if r is simple. */
static void consider(const list *l, size_t i, const int *power, monomial *best, size_t *count)
{
    static const int for_negative = 2, for_ratio = 4;
    nh_dag *d = l->o->dag;
    nh_num ratio = l->value[i];
    nh_ex product = nh_int(d, 1), *e = by_values(l);
    int cost = 0, factors = 0;
    for (size_t j = 0; j < l->n; j++) {
        if (j == i || power[j] == 0) continue;
        if (is_zero(l->value[j])) return;
        ratio = nh_num_mul(ratio, nh_num_pow(l->value[j], -power[j]));
        product = nh_mul(d, product, nh_powi(d, symbol(l, j), power[j]));
        e[l->fixed[j]] = symbol(l, j);
        cost += abs(power[j]) + (power[j] < 0 ? for_negative : 0);
        factors++;
    }
    if (factors == 0 || factors > most_factors || !is_simple(ratio, 4)) return;
    e[l->fixed[i]] = nh_mul(d, nh_number(d, ratio), product);
    keep(best, count, cost + (nh_num_is(ratio, 1) ? 0 : for_ratio), e);
}

static void tie_monomials(list *l)
{
    monomial best[most_monomials];
    size_t count = 0, tried = 0;
    for (size_t i = 0; i < l->n && tried < proposals; i++) {
        int power[most_fixed];
        if (is_zero(l->value[i])) continue;
        for (size_t j = 0; j < l->n; j++) power[j] = -highest;
        power[i] = 0;
        for (size_t at = 0; at < l->n && tried < proposals; tried++) {
            consider(l, i, power, best, &count);
            for (at = 0; at < l->n; at++) { /* the next list of exponents */
                if (at == i) continue;
                if (++power[at] <= highest) break;
                power[at] = -highest;
            }
        }
    }
    for (size_t k = 0; k < count; k++) propose(l, best[k].e);
}

size_t nh_fixed_ties(const nh_model *o, size_t n, const size_t *fixed, const nh_ex *out[NH_MOST_TIES])
{
    list l = {.o = o, .n = n, .fixed = fixed, .out = out};
    if (n < 2 || n > most_fixed) return 0;
    for (size_t k = 0; k < n; k++) l.value[k] = nh_num_decimal(o->parameter_value[fixed[k]]);
    tie_equal(&l, n);
    for (size_t k = 0; k < n; k++) tie_equal(&l, k);
    tie_multiples(&l);
    if (n <= most_factors + 1) tie_monomials(&l);
    return l.count;
}
