/* missing: integrals that the count misses, until it misses none. [docs/method.md, sec. 10, "Construction"]
 *
 *     count        bound and known integrals, degree by degree, up to the first that misses functions
 *     attempts     coefficients of the coordinates: missing ones, then further ones; then the same with time
 *                     |  one was found: count again, from the first attempt on
 *     take_back    currents that were only certified return, where they are still new */
#include "search/missing.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "exact/relation.h"
#include "graph/dag.h"
#include "graph/print.h"
#include "search/analysis.h"
#include "search/counted.h"
#include "search/current_list.h"
#include "search/currents.h"
#include "search/missing_internal.h"

/* ---- Polynomial relations among integrals that are polynomials in the velocities ---- */

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
    size_t degree = 0;
    for (size_t k = 0; k < result->list->furthers; k++)
        if (result->list->further[k].degree > degree) degree = result->list->further[k].degree;
    return degree;
}

/* Among the currents and the further integrals: which products are related is seen modulo a prime (count/count.h),
 * the coefficients are exact, over the parameters.  Fills result->relation. */
static void find_relations(nh_analysis *result)
{
    enum { longest = 60 };
    size_t room = result->list->count + result->list->furthers + 1;
    ring x = {.r = result, .phi = nh_alloc_array(room, sizeof(nh_ex)), .symbol = nh_alloc_array(room, sizeof(nh_ex))};
    nh_count_relation found[NH_MOST_RELATIONS];
    for (size_t k = 0; k < result->list->count; k++) put(&x, &result->list->found[k]);
    for (size_t k = 0; k < result->list->furthers; k++) put(&x, &result->list->further[k].current);
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

/* ---- missing ---- */

typedef nh_missing_search search;

/* ---- the count ---- */

size_t nh_missing_most_proved(const nh_analysis *result)
{
    return result->list->count + result->list->furthers + result->list->pieces + 1;
}

/* The proved currents, into phi.  A degree that the user asks for may cost more. */
static nh_completeness_question question(const nh_analysis *result, nh_ex *phi)
{
    enum { times_if_asked = 10 };
    nh_completeness_question q = {.current = phi,
                                  .all = result->search == NH_SEARCH_COMPLETE,
                                  .degree = (size_t)result->question->options.degree,
                                  .work = result->question->options.count_work *
                                          (result->question->options.degree ? times_if_asked : 1),
                                  .threads = nh_threads(result->question->options.threads),
                                  .memory = result->counted};
    q.known = nh_counted_proved(result, phi, &q.general, &q.independent);
    q.regional = nh_counted_regional(result, phi + q.known, &q.regional_general);
    q.known += q.regional;
    q.independent += q.regional;
    return q;
}

/* Compares the proved currents with the bound for their number, for these kinds (bits; 0: all).  While integrals are
 * sought, the lowest degree that misses some is enough. */
static void count(nh_analysis *result, unsigned kinds, size_t until_missing)
{
    nh_ex *phi = nh_alloc_array(nh_missing_most_proved(result), sizeof *phi);
    nh_completeness_question q = question(result, phi);
    q.kinds = kinds;
    q.until_missing = until_missing;
    nh_progress("how many integrals there are", -1);
    nh_completeness_of(result->question->model, &q, result->completeness);
    if (nh_late()) memset(result->completeness, 0, sizeof result->completeness);
    nh_free(phi);
}

/* The degrees that were left out. */
static void count_the_rest(nh_analysis *result)
{
    for (int kind = 0; kind < NH_COMPLETENESS_KINDS; kind++)
        if (result->completeness[kind].count.more && !nh_late()) count(result, 1u << kind, 0);
}

/* Whether this holds for generic parameters, too. */
static void generalize(nh_analysis *result)
{
    nh_ex *phi = nh_alloc_array(nh_missing_most_proved(result), sizeof *phi);
    nh_completeness_question q = question(result, phi);
    nh_completeness_generic(result->question->model, &q, result->completeness);
    if (nh_late()) memset(result->completeness, 0, sizeof result->completeness);
    nh_free(phi);
}

/* More proved currents than the bound allows. */
static void check(nh_analysis *result)
{
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS; i++) {
        const nh_completeness *c = &result->completeness[i];
        for (size_t d = 0; d < c->count.rows; d++)
            if (c->count.row[d].known > c->count.row[d].bound)
                nh_analysis_warn(result,
                                 "at degree %zu the program proved more currents than the count allows: this is a bug, "
                                 "please report it",
                                 d + 1);
    }
}

