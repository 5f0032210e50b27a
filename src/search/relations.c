/* Relations as text, with exact coefficients. */
#include "search/relations.h"

#include "base/progress.h"
#include "exact/normal.h"
#include "exact/relation.h"
#include "graph/dag.h"
#include "graph/print.h"

typedef struct {
    nh_analysis *r;
    size_t count;
    nh_ex *phi, *symbol;
} ring;

static void put(ring *x, const nh_current *f)
{
    if (!f->proof.proved || f->series) return;
    x->symbol[x->count] = nh_symbol_fresh(x->r->question->model->dag, f->name);
    x->phi[x->count++] = f->phi;
}

static nh_ex product(nh_dag *d, size_t n, const nh_ex *factor, const uint8_t *exponent)
{
    nh_ex e = nh_int(d, 1);
    for (size_t k = 0; k < n; k++) e = nh_mul(d, e, nh_powi(d, factor[k], exponent[k]));
    return e;
}

/* The leading product in terms of the others.  False: the coefficients are not found. */
static bool exact(const ring *x, const nh_count_relation *q, nh_further_relation *out)
{
    nh_analysis *result = x->r;
    nh_dag *d = result->question->model->dag;
    nh_ex *value = nh_alloc_array(q->terms + 1, sizeof *value), *name = nh_alloc_array(q->terms + 1, sizeof *name),
          *c = nh_alloc_array(q->terms + 1, sizeof *c);
    for (size_t i = 0; i < q->terms; i++) {
        value[i] = product(d, x->count, x->phi, q->exponent + i * x->count);
        name[i] = product(d, x->count, x->symbol, q->exponent + i * x->count);
    }
    size_t last = q->terms - 1;
    bool found =
        nh_relation_find(d, q->terms, value, result->question->system->parameters, result->question->model->parameter,
                         (size_t)result->question->options.proof_terms, c) == NH_RELATION_UNIQUE;
    found = found && !nh_is_zero(d, c[last]);
    if (found) {
        nh_ex right = nh_int(d, 0);
        for (size_t i = 0; i < last; i++)
            right = nh_sub(d, right, nh_mul(d, nh_simplify(d, nh_div(d, c[i], c[last])), name[i]));
        char *lhs = nh_print_string(d, name[last]), *rhs = nh_print_string(d, right);
        *out = (nh_further_relation){nh_arena_strdup(result->arena, lhs), nh_arena_strdup(result->arena, rhs)};
        nh_free(rhs);
        nh_free(lhs);
    }
    nh_free(c);
    nh_free(name);
    nh_free(value);
    return found;
}

static size_t highest(const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    size_t degree = 0;
    for (size_t k = 0; k < list->furthers; k++)
        if (list->further[k].degree > degree) degree = list->further[k].degree;
    return degree;
}

void nh_relations_find(nh_analysis *result)
{
    const nh_current_list *list = result->list;
    enum { longest = 60 };
    size_t room = list->count + list->furthers + 1;
    ring x = {.r = result, .phi = nh_alloc_array(room, sizeof(nh_ex)), .symbol = nh_alloc_array(room, sizeof(nh_ex))};
    nh_count_relation found[NH_MOST_RELATIONS];
    for (size_t k = 0; k < list->count; k++) put(&x, &list->found[k]);
    for (size_t k = 0; k < list->furthers; k++) put(&x, &list->further[k].current);
    size_t n = 0;
    for (size_t degree = 2 * highest(result); degree > 0 && n == 0;
         degree--) /* lower where there are too many products */
        n = nh_count_relations(result->question->model, x.count, x.phi, degree, result->arena, NH_MOST_RELATIONS,
                               found);
    result->relation = nh_arena_alloc(result->arena, (n + 1) * sizeof *result->relation);
    for (size_t i = 0; i < n && !nh_late(); i++)
        if (found[i].terms > 1 && found[i].terms <= longest)
            result->relations += exact(&x, &found[i], &result->relation[result->relations]);
    nh_free(x.symbol);
    nh_free(x.phi);
}
