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
#include "search/counted.h"
#include "search/currents.h"
#include "search/missing_internal.h"
#include "search/relations.h"

typedef nh_missing_search search;

/* ---- the count ---- */

size_t nh_missing_most_proved(const nh_analysis *result)
{
    return result->count + result->furthers + result->pieces + 1;
}

/* The proved currents, into phi.  A degree that the user asks for may cost more. */
static nh_completeness_question question(const nh_analysis *result, nh_ex *phi)
{
    enum { times_if_asked = 10 };
    nh_completeness_question q = {.current = phi,
                                  .all = result->search == NH_SEARCH_COMPLETE,
                                  .degree = (size_t)result->options.degree,
                                  .work = result->options.count_work * (result->options.degree ? times_if_asked : 1),
                                  .threads = nh_threads(result->options.threads),
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
    nh_completeness_of(result->model, &q, result->completeness);
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
    nh_completeness_generic(result->model, &q, result->completeness);
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
    s->cyclic = nh_jet_equations_cyclic_rounds(result->model);
    for (size_t i = 0; i < count && !nh_late();) {
        bool found = try_attempt(s, &attempts[i]);
        i = found ? 0 : i + 1;
        if (found) s->stale = ~0u;
        if (found && result->independent >= result->local_maximum) result->search = NH_SEARCH_COMPLETE;
    }
}

void nh_missing_find(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    search s = {.solver = solver};
    nh_current *aside;
    if (result->options.construct <= 0 || nh_late()) return;
    result->search = result->independent >= result->local_maximum ? NH_SEARCH_COMPLETE : NH_SEARCH_EXHAUSTED;
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
    return solver->r->furthers && nh_primitives_search(solver, true, 1);
}

void nh_missing_name_further(nh_analysis *result)
{
    for (size_t k = 0; k < result->furthers; k++)
        result->further[k].current.name = nh_currents_name(result, result->count + result->pieces + k + 1);
    if (result->furthers) nh_relations_find(result);
}

void nh_missing_count(nh_analysis *result, bool searched)
{
    if (!result->counted) result->counted = nh_count_memory_create();
    count(result, 0,
          searched ? 1 : 2); /* with an ansatz the report gives the number of integrals of degree two as well */
    if (searched || result->options.degree) count_the_rest(result);
    if (!nh_late()) generalize(result);
    nh_count_memory_free(result->counted);
    result->counted = NULL;
    check(result);
}
