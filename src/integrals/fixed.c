#include "integrals/fixed.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "exact/relation.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "integrals/fixed_ties.h"

static const double same = 1e-6;

/* ---- values ---- */

bool nh_fixed_has(const nh_model *o, const nh_ex *fixed, size_t i) { return fixed && fixed[i] != o->parameter[i]; }

static nh_ex value_of(const nh_model *o, size_t i) { return nh_number(o->dag, nh_num_decimal(o->parameter_value[i])); }

nh_ex nh_fixed_values(const nh_model *o, const nh_ex *fixed, nh_ex e)
{
    size_t n = 0, all = o->system->parameters;
    nh_ex *from = nh_alloc_array(2 * all + 1, sizeof *from), *to = from + all;
    for (size_t i = 0; i < all; i++) {
        if (fixed && !nh_fixed_has(o, fixed, i)) continue;
        from[n] = o->parameter[i];
        to[n++] = fixed ? fixed[i] : value_of(o, i);
    }
    if (n) e = nh_substitute(o->dag, e, n, from, to);
    nh_free(from);
    return e;
}

static nh_ex *none_fixed(const nh_model *o)
{
    size_t all = o->system->parameters;
    nh_ex *fixed = nh_arena_alloc(o->arena, (all + 1) * sizeof *fixed);
    memcpy(fixed, o->parameter, all * sizeof *fixed);
    return fixed;
}

const nh_ex *nh_fixed_every(const nh_model *o)
{
    nh_ex *fixed = none_fixed(o);
    for (size_t i = 0; i < o->system->parameters; i++) fixed[i] = value_of(o, i);
    return fixed;
}

const nh_ex *nh_fixed_those(const nh_model *o, const bool *which)
{
    nh_ex *fixed = none_fixed(o);
    for (size_t i = 0; i < o->system->parameters; i++)
        if (which[i]) fixed[i] = value_of(o, i);
    return fixed;
}

bool nh_fixed_all(const nh_model *o, const nh_ex *fixed)
{
    for (size_t i = 0; i < o->system->parameters && fixed; i++)
        if (nh_kind_of(o->dag, fixed[i]) != NH_NUMBER) return false;
    return true;
}

