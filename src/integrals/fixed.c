#include "integrals/fixed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "exact/relation.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"

static const double same = 1e-6;

/* ---- values ---- */

bool nh_fixed_has(const nh_model *model, const nh_ex *fixed, size_t i)
{
    return fixed && fixed[i] != model->parameter[i];
}

static nh_ex value_of(const nh_model *model, size_t i)
{
    return nh_number(model->dag, nh_num_decimal(model->parameter_value[i]));
}

nh_ex nh_fixed_values(const nh_model *model, const nh_ex *fixed, nh_ex e)
{
    size_t n = 0, all = model->system->parameters;
    nh_ex *from = nh_alloc_array(2 * all + 1, sizeof *from), *to = from + all;
    for (size_t i = 0; i < all; i++) {
        if (fixed && !nh_fixed_has(model, fixed, i)) continue;
        from[n] = model->parameter[i];
        to[n++] = fixed ? fixed[i] : value_of(model, i);
    }
    if (n) e = nh_substitute(model->dag, e, n, from, to);
    nh_free(from);
    return e;
}

/* Every parameter replaced by itself. */
static nh_ex *none_fixed(const nh_model *model)
{
    size_t all = model->system->parameters;
    nh_ex *fixed = nh_arena_alloc(model->arena, (all + 1) * sizeof *fixed);
    memcpy(fixed, model->parameter, all * sizeof *fixed);
    return fixed;
}

const nh_ex *nh_fixed_every(const nh_model *model)
{
    nh_ex *fixed = none_fixed(model);
    for (size_t i = 0; i < model->system->parameters; i++) fixed[i] = value_of(model, i);
    return fixed;
}

const nh_ex *nh_fixed_those(const nh_model *model, const bool *which)
{
    nh_ex *fixed = none_fixed(model);
    for (size_t i = 0; i < model->system->parameters; i++)
        if (which[i]) fixed[i] = value_of(model, i);
    return fixed;
}

bool nh_fixed_all(const nh_model *model, const nh_ex *fixed)
{
    for (size_t i = 0; i < model->system->parameters && fixed; i++)
        if (nh_kind_of(model->dag, fixed[i]) != NH_NUMBER) return false;
    return true;
}

