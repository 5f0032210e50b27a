#include "integrals/fixed.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "exact/relation.h"

static const double same = 1e-6;

/* ---- values ---- */

nh_ex nh_fixed_values(const nh_model *o, const bool *fixed, nh_ex e)
{
    size_t n = 0, all = o->system->parameters;
    nh_ex *from = nh_alloc_array(2 * all + 1, sizeof *from), *to = from + all;
    for (size_t i = 0; i < all; i++) {
        if (fixed && !fixed[i]) continue;
        from[n] = o->parameter[i];
        to[n++] = nh_number(o->dag, nh_num_decimal(o->parameter_value[i]));
    }
    if (n) e = nh_substitute(o->dag, e, n, from, to);
    nh_free(from);
    return e;
}

const bool *nh_fixed_every(const nh_model *o)
{
    size_t all = o->system->parameters;
    bool *fixed = nh_arena_alloc(o->arena, (all + 1) * sizeof *fixed);
    memset(fixed, 1, all * sizeof *fixed);
    return fixed;
}

bool nh_fixed_all(const nh_model *o, const bool *fixed)
{
    for (size_t i = 0; i < o->system->parameters && fixed; i++)
        if (!fixed[i]) return false;
    return true;
}

const char *nh_fixed_text(const nh_model *o, const bool *fixed)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < o->system->parameters; i++)
        if (fixed[i])
            nh_text_addf(&text, "%s%s = %.15g", nh_text_string(&text)[0] ? ", " : "", o->system->parameter[i].name,
                         o->parameter_value[i]);
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

/* `fixed` NULL: none is. */
static nh_relation_verdict relation(const problem *p, const bool *fixed, nh_ex *out)
{
    const nh_model *o = p->o;
    size_t count = 0;
    for (size_t i = 0; i < o->system->parameters; i++)
        if (!fixed || !fixed[i]) p->free[count++] = o->parameter[i];
    for (size_t j = 0; j < p->n; j++) p->valued[j] = fixed ? nh_fixed_values(o, fixed, p->e[j]) : p->e[j];
    nh_relation_verdict verdict = nh_relation_find(o->dag, p->n, p->valued, count, p->free, p->limit, out);
    if (verdict == NH_RELATION_UNIQUE && p->like && !nh_fixed_is_like(o, p->n, out, p->like))
        verdict = NH_RELATION_NONE;
    return verdict;
}

/* ---- which parameters ---- */

/* How special a value looks: short ones are set free last, and what the user set after all others. */
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

const bool *nh_fixed_least(const nh_model *o, size_t n, const nh_ex *occurring, nh_fixed_test *holds, void *context)
{
    size_t all = o->system->parameters, *order = nh_alloc_array(all + 1, sizeof *order);
    bool *fixed = nh_arena_alloc(o->arena, (all + 1) * sizeof *fixed);
    set_order(o->system, order);
    for (size_t k = 0; k < all; k++) fixed[k] = occurs(o, n, occurring, o->parameter[k]);
    for (size_t k = 0; k < all; k++) {
        size_t i = order[k];
        if (!fixed[i]) continue;
        fixed[i] = false;
        fixed[i] = !holds(fixed, context);
    }
    nh_free(order);
    return fixed;
}

const bool *nh_fixed_both(const nh_model *o, const bool *a, const bool *b)
{
    if (!a || !b) return a ? a : b;
    bool *both = nh_arena_alloc(o->arena, (o->system->parameters + 1) * sizeof *both);
    for (size_t i = 0; i < o->system->parameters; i++) both[i] = a[i] || b[i];
    return both;
}

static bool is_related(const bool *fixed, void *context)
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

nh_fixed nh_fixed_relation(const nh_model *o, size_t n, const nh_ex *e, const double *like, const nh_options *options,
                           nh_ex *coefficient)
{
    size_t all = o->system->parameters;
    nh_ex *work = nh_alloc_array(2 * n + all + 1, sizeof *work);
    problem p = {o, n, (size_t)options->proof_terms, e, like, work, work + n, work + 2 * n, coefficient};
    nh_fixed out = {0};
    nh_relation_verdict symbols = relation(&p, NULL, coefficient);
    out.found = out.all_parameters = symbols == NH_RELATION_UNIQUE;
    if (!out.found) {
        const bool *fixed = nh_fixed_every(o);
        out.found = relation(&p, fixed, coefficient) == NH_RELATION_UNIQUE;
        out.too_large = symbols == NH_RELATION_TOO_LARGE;
        out.fixed = out.found && !out.too_large ? nh_fixed_least(o, n, e, is_related, &p) : fixed;
    }
    nh_free(work);
    return out;
}