const char *nh_fixed_text(const nh_model *o, const nh_ex *fixed)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < o->system->parameters; i++) {
        if (!nh_fixed_has(o, fixed, i)) continue;
        nh_text_addf(&text, "%s%s = ", nh_text_string(&text)[0] ? ", " : "", o->system->parameter[i].name);
        char *related = nh_kind_of(o->dag, fixed[i]) == NH_NUMBER ? NULL : nh_print_string(o->dag, fixed[i]);
        if (related) nh_text_addf(&text, "%s", related);
        else nh_text_addf(&text, "%.15g", o->parameter_value[i]);
        nh_free(related);
    }
    const char *out = nh_arena_strdup(o->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* ---- one relation ---- */

bool nh_fixed_is_like(const nh_model *o, size_t n, const nh_ex *exact, const double *like)
{
    double *value = nh_alloc_array(n + 1, sizeof *value), largest = 0, factor = 0, worst = 0;
    nh_tape_constants(o->dag, n, exact, o->system->parameters, o->parameter, o->parameter_value, value);
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
static double special(const nh_system *s, size_t i)
{
    nh_num x = nh_num_decimal(s->parameter[i].value);
    double length = nh_num_short(x) ? log(1 + fabs((double)x.p)) + log((double)x.q) : 100;
    return (s->parameter[i].set ? 1000 : 0) - length;
}

static void set_order(const nh_system *s, size_t *order)
{
    for (size_t i = 0; i < s->parameters; i++) {
        size_t at = i;
        for (; at > 0 && special(s, order[at - 1]) > special(s, i); at--) order[at] = order[at - 1];
        order[at] = i;
    }
}

static bool occurs(const nh_model *o, size_t n, const nh_ex *e, nh_ex symbol)
{
    for (size_t j = 0; j < n; j++)
        if (nh_depends(o->dag, e[j], symbol)) return true;
    return false;
}

/* Sets one fixed parameter free after the other. */
static void set_free(const nh_model *o, nh_ex *fixed, nh_fixed_test *holds, void *context)
{
    size_t all = o->system->parameters, *order = nh_alloc_array(all + 1, sizeof *order);
    set_order(o->system, order);
    for (size_t k = 0; k < all; k++) {
        size_t i = order[k];
        if (nh_kind_of(o->dag, fixed[i]) != NH_NUMBER) continue;
        nh_ex value = fixed[i];
        fixed[i] = o->parameter[i];
        if (!holds(fixed, context)) fixed[i] = value;
    }
    nh_free(order);
}

/* Several parameters that must be fixed may only have to be related. */
static void with_ties(const nh_model *o, nh_ex *fixed, nh_fixed_test *holds, void *context)
{
    size_t all = o->system->parameters, n = 0, *which = nh_alloc_array(all + 1, sizeof *which);
    const nh_ex *tie[NH_MOST_TIES];
    for (size_t i = 0; i < all; i++)
        if (nh_fixed_has(o, fixed, i)) which[n++] = i;
    size_t ties = nh_fixed_ties(o, n, which, tie);
    for (size_t k = 0; k < ties; k++) {
        if (!holds(tie[k], context)) continue;
        memcpy(fixed, tie[k], all * sizeof *fixed);
        set_free(o, fixed, holds, context);
        break;
    }
    nh_free(which);
}

static const nh_ex *least(const nh_model *o, size_t n, const nh_ex *occurring, bool ties, nh_fixed_test *holds,
                          void *context)
{
    nh_ex *fixed = none_fixed(o);
    for (size_t k = 0; k < o->system->parameters; k++)
        if (occurs(o, n, occurring, o->parameter[k])) fixed[k] = value_of(o, k);
    set_free(o, fixed, holds, context);
    if (ties) with_ties(o, fixed, holds, context);
    return fixed;
}

const nh_ex *nh_fixed_least(const nh_model *o, size_t n, const nh_ex *occurring, nh_fixed_test *holds, void *context)
{
    return least(o, n, occurring, true, holds, context);
}

/* Where the lists disagree, or a replacement contains a parameter that is replaced itself, the parameters concerned get
 * their values. */
const nh_ex *nh_fixed_both(const nh_model *o, const nh_ex *a, const nh_ex *b)
{
    if (!a || !b) return a ? a : b;
    size_t all = o->system->parameters;
    nh_ex *both = none_fixed(o);
    bool mixed = false;
    for (size_t i = 0; i < all; i++) {
        bool in_a = nh_fixed_has(o, a, i), in_b = nh_fixed_has(o, b, i);
        both[i] = in_a ? a[i] : b[i];
        mixed = mixed || (in_a && in_b && a[i] != b[i]);
    }
    for (size_t i = 0; i < all; i++)
        for (size_t j = 0; j < all; j++)
            mixed = mixed || (nh_fixed_has(o, both, j) && nh_fixed_has(o, both, i) &&
                              nh_depends(o->dag, both[i], o->parameter[j]));
    for (size_t i = 0; i < all && mixed; i++)
        for (size_t j = 0; j < all; j++)
            if (nh_fixed_has(o, a, j) || nh_fixed_has(o, b, j) || nh_depends(o->dag, a[i], o->parameter[j]) ||
                nh_depends(o->dag, b[i], o->parameter[j]))
                both[j] = nh_fixed_has(o, a, i) || nh_fixed_has(o, b, i) ? value_of(o, j) : both[j];
    return both;
}

static bool is_related(const nh_ex *fixed, void *context)
{
    problem *p = context;
    if (relation(p, fixed, p->trial) != NH_RELATION_UNIQUE) return false;
    memcpy(p->coefficient, p->trial, p->n * sizeof *p->trial);
    return true;
}

bool nh_fixed_relation_of_symbols(const nh_model *o, size_t n, const nh_ex *e, const double *like,
                                  const nh_options *options, nh_ex *coefficient)
{
    nh_ex *work = nh_alloc_array(2 * n + o->system->parameters + 1, sizeof *work);
    problem p = {o, n, (size_t)options->proof_terms, e, like, work, work + n, work + 2 * n, coefficient};
    bool found = relation(&p, NULL, coefficient) == NH_RELATION_UNIQUE;
    nh_free(work);
    return found;
}

static nh_fixed find(const nh_model *o, size_t n, const nh_ex *e, const double *like, const nh_options *options,
                     bool ties, nh_ex *coefficient)
{
    size_t all = o->system->parameters;
    nh_ex *work = nh_alloc_array(2 * n + all + 1, sizeof *work);
    problem p = {o, n, (size_t)options->proof_terms, e, like, work, work + n, work + 2 * n, coefficient};
    nh_fixed out = {0};
    nh_relation_verdict symbols = relation(&p, NULL, coefficient);
    out.found = out.all_parameters = symbols == NH_RELATION_UNIQUE;
    if (!out.found) {
        const nh_ex *fixed = nh_fixed_every(o);
        out.found = relation(&p, fixed, coefficient) == NH_RELATION_UNIQUE;
        out.too_large = symbols == NH_RELATION_TOO_LARGE;
        out.fixed = out.found && !out.too_large ? least(o, n, e, ties, is_related, &p) : fixed;
    }
    nh_free(work);
    return out;
}

nh_fixed nh_fixed_relation(const nh_model *o, size_t n, const nh_ex *e, const double *like, const nh_options *options,
                           nh_ex *coefficient)
{
    return find(o, n, e, like, options, true, coefficient);
}

nh_fixed nh_fixed_relation_by_values(const nh_model *o, size_t n, const nh_ex *e, const double *like,
                                     const nh_options *options, nh_ex *coefficient)
{
    return find(o, n, e, like, options, false, coefficient);
}