const char *nh_fixed_text(const nh_model *model, const nh_ex *fixed)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < model->system->parameters; i++) {
        if (!nh_fixed_has(model, fixed, i)) continue;
        nh_text_addf(&text, "%s%s = ", nh_text_string(&text)[0] ? ", " : "", model->system->parameter[i].name);
        char *related = nh_kind_of(model->dag, fixed[i]) == NH_NUMBER ? NULL : nh_print_string(model->dag, fixed[i]);
        if (related) nh_text_addf(&text, "%s", related);
        else nh_text_addf(&text, "%.15g", model->parameter_value[i]);
        nh_free(related);
    }
    const char *out = nh_arena_strdup(model->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* ---- relations among parameters that their given values satisfy ----
 *
 *     p_j = p_i,    p_j = r p_i,    p_i = r prod_j p_j^(e_j)
 *
 * What holds at given values of several parameters often holds wherever these are related so: two oscillators have a
 * further integral for k = m w^2, not only at k = 18, m = 2, w = 3.  A proof with p_i replaced decides. */

enum {
    most_ties = 24,
    most_fixed = 8,
    most_factors = 3,
    highest = 2,
    largest_ratio = 12,
    proposals = 400,
    most_monomials = 12
};

typedef struct {
    const nh_model *o;
    size_t n;
    const size_t *fixed;
    nh_num value[most_fixed];
    size_t count;
    const nh_ex **out;
} tie_list;

static nh_ex symbol_of(const tie_list *l, size_t k) { return l->o->parameter[l->fixed[k]]; }

static bool is_nought(nh_num x) { return nh_num_is(x, 0); }

/* All fixed parameters by their values, the others free. */
static nh_ex *by_values(const tie_list *l)
{
    size_t all = l->o->system->parameters;
    nh_ex *e = nh_arena_alloc(l->o->arena, (all + 1) * sizeof *e);
    memcpy(e, l->o->parameter, all * sizeof *e);
    for (size_t k = 0; k < l->n; k++) e[l->fixed[k]] = nh_number(l->o->dag, l->value[k]);
    return e;
}

/* Adds the list e, unless it is there. */
static void propose_tie(tie_list *l, const nh_ex *e)
{
    size_t all = l->o->system->parameters;
    for (size_t i = 0; i < l->count; i++)
        if (!memcmp(l->out[i], e, all * sizeof *e)) return;
    if (l->count < most_ties) l->out[l->count++] = e;
}

/* The value of `only` and what has the same, or all such groups (`only` = n). */
static void tie_equal(tie_list *l, size_t only)
{
    nh_ex *e = by_values(l);
    bool any = false;
    for (size_t k = 0; k < l->n; k++) {
        if (is_nought(l->value[k]) || (only < l->n && !nh_num_equal(l->value[k], l->value[only]))) continue;
        size_t first = 0;
        while (!nh_num_equal(l->value[first], l->value[k])) first++;
        if (first == k) continue;
        e[l->fixed[first]] = symbol_of(l, first);
        e[l->fixed[k]] = symbol_of(l, first);
        any = true;
    }
    if (any) propose_tie(l, e);
}

/* Is r a fraction with a numerator and denominator up to `most`, and not 0? */
static bool is_simple(nh_num r, int64_t most)
{
    return nh_num_short(r) && llabs((long long)r.p) <= most && r.q <= most && r.p != 0;
}

/* Simple multiples of the parameter with the smallest value. */
static void tie_multiples(tie_list *l)
{
    nh_ex *e = by_values(l);
    size_t base = l->n, tied = 0;
    for (size_t k = 0; k < l->n; k++)
        if (!is_nought(l->value[k]) &&
            (base == l->n || fabs(nh_num_value(l->value[k])) < fabs(nh_num_value(l->value[base]))))
            base = k;
    for (size_t k = 0; k < l->n && base < l->n; k++) {
        nh_num ratio = nh_num_mul(l->value[k], nh_num_inv(l->value[base]));
        if (k == base || !is_simple(ratio, largest_ratio)) continue;
        e[l->fixed[k]] = nh_mul(l->o->dag, nh_number(l->o->dag, ratio), symbol_of(l, base));
        tied++;
    }
    if (tied == 0) return;
    e[l->fixed[base]] = symbol_of(l, base);
    propose_tie(l, e);
}

typedef struct {
    int cost;
    const nh_ex *e;
} monomial;

/* Sorts the least first; equal ones keep their order. */
static void keep_monomial(monomial *best, size_t *count, int cost, const nh_ex *e)
{
    size_t at = *count;
    while (at > 0 && best[at - 1].cost > cost) at--;
    if (at == most_monomials) return;
    if (*count < most_monomials) (*count)++;
    for (size_t i = *count - 1; i > at; i--) best[i] = best[i - 1];
    best[at] = (monomial){cost, e};
}

/* p_i = r prod_j p_j^power_j, if r is simple. */
static void try_monomial(const tie_list *l, size_t i, const int *power, monomial *best, size_t *count)
{
    static const int for_negative = 2, for_ratio = 4;
    nh_dag *d = l->o->dag;
    nh_num ratio = l->value[i];
    nh_ex product = nh_int(d, 1), *e = by_values(l);
    int cost = 0, factors = 0;
    for (size_t j = 0; j < l->n; j++) {
        if (j == i || power[j] == 0) continue;
        if (is_nought(l->value[j])) return;
        ratio = nh_num_mul(ratio, nh_num_pow(l->value[j], -power[j]));
        product = nh_mul(d, product, nh_powi(d, symbol_of(l, j), power[j]));
        e[l->fixed[j]] = symbol_of(l, j);
        cost += abs(power[j]) + (power[j] < 0 ? for_negative : 0);
        factors++;
    }
    if (factors == 0 || factors > most_factors || !is_simple(ratio, 4)) return;
    e[l->fixed[i]] = nh_mul(d, nh_number(d, ratio), product);
    keep_monomial(best, count, cost + (nh_num_is(ratio, 1) ? 0 : for_ratio), e);
}

/* p_i = r times at most three powers of the others, with exponents up to 2 in size; the cheapest are proposed. */
static void tie_monomials(tie_list *l)
{
    monomial best[most_monomials];
    size_t count = 0, tried = 0;
    for (size_t i = 0; i < l->n && tried < proposals; i++) {
        int power[most_fixed];
        if (is_nought(l->value[i])) continue;
        for (size_t j = 0; j < l->n; j++) power[j] = -highest;
        power[i] = 0;
        for (size_t at = 0; at < l->n && tried < proposals; tried++) {
            try_monomial(l, i, power, best, &count);
            for (at = 0; at < l->n; at++) { /* the next list of exponents */
                if (at == i) continue;
                if (++power[at] <= highest) break;
                power[at] = -highest;
            }
        }
    }
    for (size_t k = 0; k < count; k++) propose_tie(l, best[k].e);
}

/* Each result is a list of what the parameters are replaced by, simple ones first; those of the n `fixed` ones that
 * occur in no relation have their values.  Returns how many there are. */
static size_t propose_ties(const nh_model *o, size_t n, const size_t *fixed, const nh_ex *out[most_ties])
{
    tie_list l = {.o = o, .n = n, .fixed = fixed, .out = out};
    if (n < 2 || n > most_fixed) return 0;
    for (size_t k = 0; k < n; k++) l.value[k] = nh_num_decimal(o->parameter_value[fixed[k]]);
    tie_equal(&l, n);
    for (size_t k = 0; k < n; k++) tie_equal(&l, k);
    tie_multiples(&l);
    if (n <= most_factors + 1) tie_monomials(&l);
    return l.count;
}

/* ---- one relation ---- */

bool nh_fixed_is_like(const nh_model *model, size_t n, const nh_ex *exact, const double *like)
{
    double *value = nh_alloc_array(n + 1, sizeof *value), largest = 0, factor = 0, worst = 0;
    nh_tape_constants(model->dag, n, exact, model->system->parameters, model->parameter, model->parameter_value, value);
    for (size_t j = 0; j < n; j++)
        if (fabs(like[j]) > largest) {
            largest = fabs(like[j]);
            factor = value[j] / like[j];
        }
    /* 0/0 for special values */
    for (size_t j = 0; j < n; j++)
        worst = isfinite(value[j]) ? fmax(worst, fabs(value[j] - factor * like[j])) : INFINITY;
    nh_free(value);
    return isfinite(factor) && factor != 0 && worst <= same * fabs(factor) * largest;
}

typedef struct {
    const nh_model *o;
    size_t n, limit;
    const nh_ex *e;
    const double *like;
    nh_ex *valued, *trial, *free; /* work: n, n, parameters */
    nh_ex *coefficient;
} problem;

/* `fixed` NULL: no parameter is fixed. */
static nh_relation_verdict relation(const problem *p, const nh_ex *fixed, nh_ex *out)
{
    const nh_model *o = p->o;
    size_t count = 0;
    for (size_t i = 0; i < o->system->parameters; i++)
        if (!nh_fixed_has(o, fixed, i)) p->free[count++] = o->parameter[i];
    for (size_t j = 0; j < p->n; j++) p->valued[j] = fixed ? nh_fixed_values(o, fixed, p->e[j]) : p->e[j];
    nh_relation_verdict verdict = nh_relation_find(o->dag, p->n, p->valued, count, p->free, p->limit, out);
    if (verdict == NH_RELATION_UNIQUE && p->like && !nh_fixed_is_like(o, p->n, out, p->like))
        verdict = NH_RELATION_NONE;
    return verdict;
}

/* ---- which parameters ---- */

/* How special a value is: short values are set free late, and values that the user set last. */
static double special(const nh_system *system, size_t i)
{
    nh_num x = nh_num_decimal(system->parameter[i].value);
    double length = nh_num_short(x) ? log(1 + fabs((double)x.p)) + log((double)x.q) : 100;
    return (system->parameter[i].set ? 1000 : 0) - length;
}

static void set_order(const nh_system *system, size_t *order)
{
    for (size_t i = 0; i < system->parameters; i++) {
        size_t at = i;
        for (; at > 0 && special(system, order[at - 1]) > special(system, i); at--) order[at] = order[at - 1];
        order[at] = i;
    }
}

static bool occurs(const nh_model *model, size_t n, const nh_ex *e, nh_ex symbol)
{
    for (size_t j = 0; j < n; j++)
        if (nh_depends(model->dag, e[j], symbol)) return true;
    return false;
}

/* Sets one fixed parameter free after the other. */
static void set_free(const nh_model *model, nh_ex *fixed, nh_fixed_test *holds, void *context)
{
    size_t all = model->system->parameters, *order = nh_alloc_array(all + 1, sizeof *order);
    set_order(model->system, order);
    for (size_t k = 0; k < all; k++) {
        size_t i = order[k];
        if (nh_kind_of(model->dag, fixed[i]) != NH_NUMBER) continue;
        nh_ex value = fixed[i];
        fixed[i] = model->parameter[i];
        if (!holds(fixed, context)) fixed[i] = value;
    }
    nh_free(order);
}

/* Several parameters that must be fixed may only have to be related. */
static void with_ties(const nh_model *model, nh_ex *fixed, nh_fixed_test *holds, void *context)
{
    size_t all = model->system->parameters, n = 0, *which = nh_alloc_array(all + 1, sizeof *which);
    const nh_ex *tie[most_ties];
    for (size_t i = 0; i < all; i++)
        if (nh_fixed_has(model, fixed, i)) which[n++] = i;
    size_t ties = propose_ties(model, n, which, tie);
    for (size_t k = 0; k < ties; k++) {
        if (!holds(tie[k], context)) continue;
        memcpy(fixed, tie[k], all * sizeof *fixed);
        set_free(model, fixed, holds, context);
        break;
    }
    nh_free(which);
}

static const nh_ex *least(const nh_model *model, size_t n, const nh_ex *occurring, bool ties, nh_fixed_test *holds,
                          void *context)
{
    nh_ex *fixed = none_fixed(model);
    for (size_t k = 0; k < model->system->parameters; k++)
        if (occurs(model, n, occurring, model->parameter[k])) fixed[k] = value_of(model, k);
    set_free(model, fixed, holds, context);
    if (ties) with_ties(model, fixed, holds, context);
    return fixed;
}

const nh_ex *nh_fixed_least(const nh_model *model, size_t n, const nh_ex *occurring, nh_fixed_test *holds,
                            void *context)
{
    return least(model, n, occurring, true, holds, context);
}

/* Where the lists disagree, or a replacement contains a parameter that is replaced itself, the parameters concerned get
 * their values. */
const nh_ex *nh_fixed_both(const nh_model *model, const nh_ex *a, const nh_ex *b)
{
    if (!a || !b) return a ? a : b;
    size_t all = model->system->parameters;
    nh_ex *both = none_fixed(model);
    bool mixed = false;
    for (size_t i = 0; i < all; i++) {
        bool in_a = nh_fixed_has(model, a, i), in_b = nh_fixed_has(model, b, i);
        both[i] = in_a ? a[i] : b[i];
        mixed = mixed || (in_a && in_b && a[i] != b[i]);
    }
    for (size_t i = 0; i < all; i++)
        for (size_t j = 0; j < all; j++)
            mixed = mixed || (nh_fixed_has(model, both, j) && nh_fixed_has(model, both, i) &&
                              nh_depends(model->dag, both[i], model->parameter[j]));
    for (size_t i = 0; i < all && mixed; i++)
        for (size_t j = 0; j < all; j++)
            if (nh_fixed_has(model, a, j) || nh_fixed_has(model, b, j) ||
                nh_depends(model->dag, a[i], model->parameter[j]) || nh_depends(model->dag, b[i], model->parameter[j]))
                both[j] = nh_fixed_has(model, a, i) || nh_fixed_has(model, b, i) ? value_of(model, j) : both[j];
    return both;
}

static bool is_related(const nh_ex *fixed, void *context)
{
    problem *p = context;
    if (relation(p, fixed, p->trial) != NH_RELATION_UNIQUE) return false;
    memcpy(p->coefficient, p->trial, p->n * sizeof *p->trial);
    return true;
}

bool nh_fixed_relation_of_symbols(const nh_model *model, size_t n, const nh_ex *e, const double *like,
                                  const nh_options *options, nh_ex *coefficient)
{
    nh_ex *work = nh_alloc_array(2 * n + model->system->parameters + 1, sizeof *work);
    problem p = {model, n, (size_t)options->proof_terms, e, like, work, work + n, work + 2 * n, coefficient};
    bool found = relation(&p, NULL, coefficient) == NH_RELATION_UNIQUE;
    nh_free(work);
    return found;
}

static nh_fixed find(const nh_model *model, size_t n, const nh_ex *e, const double *like, const nh_options *options,
                     bool ties, nh_ex *coefficient)
{
    size_t all = model->system->parameters;
    nh_ex *work = nh_alloc_array(2 * n + all + 1, sizeof *work);
    problem p = {model, n, (size_t)options->proof_terms, e, like, work, work + n, work + 2 * n, coefficient};
    nh_fixed out = {0};
    nh_relation_verdict symbols = relation(&p, NULL, coefficient);
    out.found = out.all_parameters = symbols == NH_RELATION_UNIQUE;
    if (!out.found) {
        const nh_ex *fixed = nh_fixed_every(model);
        out.found = relation(&p, fixed, coefficient) == NH_RELATION_UNIQUE;
        out.too_large = symbols == NH_RELATION_TOO_LARGE;
        out.fixed = out.found && !out.too_large ? least(model, n, e, ties, is_related, &p) : fixed;
    }
    nh_free(work);
    return out;
}

nh_fixed nh_fixed_relation(const nh_model *model, size_t n, const nh_ex *e, const double *like,
                           const nh_options *options, nh_ex *coefficient)
{
    return find(model, n, e, like, options, true, coefficient);
}

nh_fixed nh_fixed_relation_by_values(const nh_model *model, size_t n, const nh_ex *e, const double *like,
                                     const nh_options *options, nh_ex *coefficient)
{
    return find(model, n, e, like, options, false, coefficient);
}
