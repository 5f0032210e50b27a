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

size_t nh_missing_most_proved(const nh_analysis *r) { return r->count + r->furthers + r->pieces + 1; }

/* The proved currents, into phi.  A degree that the user asks for may cost more. */
static nh_completeness_question question(const nh_analysis *r, nh_ex *phi)
{
    enum { times_if_asked = 10 };
    nh_completeness_question q = {.current = phi,
                                  .all = r->search == NH_SEARCH_COMPLETE,
                                  .degree = (size_t)r->options.degree,
                                  .work = r->options.count_work * (r->options.degree ? times_if_asked : 1),
                                  .threads = nh_threads(r->options.threads),
                                  .memory = r->counted};
    q.known = nh_counted_proved(r, phi, &q.general, &q.independent);
    q.regional = nh_counted_regional(r, phi + q.known, &q.regional_general);
    q.known += q.regional;
    q.independent += q.regional;
    return q;
}

/* Compares the proved currents with the bound for their number, for these kinds (bits; 0: all).  While integrals are
 * sought, the lowest degree that misses some is enough. */
static void count(nh_analysis *r, unsigned kinds, size_t until_missing)
{
    nh_ex *phi = nh_alloc_array(nh_missing_most_proved(r), sizeof *phi);
    nh_completeness_question q = question(r, phi);
    q.kinds = kinds;
    q.until_missing = until_missing;
    nh_progress("how many integrals there are", -1);
    nh_completeness_of(r->model, &q, r->completeness);
    if (nh_late()) memset(r->completeness, 0, sizeof r->completeness);
    nh_free(phi);
}

/* The degrees that were left out. */
static void count_the_rest(nh_analysis *r)
{
    for (int kind = 0; kind < NH_COMPLETENESS_KINDS; kind++)
        if (r->completeness[kind].count.more && !nh_late()) count(r, 1u << kind, 0);
}

/* Whether this holds for generic parameters, too. */
static void generalize(nh_analysis *r)
{
    nh_ex *phi = nh_alloc_array(nh_missing_most_proved(r), sizeof *phi);
    nh_completeness_question q = question(r, phi);
    nh_completeness_generic(r->model, &q, r->completeness);
    if (nh_late()) memset(r->completeness, 0, sizeof r->completeness);
    nh_free(phi);
}

/* More proved currents than the bound allows. */
static void check(nh_analysis *r)
{
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS; i++) {
        const nh_completeness *c = &r->completeness[i];
        for (size_t d = 0; d < c->count.rows; d++)
            if (c->count.row[d].known > c->count.row[d].bound)
                nh_analysis_warn(r,
                                 "at degree %zu the program proved more currents than the count allows: this is a bug, "
                                 "please report it",
                                 d + 1);
    }
}

/* ---- integrals that are missing ---- */

/* Those that are not proved, or else the series. */
static void set_aside(search *s, bool series)
{
    nh_analysis *r = s->solver.r;
    size_t kept = 0;
    nh_current *all = nh_arena_alloc(r->arena, (s->aside + r->count + 1) * sizeof *all);
    if (s->aside) memcpy(all, s->set_aside, s->aside * sizeof *all);
    s->set_aside = all;
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (series ? !f->series : f->proof.proved || f->series) {
            r->found[kept++] = *f;
            continue;
        }
        r->independent -= f->independence == NH_INDEPENDENT;
        s->set_aside[s->aside++] = *f;
    }
    r->count = kept;
}

/* Puts back those that do not depend on currents proved in the meantime, from the given one on. */
static void take_back(search *s, size_t first)
{
    nh_analysis *r = s->solver.r;
    for (size_t k = first; k < s->aside; k++) {
        nh_current *f = &s->set_aside[k];
        if (f->independence == NH_INDEPENDENT && nh_currents_known(s->solver.bench, f->phi, f->proof.proved)) continue;
        r->independent += f->independence == NH_INDEPENDENT;
        nh_currents_put(s->solver.bench, f);
    }
    s->aside = first;
}

static bool is_timeless(const nh_analysis *r) { return r->completeness[NH_COMPLETE_IN_COORDINATES].counted; }

/* Without time in the coefficients, which in a system without time gives functions of these only. */
static const nh_completeness *simplest_kind(const nh_analysis *r)
{
    return &r->completeness[is_timeless(r) ? NH_COMPLETE_IN_COORDINATES : NH_COMPLETE_IN_TIME];
}

static bool lacks_further(const nh_analysis *r)
{
    const nh_completeness *c = simplest_kind(r);
    return c->counted && c->incomplete_at && c->count.row[c->incomplete_at - 1].settled;
}

static bool is_missing(const nh_analysis *r)
{
    bool some = false;
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS; i++)
        some |= r->completeness[i].missing_at && r->completeness[i].missing;
    return some;
}

