#include "search/missing.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "integrals/construct.h"
#include "search/stage_solver.h"

/* ---- the count ---- */

/* What is proved, in closed form. */
static size_t proved(const nh_analysis *r, nh_ex *phi, bool *general)
{
    size_t n = 0;
    *general = true;
    for (size_t k = 0; k < r->count; k++) {
        if (!r->found[k].proof.proved || r->found[k].series) continue;
        phi[n++] = r->found[k].phi;
        *general &= r->found[k].proof.all_parameters;
    }
    return n;
}

/* What is proved is compared with how much there can be. */
static void count(nh_analysis *r)
{
    nh_ex *phi = nh_alloc_array(r->count + 1, sizeof *phi);
    nh_completeness_question q = {.current = phi, .all = r->search == NH_SEARCH_COMPLETE, .degree = (size_t)r->options.degree, .work = r->options.count_work};
    nh_progress("how many integrals there are", -1);
    q.known = proved(r, phi, &q.general);
    nh_completeness_of(r->model, &q, r->completeness);
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
                nh_analysis_warn(r, "at degree %zu the program proved more currents than the count allows: this is a bug, please report it", d + 1);
    }
}

/* ---- the construction ---- */

typedef struct {
    nh_stage_solver climb;
    double work;            /* that is left for this count */
    size_t aside;           /* currents that are certified only */
    nh_current *set_aside;
} search;

static void set_aside(search *s)
{
    nh_analysis *r = s->climb.r;
    size_t kept = 0;
    s->set_aside = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *s->set_aside);
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (f->proof.proved || f->series) {
            r->found[kept++] = *f;
            continue;
        }
        r->independent -= f->independence == NH_INDEPENDENT;
        s->set_aside[s->aside++] = *f;
    }
    r->count = kept;
}

/* Those that do not depend on what was proved in the meantime. */
static void take_back(search *s)
{
    nh_analysis *r = s->climb.r;
    for (size_t k = 0; k < s->aside; k++) {
        nh_current *f = &s->set_aside[k];
        if (f->independence == NH_INDEPENDENT && nh_currents_known(s->climb.bench, f->phi)) continue;
        r->independent += f->independence == NH_INDEPENDENT;
        nh_currents_put(s->climb.bench, f);
    }
}

/* Is the list of its terms that of a current? */
static bool lift(search *s, size_t degree, const nh_constructed *c)
{
    nh_analysis *r = s->climb.r;
    nh_family *all = nh_arena_alloc(r->arena, sizeof *all);
    nh_ex *term = nh_arena_alloc(r->arena, c->terms * sizeof *term);
    size_t before = r->count;
    memcpy(term, c->term, c->terms * sizeof *term);
    *all = (nh_family){.kind = NH_TERMS, .terms = c->terms, .term = term};
    s->climb.wide = true;
    nh_stage_solver_stage(&s->climb, nh_arena_printf(r->arena, "an integral of degree %zu that the count misses", degree), 1, all);
    return r->count > before;
}

/* Words of one price. */
static bool construct_at(search *s, const nh_completeness *c, double price, bool *more)
{
    nh_analysis *r = s->climb.r;
    nh_ex *phi = nh_alloc_array(r->count + 1, sizeof *phi);
    bool general, found = false;
    nh_construct_question q = {.time = c->count.time, .degree = c->missing_at, .price = price, .most_words = (size_t)r->options.words, .work = s->work, .current = phi};
    q.known = proved(r, phi, &general);
    nh_construction *x = nh_construct(r->model, &q);
    s->work -= x->work;
    *more = !x->limited && x->recognised < x->dimension;
    for (size_t k = 0; k < x->count && !nh_stage_solver_done(&s->climb); k++) found |= lift(s, c->missing_at, &x->item[k]);
    nh_construction_free(x);
    nh_free(phi);
    return found;
}

/* Of one kind: words become dearer until something is found. */
static bool construct(search *s, const nh_completeness *c)
{
    double dearest = c->count.time ? 6 : 16; /* in t alone most are no words but waves */
    bool found = false, more = c->counted && c->missing_at && c->missing && (c->settled || !c->count.time); /* in time a number that is not settled is mostly far too large */
    s->work = s->climb.r->options.construct;
    for (double price = 2; more && !found && price <= dearest && s->work > 0 && !nh_stage_solver_done(&s->climb); price += price < 4 ? 1 : 2) found = construct_at(s, c, price, &more);
    return found;
}

static bool is_missing(const nh_analysis *r)
{
    bool some = false;
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS; i++) some |= r->completeness[i].missing_at && r->completeness[i].missing;
    return some;
}

static void look(nh_analysis *r)
{
    search s = {0};
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!nh_stage_solver_begin(&s.climb, r, &ignored)) return;
    nh_progress("integrals that the count misses", -1);
    nh_budget_begin(r->options.work);
    set_aside(&s);
    for (bool found = true; found && is_missing(r) && !nh_stage_solver_done(&s.climb);) {
        found = false;
        for (size_t i = 0; i < NH_COMPLETENESS_KINDS && !found; i++) found = construct(&s, &r->completeness[i]);
        if (found && r->independent >= r->local_maximum) r->search = NH_SEARCH_COMPLETE;
        if (found) count(r);
    }
    take_back(&s);
    nh_budget_begin(INFINITY);
    nh_currents_finish(s.climb.bench);
    nh_stage_solver_end(&s.climb);
    bool all = r->independent >= r->local_maximum;
    if (all || r->search == NH_SEARCH_COMPLETE) r->search = all ? NH_SEARCH_COMPLETE : NH_SEARCH_EXHAUSTED;
}

void nh_missing_count(nh_analysis *r, bool construct)
{
    count(r);
    if (construct && r->options.construct > 0 && is_missing(r) && !nh_late()) look(r);
    check(r);
}