/* ---- integrals that are missing ---- */

static bool is_timeless(const nh_analysis *result) { return result->completeness[NH_COMPLETE_IN_COORDINATES].counted; }

/* Without time in the coefficients, which in a system without time gives functions of these only. */
static const nh_completeness *simplest_kind(const nh_analysis *result)
{
    return &result->completeness[is_timeless(result) ? NH_COMPLETE_IN_COORDINATES : NH_COMPLETE_IN_TIME];
}

static bool lacks_further(const nh_analysis *result)
{
    const nh_completeness *c = simplest_kind(result);
    return c->counted && c->incomplete_at && c->count.row[c->incomplete_at - 1].settled;
}

static bool is_missing(const nh_analysis *result)
{
    bool some = false;
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS; i++)
        some |= result->completeness[i].missing_at && result->completeness[i].missing;
    return some;
}

/* Counts a kind anew where currents were found since.  A system that depends on time has only one. */
static void refresh(search *s, int kind)
{
    nh_analysis *r = s->solver->r;
    bool old = s->stale >> kind & 1;
    s->stale &= ~(1u << kind);
    if (old && r->completeness[kind].counted && !nh_late()) count(r, 1u << kind, 1);
}

/* What is tried, in this order, from the beginning again whenever something was found. */
typedef struct {
    int kind;     /* with the coefficients of this count, */
    bool further; /* integrals that are functions of the currents found, but no polynomials of them */
} attempt;

static const attempt attempts[] = {
    {NH_COMPLETE_IN_COORDINATES, false},
    /* functions of the currents are few, and what has time in it may be a product of them and of waves */
    {NH_COMPLETE_IN_COORDINATES, true},
    {NH_COMPLETE_IN_TIME, false},
    {NH_COMPLETE_IN_TIME, true}, /* where there is no count without time */
};

static bool try_attempt(search *s, const attempt *a)
{
    nh_analysis *result = s->solver->r;
    const nh_completeness *c = &result->completeness[a->kind];
    refresh(s, a->kind);
    if (a->further && (c != simplest_kind(result) || !lacks_further(result))) return false;
    return nh_missing_construct(s, c, a->further);
}

static void construct(search *s)
{
    enum { count = sizeof attempts / sizeof *attempts };
    nh_analysis *result = s->solver->r;
    s->cyclic = nh_jet_equations_cyclic_rounds(result->question->model);
    for (size_t i = 0; i < count && !nh_late();) {
        bool found = try_attempt(s, &attempts[i]);
        i = found ? 0 : i + 1;
        if (found) s->stale = ~0u;
        if (found && result->list->independent >= result->question->local_maximum) result->search = NH_SEARCH_COMPLETE;
    }
}

void nh_missing_find(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    search s = {.solver = solver};
    nh_current *aside;
    if (result->question->options.construct <= 0 || nh_late()) return;
    result->search =
        result->list->independent >= result->question->local_maximum ? NH_SEARCH_COMPLETE : NH_SEARCH_EXHAUSTED;
    count(result, 0, 1);
    if ((!is_missing(result) && !lacks_further(result)) || nh_late()) return;
    nh_progress("integrals that the count misses", -1);
    solver->bench->constructs = true;
    size_t n = nh_currents_set_aside(solver->bench, &aside);
    construct(&s);
    nh_currents_take_back(solver->bench, n, aside);
    solver->bench->constructs = solver->wide = false;
}

bool nh_missing_primitives(nh_stage_solver *solver)
{
    return solver->r->list->furthers && nh_primitives_search(solver, true, 1);
}

void nh_missing_name_further(nh_analysis *result)
{
    for (size_t k = 0; k < result->list->furthers; k++)
        nh_current_list_describe(result, &result->list->further[k].current)->name =
            nh_current_list_name(result, result->list->count + result->list->pieces + k + 1);
    if (result->list->furthers) find_relations(result);
}

void nh_missing_count(nh_analysis *result, bool searched)
{
    if (!result->counted) result->counted = nh_count_memory_create();
    count(result, 0,
          searched ? 1 : 2); /* with an ansatz the report gives the number of integrals of degree two as well */
    if (searched || result->question->options.degree) count_the_rest(result);
    if (!nh_late()) generalize(result);
    nh_count_memory_free(result->counted);
    result->counted = NULL;
    check(result);
}