/* Where no closed form of them was found; that this was tried costs them nothing of the work. */
static void postponed_series(search *s)
{
    if (nh_budget_spent()) nh_budget_begin(s->solver.r->options.work);
    s->solver.words = nh_dictionary_of(s->solver.r->model);
    s->solver.counted.on = true;
    nh_stage_solver_series_in_each(&s->solver);
    s->solver.counted.on = false;
}

/* Integrals linear in the velocities without closed form, where the count misses one. */
static void series_of_positions(search *s)
{
    const nh_completeness *c = &s->solver.r->completeness[NH_COMPLETE_IN_COORDINATES];
    if (!c->counted || c->missing_at != 1 || !c->missing) return;
    s->solver.words = nh_dictionary_of(s->solver.r->model);
    nh_stage_solver_series_of_positions(&s->solver);
}

/* A series along one coordinate, made or postponed, may be an integral that has a name, times integrals that were
   found in the meantime. */
static bool integrate_series(search *s)
{
    nh_analysis *r = s->solver.r;
    size_t series = 0, before = s->aside;
    for (size_t k = 0; k < r->count; k++) series += r->found[k].series && r->found[k].independence == NH_INDEPENDENT;
    if (!(series || r->postponed) || !r->furthers || nh_late()) return false;
    set_aside(s, true);
    bool found = nh_primitives_search(&s->solver, true, 1);
    take_back(s, before);
    return found;
}

/* Counts a kind anew where currents were found since.  A system that depends on time has only one. */
static void refresh(search *s, int kind)
{
    nh_analysis *r = s->solver.r;
    bool old = s->stale >> kind & 1;
    s->stale &= ~(1u << kind);
    if (old && r->completeness[kind].counted && !nh_late()) count(r, 1u << kind, 1);
}

static bool look_further(search *s)
{
    nh_analysis *r = s->solver.r;
    return lacks_further(r) && nh_missing_construct(s, simplest_kind(r), true);
}

static void look(nh_analysis *r)
{
    search s = {0};
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!nh_stage_solver_begin(&s.solver, r, &ignored)) return;
    nh_progress("integrals that the count misses", -1);
    nh_budget_begin(r->options.work);
    s.solver.bench->constructs = true;
    set_aside(&s, false);
    s.cyclic = nh_jet_equations_cyclic_rounds(r->model);
    for (bool found = true; found && !nh_late();) {
        refresh(&s, NH_COMPLETE_IN_COORDINATES);
        found = nh_missing_construct(&s, &r->completeness[NH_COMPLETE_IN_COORDINATES], false);
        /* Functions of the currents are few, and what has time in it may be a product of them and of waves. */
        if (!found && is_timeless(r)) found = look_further(&s);
        if (!found) refresh(&s, NH_COMPLETE_IN_TIME);
        if (!found) found = nh_missing_construct(&s, &r->completeness[NH_COMPLETE_IN_TIME], false);
        if (!found && !is_timeless(r)) found = look_further(&s);
        if (found) s.stale = ~0u;
        if (found && r->independent >= r->local_maximum) r->search = NH_SEARCH_COMPLETE;
    }
    for (int kind = 0; kind < NH_COMPLETENESS_KINDS; kind++) refresh(&s, kind);
    if (integrate_series(&s) && !nh_late()) {
        if (r->independent >= r->local_maximum) r->search = NH_SEARCH_COMPLETE;
        count(r, 0, 1);
    }
    size_t before = r->independent;
    if (r->postponed && !nh_late()) postponed_series(&s);
    series_of_positions(&s);
    if (r->independent > before && r->independent >= r->local_maximum) { /* nothing is missing then */
        r->search = NH_SEARCH_COMPLETE;
        if (!nh_late()) count(r, 0, 1);
    }
    take_back(&s, 0);
    nh_budget_begin(INFINITY);
    nh_currents_finish(s.solver.bench);
    for (size_t k = 0; k < r->furthers; k++)
        r->further[k].current.name = nh_currents_name(r, r->count + r->pieces + k + 1);
    if (r->furthers) nh_relations_find(r);
    nh_stage_solver_end(&s.solver);
    bool all = r->independent >= r->local_maximum;
    if (all || r->search == NH_SEARCH_COMPLETE) r->search = all ? NH_SEARCH_COMPLETE : NH_SEARCH_EXHAUSTED;
}

void nh_missing_count(nh_analysis *r, bool construct)
{
    if (!r->counted) r->counted = nh_count_memory_create();
    count(r, 0, construct ? 1 : 2); /* with an ansatz the report gives the number of integrals of degree two as well */
    bool wanted = is_missing(r) || lacks_further(r) || r->postponed;
    if (construct && r->options.construct > 0 && wanted && !nh_late()) look(r);
    if (construct || r->options.degree) count_the_rest(r);
    if (!nh_late()) generalize(r);
    nh_count_memory_free(r->counted);
    r->counted = NULL;
    check(r);
}
